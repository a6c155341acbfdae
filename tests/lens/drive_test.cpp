// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/drive.h"

#include "renderer/core/units.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr DrivePath::Shape kShape = {.first_street_m = 50.0,
                                     .cross_street_m = 40.0,
                                     .last_street_m = 60.0,
                                     .corner_radius_m = 10.0,
                                     .turn = Turn::kLeft};
constexpr DriveTrajectory::Speeds kSpeeds = {
    .cruise_mps = 8.0, .corner_mps = 5.0, .acceleration_mps2 = 2.0, .stop_s = 1.0};
constexpr double kArcM = 5.0 * std::numbers::pi;

void ExpectPose(const RigidTransform& pose, const Vec3d& position_m, double yaw_deg) {
  EXPECT_LT((pose.translation_m - position_m).norm(), 1e-12) << pose.translation_m.transpose();
  EXPECT_NEAR(std::remainder(YawRad(pose) - RadFromDeg(yaw_deg), 2.0 * kPi), 0.0, 1e-14)
      << DegFromRad(YawRad(pose));
}

TEST(DrivePath, GoesUpAcrossAndBackAroundLeftCorners) {
  const DrivePath path(kShape);
  EXPECT_DOUBLE_EQ(path.LengthM(), 150.0 + 2.0 * kArcM);
  ExpectPose(path.WorldFromCar(0.0), {0.0, 0.0, 0.0}, 0.0);
  ExpectPose(path.WorldFromCar(20.0), {20.0, 0.0, 0.0}, 0.0);
  // In the middle of the first corner, whose centre is (50, 10).
  const double r = 10.0 * std::sqrt(0.5);
  ExpectPose(path.WorldFromCar(50.0 + 0.5 * kArcM), {50.0 + r, 10.0 - r, 0.0}, 45.0);
  ExpectPose(path.WorldFromCar(50.0 + kArcM + 20.0), {60.0, 30.0, 0.0}, 90.0);
  ExpectPose(path.WorldFromCar(90.0 + 1.5 * kArcM), {50.0 + r, 50.0 + r, 0.0}, 135.0);
  ExpectPose(path.WorldFromCar(90.0 + 2.0 * kArcM + 15.0), {35.0, 60.0, 0.0}, 180.0);
  ExpectPose(path.WorldFromCar(path.LengthM()), {-10.0, 60.0, 0.0}, 180.0);
}

TEST(DrivePath, TurnedRightIsItsMirrorImage) {
  DrivePath::Shape shape = kShape;
  shape.turn = Turn::kRight;
  const DrivePath left(kShape);
  const DrivePath right(shape);
  for (double way_m = 0.5; way_m < left.LengthM(); way_m += 1.0) {
    const RigidTransform pose = left.WorldFromCar(way_m);
    const Vec3d& p = pose.translation_m;
    ExpectPose(right.WorldFromCar(way_m), {p.x(), -p.y(), 0.0}, -DegFromRad(YawRad(pose)));
  }
}

TEST(DrivePath, StaysAtItsEnds) {
  const DrivePath path(kShape);
  ExpectPose(path.WorldFromCar(-5.0), {0.0, 0.0, 0.0}, 0.0);
  ExpectPose(path.WorldFromCar(1e9), {-10.0, 60.0, 0.0}, 180.0);
}

TEST(DrivePath, HasSegmentsThatJoin) {
  for (const Turn turn : {Turn::kLeft, Turn::kRight}) {
    DrivePath::Shape shape = kShape;
    shape.turn = turn;
    const DrivePath path(shape);
    double way_m = 0.0;
    for (const DrivePath::Segment& segment : path.Segments()) {
      const RigidTransform start = path.WorldFromCar(way_m);
      EXPECT_LT((start.translation_m.head<2>() - segment.start_m).norm(), 1e-12);
      EXPECT_NEAR(
          std::remainder(YawRad(start) - segment.start_quarter_turns * 0.5 * kPi, 2.0 * kPi),
          0.0,
          1e-14);
      way_m += segment.length_m;
    }
    EXPECT_EQ(path.Segments()[0].curvature_per_m, 0.0);
    EXPECT_EQ(path.Segments()[1].curvature_per_m, turn == Turn::kLeft ? 0.1 : -0.1);
  }
}

