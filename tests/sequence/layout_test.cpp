// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/layout.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(FrameFile, PathsAreThoseOfTheDocumentedLayout) {
  const auto path = [](Output output) {
    return FrameFile{"equisolid", "front", output, 24}.RelativePath().string();
  };
  EXPECT_EQ(path(Output::kClean), "equisolid/front/clean/000024.png");
  EXPECT_EQ(path(Output::kLinear), "equisolid/front/linear/000024.exr");
  EXPECT_EQ(path(Output::kDistance), "equisolid/front/distance/000024.exr");
  EXPECT_EQ(path(Output::kSky), "equisolid/front/sky/000024.png");
  EXPECT_EQ(path(Output::kRealistic), "equisolid/front/realistic/000024.png");
  EXPECT_EQ(path(Output::kRealisticJpeg), "equisolid/front/realistic/000024.jpg");
  EXPECT_EQ(path(Output::kBlur), "equisolid/front/blur/000024.exr");
  EXPECT_EQ(path(Output::kRealisticLinear), "equisolid/front/realistic_linear/000024.exr");
  EXPECT_EQ(path(Output::kFlare), "equisolid/front/flare/000024.exr");
}

TEST(FrameFile, PathsReadBackForSmallAndLargeNumbers) {
  for (const int frame : {0, 24, 999999, 1000000}) {
    for (const Output output : kAllOutputs) {
      const FrameFile file{"a", "b", output, frame};
      const auto read = FrameFile::FromRelativePath(file.RelativePath());
      ASSERT_TRUE(read.has_value());
      EXPECT_EQ(read->RelativePath(), file.RelativePath());
      EXPECT_EQ(read->frame, frame);
      EXPECT_EQ(read->output, output);
    }
  }
}

TEST(FrameFile, OtherPathsAreNotFrameFiles) {
  for (const char* path : {"a/b/clean/24.png",
                           "a/b/clean/000024.exr",
                           "a/b/depth/000024.exr",
                           "b/clean/000024.png",
                           "a/b/clean/00002x.png",
                           "a/b/clean/-00024.png",
                           "a/b/clean/000024.png.7.partial",
                           "a/b/clean/0000024.png"}) {
    EXPECT_FALSE(FrameFile::FromRelativePath(path).has_value()) << path;
  }
}

TEST(OutputFromName, RefusesUnknownNamesAndListsTheKnown) {
  EXPECT_EQ(OutputFromName("sky"), Output::kSky);
  EXPECT_THAT(MessageOf<InputError>([] { OutputFromName("depth"); }),
              testing::HasSubstr("expected realistic, clean, linear, distance, sky, blur, "
                                 "realistic_linear or flare, got 'depth'"));
}

TEST(SequenceFiles, FindsDescriptionAndFramesButNotTheRest) {
  const TempFolder folder;
  for (const char* name : {"sequence.yaml",
                           "scene.glb",
                           "rig.yaml",
                           "poses.csv",
                           "trajectory_front.txt",
                           "sky_map.exr",
                           "sky_map.hdr",
                           "l/c/clean/000001.png",
                           "notes.txt",
                           "l/c/clean/000001.png.12.partial",
                           "manifest.json"}) {
    WriteFileAtomically(folder / name, "x");
  }
  const std::vector<std::filesystem::path> expected = {"l/c/clean/000001.png",
                                                       "poses.csv",
                                                       "rig.yaml",
                                                       "scene.glb",
                                                       "sequence.yaml",
                                                       "sky_map.exr",
                                                       "sky_map.hdr",
                                                       "trajectory_front.txt"};
  EXPECT_EQ(SequenceFiles(folder.Path()), expected);
}

}  // namespace
}  // namespace pfseq
