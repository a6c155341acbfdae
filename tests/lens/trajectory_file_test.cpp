// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/trajectory_file.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

class TrajectoryFile : public testing::Test {
 protected:
  std::vector<StampedPose> Tum(const std::string& text) {
    WriteFileAtomically(path_, text);
    return ReadTum(path_);
  }
  std::vector<StampedPose> Csv(const std::string& text) {
    WriteFileAtomically(path_, text);
    return ReadPoseCsv(path_, 4.0, 1.6);
  }
  /// The message behind "FILE:".
  std::string TumError(const std::string& text) {
    return Shortened(MessageOf<InputError>([&] { Tum(text); }));
  }
  std::string CsvError(const std::string& text) {
    return Shortened(MessageOf<InputError>([&] { Csv(text); }));
  }

 private:
  std::string Shortened(const std::string& message) const {
    EXPECT_EQ(message.find(path_.string() + ":"), 0U) << message;
    return message.substr(path_.string().size() + 1);
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_.Path() / "poses.txt";
};

TEST_F(TrajectoryFile, ReadsTumWithCommentsBlankLinesAndAnyBlanks) {
  const std::vector<StampedPose> poses =
      Tum("# timestamp tx ty tz qx qy qz qw\n"
          "0.5 1 2 3 0 0 0 1\r\n"
          "\n"
          "  1.25\t-1e1 0 0.5   0 0 0.7071067811865476 0.7071067811865476  \n");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].time_s, 0.5);
  EXPECT_EQ(poses[0].world_from_rig.translation_m, Vec3d(1.0, 2.0, 3.0));
  EXPECT_EQ(poses[1].time_s, 1.25);
  EXPECT_EQ(poses[1].world_from_rig.translation_m, Vec3d(-10.0, 0.0, 0.5));
  EXPECT_NEAR(YawRad(poses[1].world_from_rig), RadFromDeg(90.0), 1e-15);
}

TEST_F(TrajectoryFile, TumTextHasTheFormatToTheByte) {
  const std::vector<StampedPose> poses = {
      {0.0, {Eigen::Quaterniond(-1.0, 0.0, 0.0, 0.0), {1.5, -0.1, 1e-9}}},
      {1.0 / 3.0, {Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0.0, 100.0, 1.0 / 3.0}}},
  };
  EXPECT_EQ(TumText(poses),
            "0.000000000 1.5 -0.1 1e-09 0 0 0 1\n"
            "0.333333333 0 100 0.3333333333333333 0.5 -0.5 0.5 0.5\n");
}

TEST_F(TrajectoryFile, ReadsBackWhatTumTextWrites) {
  std::vector<StampedPose> poses;
  for (int i = 0; i < 20; ++i) {
    poses.push_back({0.25 * i, PoseFromYaw({0.1 * i, std::sin(i), 1.6}, 0.17 * i)});
  }
  const std::vector<StampedPose> again = Tum(TumText(poses));
  ASSERT_EQ(again.size(), poses.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(again[i].time_s, poses[i].time_s);
    EXPECT_EQ(again[i].world_from_rig.translation_m, poses[i].world_from_rig.translation_m);
    EXPECT_LT(again[i].world_from_rig.rotation.angularDistance(poses[i].world_from_rig.rotation),
              1e-15);
  }
}

TEST_F(TrajectoryFile, NormalisesQuaternionsWithFewDigits) {
  const std::vector<StampedPose> poses = Tum("0 0 0 0 0 0 0.7071 0.7071\n");
  EXPECT_NEAR(poses[0].world_from_rig.rotation.norm(), 1.0, 1e-15);
}