TEST(DriveTrajectory, FollowsAHandComputedTimetable) {
  const DriveTrajectory drive(DrivePath(kShape), kSpeeds, 1.5);
  // At rest for 1 s, then 4 s and 16 m up to 8 m/s.
  EXPECT_EQ(drive.WayM(-1.0), 0.0);
  EXPECT_EQ(drive.WayM(1.0), 0.0);
  EXPECT_DOUBLE_EQ(drive.WayM(3.0), 4.0);
  EXPECT_DOUBLE_EQ(drive.SpeedMps(3.0), 4.0);
  EXPECT_DOUBLE_EQ(drive.WayM(5.0), 16.0);
  // Braking to 5 m/s takes 1.5 s and 9.75 m; between lie 24.25 m at 8 m/s.
  const double arc_start_s = 5.0 + 24.25 / 8.0 + 1.5;
  EXPECT_NEAR(drive.WayM(arc_start_s), 50.0, 1e-12);
  EXPECT_NEAR(drive.SpeedMps(arc_start_s), 5.0, 1e-12);
  const double arc_end_s = arc_start_s + kPi;
  EXPECT_NEAR(drive.SpeedMps(arc_end_s - 0.1), 5.0, 1e-12);
  EXPECT_NEAR(drive.WayM(arc_end_s), 50.0 + kArcM, 1e-12);
  // Cross street: 9.75 m each to speed up and brake, 20.5 m between.
  const double second_arc_s = arc_end_s + 3.0 + 20.5 / 8.0;
  EXPECT_NEAR(drive.WayM(second_arc_s), 90.0 + kArcM, 1e-12);
  // Last street: 9.75 m up, 16 m to the stop.
  const double end_s = second_arc_s + kPi + 1.5 + 34.25 / 8.0 + 4.0;
  EXPECT_NEAR(drive.EndTimeS(), end_s, 1e-12);
  EXPECT_NEAR(drive.WayM(end_s - 1.0), drive.Path().LengthM() - 1.0, 1e-12);
  EXPECT_EQ(drive.SpeedMps(end_s + 1.0), 0.0);
  EXPECT_DOUBLE_EQ(drive.WayM(1e6), drive.Path().LengthM());
  ExpectPose(drive.WorldFromRig(3.0), {4.0, 0.0, 1.5}, 0.0);
}

/// Speed and way never jump, speed stays within its limits, and the way is the integral of the
/// speed.
void ExpectSmooth(const DriveTrajectory& drive, const DriveTrajectory::Speeds& speeds) {
  constexpr double kStepS = 1e-3;
  const auto& segments = drive.Path().Segments();
  for (double t_s = 0.0; t_s < drive.EndTimeS() + 1.0; t_s += kStepS) {
    const double speed_mps = drive.SpeedMps(t_s);
    const double next_mps = drive.SpeedMps(t_s + kStepS);
    ASSERT_LE(std::abs(next_mps - speed_mps), speeds.acceleration_mps2 * kStepS * (1.0 + 1e-9))
        << t_s;
    ASSERT_NEAR(drive.WayM(t_s + kStepS) - drive.WayM(t_s),
                0.5 * (speed_mps + next_mps) * kStepS,
                speeds.acceleration_mps2 * kStepS * kStepS)
        << t_s;
    ASSERT_LE(speed_mps, speeds.cruise_mps * (1.0 + 1e-12)) << t_s;
    ASSERT_GE(speed_mps, -1e-12) << t_s;
    double start_m = 0.0;
    for (const DrivePath::Segment& segment : segments) {
      const double within_m = drive.WayM(t_s) - start_m;
      if (segment.curvature_per_m != 0.0 && within_m > 1e-9 && within_m < segment.length_m - 1e-9) {
        ASSERT_LE(speed_mps, speeds.corner_mps * (1.0 + 1e-12)) << t_s;
      }
      start_m += segment.length_m;
    }
  }
  EXPECT_NEAR(drive.WayM(drive.EndTimeS()), drive.Path().LengthM(), 1e-9);
}

TEST(DriveTrajectory, NeverJumpsInSpeedWhateverTheLengths) {
  for (const auto& [first_m, cross_m, last_m] : {std::array{50.0, 40.0, 60.0},
                                                 std::array{8.0, 40.0, 3.0},
                                                 std::array{2.0, 1.0, 60.0},
                                                 std::array{0.0, 0.0, 0.0},
                                                 std::array{10.0, 0.0, 0.1}}) {
    DrivePath::Shape shape = kShape;
    shape.first_street_m = first_m;
    shape.cross_street_m = cross_m;
    shape.last_street_m = last_m;
    for (const double corner_mps : {1.0, 5.0, 8.0, 20.0}) {
      DriveTrajectory::Speeds speeds = kSpeeds;
      speeds.corner_mps = corner_mps;
      SCOPED_TRACE(testing::Message()
                   << first_m << " " << cross_m << " " << last_m << " " << corner_mps);
      ExpectSmooth(DriveTrajectory(DrivePath(shape), speeds, 0.0), speeds);
    }
  }
}

TEST(DriveTrajectory, PeaksLowerOnAShortStreet) {
  DrivePath::Shape shape = kShape;
  shape.first_street_m = 10.0;
  const DriveTrajectory drive(DrivePath(shape), kSpeeds, 0.0);
  // v^2 / 4 up and (v^2 - 25) / 4 down make 10 m: v^2 = 32.5.
  const double peak_mps = std::sqrt(32.5);
  EXPECT_NEAR(drive.SpeedMps(1.0 + peak_mps / 2.0), peak_mps, 1e-12);
  EXPECT_NEAR(drive.WayM(1.0 + peak_mps / 2.0 + (peak_mps - 5.0) / 2.0), 10.0, 1e-12);
}

TEST(DriveTrajectory, GoesOnAcceleratingInTheCornerWhenTheStreetWasTooShort) {
  DrivePath::Shape shape = kShape;
  shape.first_street_m = 1.0;
  const DriveTrajectory drive(DrivePath(shape), kSpeeds, 0.0);
  // 5 m/s are reached after 2.5 s and 6.25 m, well inside the corner.
  EXPECT_NEAR(drive.SpeedMps(1.0 + 2.0), 4.0, 1e-12);
  EXPECT_NEAR(drive.WayM(1.0 + 2.5), 6.25, 1e-12);
  EXPECT_NEAR(drive.SpeedMps(1.0 + 3.0), 5.0, 1e-12);
}

}  // namespace
}  // namespace pfseq
