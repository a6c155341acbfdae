// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/rigid_transform.h"

#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

const RigidTransform kQuarterTurn{
    Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3d::UnitZ())),
    Vec3d(10.0, 20.0, 30.0)};

TEST(RigidTransform, QuarterTurnAboutZTakesXToYThenAddsTranslation) {
  EXPECT_LT((kQuarterTurn.Point(Vec3d(1, 2, 3)) - Vec3d(8, 21, 33)).norm(), 1e-14);
  EXPECT_LT((kQuarterTurn.Direction(Vec3d(1, 2, 3)) - Vec3d(-2, 1, 3)).norm(), 1e-14);
}

TEST(RigidTransform, ProductAppliesTheRightFactorFirst) {
  const RigidTransform shift{Eigen::Quaterniond::Identity(), Vec3d(1, 0, 0)};
  EXPECT_LT(((kQuarterTurn * shift).Point(Vec3d::Zero()) - Vec3d(10, 21, 30)).norm(), 1e-14);
  EXPECT_LT(((shift * kQuarterTurn).Point(Vec3d::Zero()) - Vec3d(11, 20, 30)).norm(), 1e-14);
}

TEST(RigidTransform, InverseUndoesTheTransform) {
  const Vec3d point(-4.0, 5.5, 0.25);
  EXPECT_LT((kQuarterTurn.Inverse().Point(kQuarterTurn.Point(point)) - point).norm(), 1e-13);
}

}  // namespace
}  // namespace pfseq
