// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sequence_writer.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

const std::vector<DescriptionFile> kDescription = {{"sequence.yaml", "a: 1\nb: 2\n"},
                                                   {"scene.glb", "glTF"}};
const FrameFile kFrame{"lens", "front", Output::kSky, 0};
const Bytes kBytes(10, std::byte{7});

TEST(SequenceWriter, WritesTheManifestOnlyWhenAllIsThere) {
  const TempFolder folder;
  const SequenceWriter writer(folder / "new", kDescription, OnExisting::kRefuse);
  const FrameFile other{"lens", "rear", Output::kSky, 0};
  writer.WriteFrameFile(kFrame, kBytes);
  EXPECT_FALSE(writer.FinishIfComplete({kFrame, other}, 1));
  EXPECT_FALSE(std::filesystem::exists(folder / "new/manifest.json"));
  writer.WriteFrameFile(other, kBytes);
  EXPECT_TRUE(writer.FinishIfComplete({kFrame, other}, 1));
  EXPECT_EQ(Manifest::Read(folder / "new").files.size(), 4U);
}

TEST(SequenceWriter, ResumingKeepsFilesAndTakesTheManifestAwayMeanwhile) {
  const TempFolder folder;
  {
    const SequenceWriter writer(folder / "s", kDescription, OnExisting::kRefuse);
    writer.WriteFrameFile(kFrame, kBytes);
    ASSERT_TRUE(writer.FinishIfComplete({kFrame}, 1));
  }
  const SequenceWriter writer(folder / "s", kDescription, OnExisting::kResume);
  EXPECT_TRUE(writer.Has(kFrame));
  EXPECT_FALSE(std::filesystem::exists(folder / "s/manifest.json"));
}

TEST(SequenceWriter, RefusesAnotherDescriptionAndChangesNothing) {
  const TempFolder folder;
  {
    const SequenceWriter writer(folder / "s", kDescription, OnExisting::kRefuse);
    ASSERT_TRUE(writer.FinishIfComplete({}, 1));
  }
  std::vector<DescriptionFile> other = kDescription;
  other[0].bytes = "a: 1\nb: 3\n";
  other.push_back({"rig.yaml", "new"});
  EXPECT_THAT(
      MessageOf<InputError>([&] { SequenceWriter(folder / "s", other, OnExisting::kResume); }),
      HasSubstr("sequence.yaml: was made from another description (line 2 differs)"));
  EXPECT_THAT(MessageOf<InputError>(
                  [&] { SequenceWriter(folder / "s", kDescription, OnExisting::kRefuse); }),
              HasSubstr("already holds a sequence"));
  EXPECT_TRUE(std::filesystem::exists(folder / "s/manifest.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "s/rig.yaml"));
}

TEST(SequenceWriter, OverwritingRemovesTheSequenceAndNothingElse) {
  const TempFolder folder;
  {
    const SequenceWriter writer(folder / "s", kDescription, OnExisting::kRefuse);
    writer.WriteFrameFile(kFrame, kBytes);
  }
  WriteFileAtomically(folder / "s/notes.txt", "mine");
  std::vector<DescriptionFile> other = kDescription;
  other[0].bytes = "c: 4\n";
  const SequenceWriter writer(folder / "s", other, OnExisting::kOverwrite);
  EXPECT_FALSE(writer.Has(kFrame));
  EXPECT_EQ(ReadFile(folder / "s/sequence.yaml"), "c: 4\n");
  EXPECT_EQ(ReadFile(folder / "s/notes.txt"), "mine");
}

TEST(SequenceWriter, RefusesAFolderWithOtherThings) {
  const TempFolder folder;
  WriteFileAtomically(folder / "s/precious.txt", "mine");
  for (const OnExisting on_existing :
       {OnExisting::kRefuse, OnExisting::kResume, OnExisting::kOverwrite}) {
    EXPECT_THAT(
        MessageOf<InputError>([&] { SequenceWriter(folder / "s", kDescription, on_existing); }),
        HasSubstr("holds other things than a sequence (precious.txt)"));
  }
}

TEST(SequenceWriter, RemovesWhatDeadProcessesLeftButNotWhatLivingOnesWrite) {
  const TempFolder folder;
  const SequenceWriter writer(folder / "s", kDescription, OnExisting::kRefuse);
  // Process numbers are at most 2^22 on Linux.
  const std::string dead = "s/lens/front/sky/000000.png.8388607.partial";
  const std::string alive = "s/lens/front/sky/000001.png." + std::to_string(getpid()) + ".partial";
  WriteFileAtomically(folder / dead, "half");
  WriteFileAtomically(folder / alive, "half");
  ASSERT_TRUE(writer.FinishIfComplete({}, 1));
  EXPECT_FALSE(std::filesystem::exists(folder / dead));
  EXPECT_TRUE(std::filesystem::exists(folder / alive));
}

}  // namespace
}  // namespace pfseq
