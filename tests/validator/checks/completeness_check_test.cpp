// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/completeness_check.h"

#include "renderer/core/file.h"
#include "renderer/sequence/poses_file.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/checks/finding_matchers.h"
#include "tests/validator/test_sequence.h"

#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A folder with calibration and empty frame files: only their names matter to this check.
class CompletenessCheck : public testing::Test {
 protected:
  CompletenessCheck() {
    const TestSequence sequence = TestSequence::Yard(16);
    WriteFileAtomically(folder_ / "rig.yaml", std::string_view(sequence.rig.ToYaml()));
    WriteFileAtomically(folder_ / "poses.csv", std::string_view(PosesCsv(sequence.poses)));
    for (const char* camera : {"front", "rear"}) {
      for (const int frame : {0, 2}) {
        Put({"equisolid", camera, Output::kDistance, frame});
        Put({"equisolid", camera, Output::kClean, frame});
      }
    }
  }

  void Put(const FrameFile& file) {
    WriteFileAtomically(folder_.Path() / file.RelativePath(), std::string_view());
  }

  std::vector<CheckedView> Check() {
    return CheckCompleteness(SequenceReader(folder_.Path()), report_);
  }

  TempFolder folder_;
  CheckReport report_;
};

TEST_F(CompletenessCheck, FindsAllViewsInOrder) {
  const std::vector<CheckedView> views = Check();
  EXPECT_THAT(report_.findings, IsEmpty());
  ASSERT_EQ(views.size(), 4U);
  EXPECT_EQ(views[1].camera, "front");
  EXPECT_EQ(views[1].frame, 2);
  EXPECT_TRUE(views[1].Has(Output::kClean));
  EXPECT_FALSE(views[1].Has(Output::kSky));
  EXPECT_EQ(views[2].File(Output::kDistance), "equisolid/rear/distance/000000.exr");
}

TEST_F(CompletenessCheck, NotesAFrameThatLacksAFile) {
  Put({"equisolid", "rear", Output::kSky, 2});
  Check();
  EXPECT_THAT(report_.findings, ElementsAre(IsNote("equisolid/rear/sky", "frame 0 is not there")));
}

TEST_F(CompletenessCheck, StrangersAreFaultsAndNoViews) {
  Put({"orthographic", "front", Output::kSky, 0});
  Put({"equisolid", "left", Output::kSky, 0});
  Put({"equisolid", "rear", Output::kSky, 4});
  EXPECT_EQ(Check().size(), 4U);
  EXPECT_THAT(
      report_.findings,
      testing::UnorderedElementsAre(
          IsFault("orthographic/front/sky/000000.png", "rig.yaml has no lens 'orthographic'"),
          IsFault("equisolid/left/sky/000000.png", "rig.yaml has no camera 'left'"),
          IsFault("equisolid/rear/sky/000004.png", "poses.csv has no frame 4")));
}

TEST_F(CompletenessCheck, NotesAFolderWithoutFrames) {
  std::filesystem::remove_all(folder_ / "equisolid");
  EXPECT_THAT(Check(), IsEmpty());
  EXPECT_THAT(report_.findings, ElementsAre(IsNote(".", "no frames")));
}

}  // namespace
}  // namespace pfseq
