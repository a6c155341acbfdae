// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/check_sequence.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/validator/checks/finding_matchers.h"
#include "tests/validator/checks/view_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SequenceCheck : public ViewFixture {
 protected:
  CheckReport CheckAll(int num_threads = 2) const {
    CheckOptions options;
    options.num_threads = num_threads;
    options.quiet = true;
    return CheckSequence(folder_.Path(), options);
  }
};

TEST_F(SequenceCheck, FindsNothingInASoundSequence) {
  const CheckReport report = CheckAll();
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_EQ(report.num_files_hashed, 30U);
  EXPECT_EQ(report.num_images, 24U);
  EXPECT_EQ(report.num_maps_recast, 8U);
  EXPECT_EQ(report.pair_totals.size(), 4U);
  EXPECT_THAT(report.Text(), HasSubstr("sound: no fault found"));
}

TEST_F(SequenceCheck, NamesAFlippedByteInEveryKindOfFile) {
  for (const char* name : {"equisolid/rear/clean/000001.png",
                           "equidistant/front/distance/000003.exr",
                           "equidistant/front/sky/000003.png",
                           "scene.glb",
                           "rig.yaml",
                           "poses.csv",
                           "trajectory_front.txt",
                           "sequence.yaml"}) {
    const std::string bytes = ReadFile(folder_ / name);
    std::string flipped = bytes;
    flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 1);
    WriteFileAtomically(folder_ / name, std::string_view(flipped));
    EXPECT_THAT(CheckAll().findings, Contains(IsFault(name, "SHA-256"))) << name;
    WriteFileAtomically(folder_ / name, std::string_view(bytes));
  }
}

TEST_F(SequenceCheck, ASwappedPairIsToldEvenWithAFreshManifest) {
  for (const Output output : {Output::kClean, Output::kDistance, Output::kSky}) {
    SwapFiles(PathOf("equisolid", "front", output, 1), PathOf("equisolid", "rear", output, 1));
  }
  EXPECT_THAT(CheckAll().findings,
              Contains(IsFault("equisolid/front/clean/000001.png", "swapped?")));
  RenewManifest(folder_.Path());
  EXPECT_THAT(
      CheckAll().findings,
      testing::IsSupersetOf(
          {IsFault("equisolid/front/distance/000001.exr", "shows rear's view of frame 1"),
           IsFault("equisolid/rear/distance/000001.exr", "shows front's view of frame 1")}));
}

TEST_F(SequenceCheck, AnEditedPoseIsToldEvenWithFittingTrajectoriesAndManifest) {
  TestSequence edited = sequence_;
  edited.poses[3].world_from_rig.translation_m.y() += 0.002;
  edited.frames = {};
  edited.Write(folder_.Path());
  EXPECT_THAT(CheckAll().findings,
              ElementsAre(IsFault("poses.csv", "frame 3: none of 4 distance maps")));
}

TEST_F(SequenceCheck, GoesOnWithoutTheScene) {
  std::filesystem::remove(folder_ / "scene.glb");
  std::filesystem::resize_file(folder_ / "equisolid/rear/sky/000003.png", 60);
  RenewManifest(folder_.Path());
  EXPECT_THAT(CheckAll().findings,
              ElementsAre(IsFault("scene.glb", "nothing was checked by rays"),
                          IsFault("equisolid/rear/sky/000003.png", "")));
}

TEST_F(SequenceCheck, NamesTheFileOfABrokenCalibration) {
  EditLines(folder_ / "poses.csv", [](auto& lines) { lines[2] = "1,oops"; });
  EXPECT_THAT(CheckAll().findings, Contains(IsFault("poses.csv", "line 3")));
  std::filesystem::remove(folder_ / "rig.yaml");
  EXPECT_THAT(CheckAll().findings, Contains(IsFault("rig.yaml", "missing")));
}

TEST_F(SequenceCheck, DoesNotDependOnTheNumberOfThreads) {
  SwapFiles(PathOf("equisolid", "front", Output::kSky, 1),
            PathOf("equisolid", "rear", Output::kSky, 3));
  EXPECT_EQ(CheckAll(1).Text(), CheckAll(3).Text());
}

TEST(CheckSequence, RefusesAFolderThatIsNotThere) {
  EXPECT_THAT(MessageOf<InputError>([] { CheckSequence("/nowhere/at/all", {}); }),
              HasSubstr("/nowhere/at/all"));
}

}  // namespace
}  // namespace pfseq
