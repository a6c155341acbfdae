// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/poses_file.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

std::vector<StampedPose> TwoPoses() {
  return {{0.0, PoseFromYaw(Vec3d(0.1, -2.5, 1.6), RadFromDeg(30.0))},
          {0.25, PoseFromYaw(Vec3d(1.0 / 3.0, 0.0, 1.6), RadFromDeg(-179.0))}};
}

TEST(PosesCsv, StartsWithTheSourcesColumns) {
  const std::string text = PosesCsv(TwoPoses());
  EXPECT_THAT(text,
              testing::StartsWith("frame,time_s,x_m,y_m,yaw_deg,z_m,qx,qy,qz,qw\n0,0,0.1,-2.5,"));
  EXPECT_THAT(text, HasSubstr("\n1,0.25,0.3333333333333333,0,-179"));
}

TEST(PosesCsv, ReadsBackToTheSameBits) {
  const TempFolder folder;
  WriteFileAtomically(folder / "poses.csv", PosesCsv(TwoPoses()));
  const std::vector<StampedPose> read = ReadPosesCsv(folder / "poses.csv");
  ASSERT_EQ(read.size(), 2U);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].time_s, TwoPoses()[i].time_s);
    EXPECT_EQ(read[i].world_from_rig.translation_m, TwoPoses()[i].world_from_rig.translation_m);
    EXPECT_EQ(read[i].world_from_rig.rotation.coeffs(),
              TwoPoses()[i].world_from_rig.rotation.coeffs());
  }
}

TEST(PosesCsv, FaultsNameFileAndLine) {
  const TempFolder folder;
  const std::string header = "frame,time_s,x_m,y_m,yaw_deg,z_m,qx,qy,qz,qw\n";
  const std::string row0 = "0,0,0,0,0,1.6,0,0,0,1\n";
  const auto message = [&](const std::string& text) {
    WriteFileAtomically(folder / "poses.csv", text);
    return MessageOf<InputError>([&] { ReadPosesCsv(folder / "poses.csv"); });
  };
  EXPECT_THAT(message("frame,x_m\n"), HasSubstr("poses.csv:1: expected the columns"));
  EXPECT_THAT(message(header), HasSubstr("at least one pose"));
  EXPECT_THAT(message(header + row0 + "2,0,0,0,0,1.6,0,0,0,1\n"),
              HasSubstr("poses.csv:3: expected frame 1, got 2"));
  EXPECT_THAT(message(header + "0,0,0,0,0,1.6,0,0,0\n"),
              HasSubstr("poses.csv:2: expected 10 finite numbers"));
  EXPECT_THAT(message(header + "0,0,0,0,0,1.6,0,0,0,1,7\n"),
              HasSubstr("poses.csv:2: expected 10 finite numbers"));
  EXPECT_THAT(message(header + "0,0,nan,0,0,1.6,0,0,0,1\n"),
              HasSubstr("poses.csv:2: expected 10 finite numbers"));
  EXPECT_THAT(message(header + "0,0,0,0,0,1.6,0,0,0,2\n"),
              HasSubstr("poses.csv:2: expected a unit quaternion"));
}

}  // namespace
}  // namespace pfseq