TEST_F(TrajectoryFile, RefusesDamagedTum) {
  EXPECT_EQ(TumError(""), " expected at least one pose (timestamp tx ty tz qx qy qz qw), got none");
  EXPECT_EQ(TumError("# nothing\n"),
            " expected at least one pose (timestamp tx ty tz qx qy qz qw), got none");
  EXPECT_EQ(TumError("# one\n0 0 0 0 0 0 1\n"),
            "2: expected 8 columns (timestamp tx ty tz qx qy qz qw), got 7");
  EXPECT_EQ(TumError("0 0 0 zero 0 0 0 1\n"), "1: tz: expected a finite number, got \"zero\"");
  EXPECT_EQ(TumError("0 0 nan 0 0 0 0 1\n"), "1: ty: expected a finite number, got \"nan\"");
  EXPECT_EQ(TumError("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"),
            "2: timestamp: expected more than in the row before");
  EXPECT_EQ(TumError("1 0 0 0 0 0 0 1\n0.5 0 0 0 0 0 0 1\n"),
            "2: timestamp: expected more than in the row before");
  EXPECT_EQ(TumError("0 0 0 0 0 0 0 0\n"),
            "1: qx qy qz qw: expected a quaternion of length 1, got length 0");
  EXPECT_EQ(TumError("0 0 0 0 0 0 0 0.9\n"),
            "1: qx qy qz qw: expected a quaternion of length 1, got length 0.9");
}

TEST_F(TrajectoryFile, ReadsCsvByItsHeader) {
  const std::vector<StampedPose> poses =
      Csv("yaw_deg, note,frame,y_m,x_m\n90,a,0,2,1\n# a comment\n-180.0,b,2,-4,3.5\n");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].time_s, 0.0);
  EXPECT_EQ(poses[0].world_from_rig.translation_m, Vec3d(1.0, 2.0, 1.6));
  EXPECT_LT((poses[0].world_from_rig.Direction(Vec3d::UnitX()) - Vec3d::UnitY()).norm(), 1e-15);
  // Frame 2 at 4 frames a second.
  EXPECT_EQ(poses[1].time_s, 0.5);
  EXPECT_EQ(poses[1].world_from_rig.translation_m, Vec3d(3.5, -4.0, 1.6));
}

TEST_F(TrajectoryFile, ReadsCsvWithAByteOrderMarkAndDosLines) {
  EXPECT_EQ(Csv("\xEF\xBB\xBF"
                "frame,x_m,y_m,yaw_deg\r\n3,1,2,0\r\n")[0]
                .time_s,
            0.75);
}

TEST_F(TrajectoryFile, RefusesDamagedCsv) {
  EXPECT_EQ(CsvError(""),
            " expected a header with the columns frame,x_m,y_m,yaw_deg, the file is empty");
  EXPECT_EQ(CsvError("frame,x_m,y_m\n0,1,2\n"),
            "1: expected a header with the columns frame,x_m,y_m,yaw_deg; yaw_deg is missing");
  EXPECT_EQ(CsvError("0,1,2,3\n"),
            "1: expected a header with the columns frame,x_m,y_m,yaw_deg; frame is missing");
  EXPECT_EQ(CsvError("frame,x_m,x_m,y_m,yaw_deg\n"), "1: column x_m is there twice");
  EXPECT_EQ(CsvError("frame,x_m,y_m,yaw_deg\n"),
            " expected at least one row below the header, got none");
  EXPECT_EQ(CsvError("frame,x_m,y_m,yaw_deg\n0,1,2\n"),
            "2: expected 4 columns as in the header, got 3");
  EXPECT_EQ(CsvError("frame,x_m,y_m,yaw_deg\n0,1,,3\n"),
            "2: y_m: expected a finite number, got \"\"");
  EXPECT_EQ(CsvError("frame,x_m,y_m,yaw_deg\n0.5,1,2,3\n"),
            "2: frame: expected a whole number, got \"0.5\"");
  EXPECT_EQ(CsvError("frame,x_m,y_m,yaw_deg\n1,1,2,3\n1,1,2,3\n"),
            "3: frame: expected more than in the row before");
}

TEST_F(TrajectoryFile, RefusesAMissingFile) {
  EXPECT_THROW(ReadTum("/nowhere/poses.txt"), InputError);
  EXPECT_THROW(ReadPoseCsv("/nowhere/poses.csv", 1.0, 0.0), InputError);
}

}  // namespace
}  // namespace pfseq
