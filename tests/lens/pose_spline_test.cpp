// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/pose_spline.h"

#include "renderer/core/units.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

StampedPose PoseAt(double time_s, const Vec3d& position_m, double yaw_deg = 0.0) {
  return {time_s, PoseFromYaw(position_m, RadFromDeg(yaw_deg))};
}

TEST(PoseSpline, PassesExactlyThroughItsPoses) {
  const std::vector<StampedPose> poses = {PoseAt(0.0, {0.1, 0.2, 0.3}, 10.0),
                                          PoseAt(0.7, {1.0, -2.0, 0.5}, 50.0),
                                          PoseAt(1.9, {4.0, 1.0, 0.25}, -20.0),
                                          PoseAt(2.0, {4.5, 1.5, 0.0}, 0.0)};
  const PoseSpline spline(poses);
  for (const StampedPose& pose : poses) {
    EXPECT_EQ(spline.WorldFromRig(pose.time_s).translation_m, pose.world_from_rig.translation_m);
    EXPECT_EQ(spline.WorldFromRig(pose.time_s).rotation.coeffs(),
              pose.world_from_rig.rotation.coeffs());
  }
}

TEST(PoseSpline, IsExactForQuadraticMotionOnUnevenTimes) {
  const auto position_m = [](double t) {
    return Vec3d(1.0 + 2.0 * t - 0.5 * t * t, -t + t * t, 3.0 * t);
  };
  std::vector<StampedPose> poses;
  for (const double t : {0.0, 0.4, 1.5, 1.7, 3.0, 3.1}) {
    poses.push_back(PoseAt(t, position_m(t)));
  }
  const PoseSpline spline(poses);
  for (double t = 0.0; t <= 3.1; t += 0.01) {
    EXPECT_LT((spline.WorldFromRig(t).translation_m - position_m(t)).norm(), 1e-13) << t;
  }
}

TEST(PoseSpline, HasAContinuousVelocity) {
  const PoseSpline spline({PoseAt(0.0, {0.0, 0.0, 0.0}),
                           PoseAt(1.0, {2.0, 1.0, 0.0}),
                           PoseAt(1.5, {2.0, 4.0, 1.0}),
                           PoseAt(3.0, {-1.0, 5.0, 1.0})});
  constexpr double kStepS = 1e-6;
  for (const double t : {1.0, 1.5}) {
    const Vec3d here_m = spline.WorldFromRig(t).translation_m;
    const Vec3d before_mps = (here_m - spline.WorldFromRig(t - kStepS).translation_m) / kStepS;
    const Vec3d after_mps = (spline.WorldFromRig(t + kStepS).translation_m - here_m) / kStepS;
    EXPECT_LT((before_mps - after_mps).norm(), 1e-4);
    EXPECT_GT(before_mps.norm(), 0.5);
  }
}

TEST(PoseSpline, StandsWhereTwoPosesAreEqual) {
  const PoseSpline spline({PoseAt(0.0, {0.0, 0.0, 0.0}),
                           PoseAt(1.0, {1.0, 1.0, 1.0}),
                           PoseAt(2.0, {1.0, 1.0, 1.0}),
                           PoseAt(3.0, {5.0, 0.0, 0.0})});
  for (double t = 1.0; t <= 2.0; t += 0.05) {
    EXPECT_LT((spline.WorldFromRig(t).translation_m - Vec3d(1.0, 1.0, 1.0)).norm(), 1e-15) << t;
  }
}

TEST(PoseSpline, TurnsEvenlyAlongTheShortestArc) {
  // From 170 to -170 degrees is 20 degrees to the left, not 340 to the right.
  StampedPose end = PoseAt(2.0, Vec3d::Zero(), -170.0);
  for (const double sign : {1.0, -1.0}) {
    end.world_from_rig.rotation.coeffs() *= sign;
    const PoseSpline spline({PoseAt(0.0, Vec3d::Zero(), 170.0), end});
    EXPECT_NEAR(YawRad(spline.WorldFromRig(0.5)), RadFromDeg(175.0), 1e-12);
    EXPECT_NEAR(std::abs(YawRad(spline.WorldFromRig(1.0))), RadFromDeg(180.0), 1e-12);
    EXPECT_NEAR(YawRad(spline.WorldFromRig(1.5)), RadFromDeg(-175.0), 1e-12);
  }
}

TEST(PoseSpline, StandsAtTheNearestEndOutsideItsSpan) {
  const PoseSpline spline({PoseAt(1.0, {1.0, 0.0, 0.0}, 5.0), PoseAt(2.0, {2.0, 0.0, 0.0}, 7.0)});
  EXPECT_EQ(spline.WorldFromRig(-3.0).translation_m, Vec3d(1.0, 0.0, 0.0));
  EXPECT_EQ(spline.WorldFromRig(9.0).translation_m, Vec3d(2.0, 0.0, 0.0));
  EXPECT_NEAR(YawRad(spline.WorldFromRig(9.0)), RadFromDeg(7.0), 1e-15);
}

TEST(PoseSpline, OfOnePoseIsThatPose) {
  const PoseSpline spline({PoseAt(1.0, {1.0, 2.0, 3.0}, 5.0)});
  for (const double t : {0.0, 1.0, 2.0}) {
    EXPECT_EQ(spline.WorldFromRig(t).translation_m, Vec3d(1.0, 2.0, 3.0));
  }
}

TEST(PoseSpline, OfTwoPosesIsAStraightLine) {
  const PoseSpline spline({PoseAt(1.0, {1.0, 2.0, 3.0}), PoseAt(3.0, {5.0, 2.0, 1.0})});
  EXPECT_LT((spline.WorldFromRig(1.5).translation_m - Vec3d(2.0, 2.0, 2.5)).norm(), 1e-15);
}

}  // namespace
}  // namespace pfseq
