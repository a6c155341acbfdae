// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/trajectory.h"

#include "renderer/core/units.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(PoseFromYaw, TurnsForwardToTheLeftSeenFromAbove) {
  const RigidTransform pose = PoseFromYaw({1.0, 2.0, 3.0}, RadFromDeg(30.0));
  EXPECT_LT((pose.Direction(Vec3d::UnitX()) - Vec3d(0.8660254037844387, 0.5, 0.0)).norm(), 1e-15);
  EXPECT_LT((pose.Direction(Vec3d::UnitZ()) - Vec3d::UnitZ()).norm(), 1e-15);
  EXPECT_EQ(pose.Point(Vec3d::Zero()), Vec3d(1.0, 2.0, 3.0));
}

TEST(YawRad, IsTheInverseOfPoseFromYaw) {
  for (double yaw_deg = -179.0; yaw_deg <= 179.0; yaw_deg += 1.0) {
    EXPECT_NEAR(
        YawRad(PoseFromYaw(Vec3d::Zero(), RadFromDeg(yaw_deg))), RadFromDeg(yaw_deg), 1e-15);
  }
  EXPECT_NEAR(YawRad(PoseFromYaw(Vec3d::Zero(), RadFromDeg(200.0))), RadFromDeg(-160.0), 1e-15);
}

}  // namespace
}  // namespace pfseq
