// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/lift.h"

#include "renderer/lens/trajectory.h"
#include "tests/support/simple_scenes.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// 100 px for 90 degrees, centre (50, 40).
const Lens kLens(Equidistant{}, Vec2d::Constant(100.0 / std::numbers::pi), Vec2d(50.0, 40.0), 1.5);

TEST(LiftByMap, PutsThePointOnItsRayAtTheMapsDistance) {
  Image<float> distance_m(100, 80, 1, 10.0F);
  distance_m.At(75, 40) = 4.0F;
  // 25 px to the right are 45 degrees.
  const std::optional<Vec3d> point_m = LiftByMap({75.0, 40.0}, kLens, {}, distance_m);
  ASSERT_TRUE(point_m);
  EXPECT_LT((*point_m - 4.0 * Vec3d(1.0, 0.0, 1.0).normalized()).norm(), 1e-9);
}

TEST(LiftByMap, TakesTheDistanceOfThePixelThatContainsThePoint) {
  Image<float> distance_m(100, 80, 1, 10.0F);
  distance_m.At(60, 30) = 3.0F;
  for (const Vec2d& inside : {Vec2d(60.01, 30.01), Vec2d(60.99, 30.99)}) {
    EXPECT_NEAR(LiftByMap(inside, kLens, {}, distance_m)->norm(), 3.0, 1e-9);
  }
  for (const Vec2d& outside : {Vec2d(59.99, 30.5), Vec2d(60.5, 31.01)}) {
    EXPECT_NEAR(LiftByMap(outside, kLens, {}, distance_m)->norm(), 10.0, 1e-9);
  }
}

TEST(LiftByMap, AppliesThePoseOfTheCamera) {
  const Image<float> distance_m(100, 80, 1, 2.0F);
  const RigidTransform world_from_camera = PoseFromYaw({1.0, 2.0, 3.0}, std::numbers::pi / 2.0);
  const Vec3d point_m = *LiftByMap({75.0, 40.0}, kLens, world_from_camera, distance_m);
  const Vec3d expected_m = Vec3d(1.0, 2.0, 3.0) + 2.0 * Vec3d(0.0, 1.0, 1.0).normalized();
  EXPECT_LT((point_m - expected_m).norm(), 1e-9);
}

TEST(LiftByMap, HasNoPointInTheSkyOutsideTheCircleAndOutsideTheImage) {
  Image<float> distance_m(100, 80, 1, kInfinity);
  EXPECT_FALSE(LiftByMap({50.0, 40.0}, kLens, {}, distance_m));
  distance_m = Image<float>(100, 80, 1, 0.0F);
  EXPECT_FALSE(LiftByMap({50.0, 40.0}, kLens, {}, distance_m));
  distance_m = Image<float>(100, 80, 1, 5.0F);
  EXPECT_FALSE(LiftByMap({1.0, 1.0}, kLens, {}, distance_m));
  EXPECT_FALSE(LiftByMap({50.0, -0.01}, kLens, {}, distance_m));
  EXPECT_FALSE(LiftByMap({50.0, 80.0}, kLens, {}, distance_m));
}

TEST(LiftByRay, MeetsTheSceneWhereTheVeryRayGoes) {
  const RayScene scene(BoxScene({-5.0F, -5.0F, -5.0F}, {5.0F, 5.0F, 2.0F}));
  const RigidTransform world_from_camera = PoseFromYaw({0.5, 0.0, 0.0}, std::numbers::pi / 2.0);
  // 25 px to the right are 45 degrees: (0, 1, 1) in the world, to the ceiling at 2 m.
  const auto point_m = LiftByRay({75.0, 40.0}, kLens, world_from_camera, scene, 500.0);
  ASSERT_TRUE(point_m);
  EXPECT_LT((*point_m - Vec3d(0.5, 2.0, 2.0)).norm(), 1e-6);
  // A tenth of a pixel further is another point, though the pixel is the same.
  const auto beside_m = LiftByRay({75.1, 40.0}, kLens, world_from_camera, scene, 500.0);
  EXPECT_GT((*beside_m - *point_m).norm(), 0.003);
}

TEST(LiftByRay, HasNoPointBeyondTheMaximumAndOutsideTheField) {
  const RayScene scene(BoxScene({-5.0F, -5.0F, -5.0F}, {5.0F, 5.0F, 2.0F}));
  EXPECT_TRUE(LiftByRay({50.0, 40.0}, kLens, {}, scene, 2.1));
  EXPECT_FALSE(LiftByRay({50.0, 40.0}, kLens, {}, scene, 1.9));
  EXPECT_FALSE(LiftByRay({1.0, 1.0}, kLens, {}, scene, 500.0));
}

}  // namespace
}  // namespace pfseq
