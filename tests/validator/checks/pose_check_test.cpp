// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/pose_check.h"

#include "renderer/core/file.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/checks/finding_matchers.h"
#include "tests/validator/test_sequence.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class PoseCheck : public testing::Test {
 protected:
  PoseCheck() {
    TestSequence sequence = TestSequence::Yard(8);
    sequence.frames = {};
    sequence.Write(folder_.Path());
  }

  /// Replaces one cell of the row of a frame; poses.csv has a header, trajectories have none.
  void EditCell(
      const std::string& file, size_t line, char separator, size_t cell, const std::string& value) {
    EditLines(folder_ / file, [&](std::vector<std::string>& lines) {
      std::string& row = lines.at(line);
      size_t begin = 0;
      for (size_t i = 0; i < cell; ++i) {
        begin = row.find(separator, begin) + 1;
      }
      const size_t end = std::min(row.find(separator, begin), row.size());
      row = row.substr(0, begin) + value + row.substr(end);
    });
  }

  CheckReport Check() const {
    const SequenceReader reader(folder_.Path());
    CheckReport report;
    CheckPoses({reader, nullptr, {}, {}}, report);
    return report;
  }

  TempFolder folder_;
};

TEST_F(PoseCheck, SoundPosesHaveNoFindings) {
  const CheckReport report = Check();
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_EQ(report.num_poses, 4U);
}

TEST_F(PoseCheck, AnExposureHasTwoPosesForEachFrame) {
  const std::string pose = " 0 0 0 0 0 0 1\n";
  std::string text;
  for (const char* time_s : {"-0.01", "0.01", "0.39", "0.41", "0.79", "0.81", "1.19"}) {
    text += time_s + pose;
  }
  WriteFileAtomically(folder_ / "exposure_front.txt", std::string_view(text));
  EXPECT_THAT(Check().findings, ElementsAre(IsFault("exposure_front.txt", "7 poses, expected two")));
  text += "1.21" + pose;
  WriteFileAtomically(folder_ / "exposure_front.txt", std::string_view(text));
  EXPECT_THAT(Check().findings, IsEmpty());
}

TEST_F(PoseCheck, APositionThatAllTrajectoriesContradictIsAnEditedPose) {
  EditCell("poses.csv", 3, ',', 2, "1.80002");  // x_m of frame 2, 20 micrometres off.
  EXPECT_THAT(Check().findings, ElementsAre(IsFault("poses.csv", "frame 2: contradicts")));
}

TEST_F(PoseCheck, AYawThatIsNotTheQuaternionsIsAnEditedPose) {
  EditCell("poses.csv", 2, ',', 4, "6.4");  // yaw_deg of frame 1 is 6.3025.
  EXPECT_THAT(Check().findings, ElementsAre(IsFault("poses.csv", "frame 1: yaw_deg 6.4")));
}

TEST_F(PoseCheck, NamesTheFrameOfAnEditedTrajectory) {
  EditCell("trajectory_rear.txt", 3, ' ', 2, "0.7");
  EXPECT_THAT(Check().findings, ElementsAre(IsFault("trajectory_rear.txt", "frame 3: ")));
}

TEST_F(PoseCheck, NoticesARotationOfATrajectory) {
  // A quaternion with the sign of one part changed is still of unit length.
  EditLines(folder_ / "trajectory_rear.txt", [](std::vector<std::string>& lines) {
    const size_t qz = lines[1].rfind(' ', lines[1].rfind(' ') - 1) + 1;
    lines[1] = lines[1][qz] == '-' ? lines[1].erase(qz, 1) : lines[1].insert(qz, "-");
  });
  EXPECT_THAT(Check().findings, ElementsAre(IsFault("trajectory_rear.txt", "frame 1: ")));
}

TEST_F(PoseCheck, TimesOfTrajectoriesAreThoseOfThePoses) {
  EditCell("trajectory_front.txt", 0, ' ', 0, "0.01");
  EXPECT_THAT(Check().findings, ElementsAre(IsFault("trajectory_front.txt", "0.01 s")));
}

TEST_F(PoseCheck, TimesMustIncrease) {
  EditCell("poses.csv", 3, ',', 1, "0.25");
  EXPECT_THAT(Check().findings, testing::Contains(IsFault("poses.csv", "frame 2: its time")));
}

TEST_F(PoseCheck, NamesAShortMissingOrGarbledTrajectory) {
  EditLines(folder_ / "trajectory_rear.txt", [](auto& lines) { lines.pop_back(); });
  std::filesystem::remove(folder_ / "trajectory_front.txt");
  EXPECT_THAT(Check().findings,
              ElementsAre(IsFault("trajectory_front.txt", ""),
                          IsFault("trajectory_rear.txt", "3 poses, 4 in poses.csv")));
  EditLines(folder_ / "trajectory_rear.txt", [](auto& lines) { lines[1] = "0.25 much"; });
  EXPECT_THAT(Check().findings, testing::Contains(IsFault("trajectory_rear.txt", "line 2")));
}

}  // namespace
}  // namespace pfseq
