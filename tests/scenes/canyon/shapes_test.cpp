// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/shapes.h"

#include "tests/scenes/canyon/canyon_test_support.h"

#include <array>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(Box, IsClosedAndFacesOutward) {
  PartBench bench;
  SurfaceFrame frame;
  frame.origin_m = {5, 7, 1};
  frame.right = Vec3d(1, 1, 0).normalized();
  frame.out = Vec3d(1, -1, 0).normalized();
  AddBox(bench.builder, 0, frame, {0, 0, 0}, {2, 3, 4}, kFacesAll);
  const Scene scene = bench.TakeScene();
  EXPECT_NEAR(SignedVolume(scene), 24.0, 1e-4);
  EXPECT_LT(AreaVectorSum(scene).norm(), 1e-4);
}

TEST(Box, LeavesOutTheFacesThatAreNotNamed) {
  PartBench bench;
  AddBox(bench.builder, 0, SurfaceFrame(), {0, 0, 0}, {2, 3, 4}, kFacesOnWall);
  // Without the back (2 x 3 m, facing -out) the areas no longer cancel.
  const Vec3d sum = AreaVectorSum(bench.TakeScene());
  EXPECT_TRUE(sum.isApprox(6.0 * SurfaceFrame().out, 1e-6)) << sum.transpose();
}

TEST(Pillar, HoldsThePrismsVolume) {
  PartBench bench;
  AddPillar(bench.builder, 0, Vec3d::Zero(), 0.5, 2.0, 6);
  // The bottom lies in z = 0 and adds nothing; vertices lie on a grid of 0.01 mm.
  EXPECT_NEAR(SignedVolume(bench.TakeScene()), 3.0 * std::sqrt(3.0) / 2.0 * 0.25 * 2.0, 2e-5);
}

TEST(Moulding, RunsAroundASquareWithMitres) {
  PartBench bench;
  const WallPath path{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, true};
  const std::array<Vec2d, 4> profile = {Vec2d(0, 1), Vec2d(0.5, 1), Vec2d(0.5, 2), Vec2d(0, 2)};
  AddMoulding(bench.builder, 0, path, profile);
  const Bounds bounds = BoundsOfScene(bench.TakeScene());
  EXPECT_TRUE(bounds.low_m.isApprox(Vec3f(-0.5F, -0.5F, 1.0F)));
  EXPECT_TRUE(bounds.high_m.isApprox(Vec3f(4.5F, 4.5F, 2.0F)));
}

TEST(Moulding, IsClosedButForItsWall) {
  PartBench bench;
  const WallPath path{{{0, 0}, {3, 0}}, false};
  const std::array<Vec2d, 4> profile = {Vec2d(0, 1), Vec2d(0.2, 1), Vec2d(0.4, 2), Vec2d(0, 2)};
  AddMoulding(bench.builder, 0, path, profile);
  // What is missing is the strip of wall, 3 x 1 m, that would face +Y.
  const Vec3d sum = AreaVectorSum(bench.TakeScene());
  EXPECT_TRUE(sum.isApprox(Vec3d(0, -3, 0), 1e-6)) << sum.transpose();
}

TEST(InsetPolygon, MovesEachEdgeByItsOwnAmount) {
  const std::array<Vec2d, 4> square = {Vec2d(0, 0), Vec2d(4, 0), Vec2d(4, 4), Vec2d(0, 4)};
  const std::array<double, 4> inset_m = {1.0, 0.0, 0.5, 0.25};
  const std::vector<Vec2d> inner = InsetPolygon(square, inset_m);
  EXPECT_TRUE(inner[0].isApprox(Vec2d(0.25, 1.0)));
  EXPECT_TRUE(inner[1].isApprox(Vec2d(4.0, 1.0)));
  EXPECT_TRUE(inner[2].isApprox(Vec2d(4.0, 3.5)));
  EXPECT_TRUE(inner[3].isApprox(Vec2d(0.25, 3.5)));
}

TEST(LevelPolygon, FacesUp) {
  PartBench bench;
  const std::array<Vec2d, 4> square = {Vec2d(0, 0), Vec2d(4, 0), Vec2d(4, 4), Vec2d(0, 4)};
  AddLevelPolygon(bench.builder, 0, square, 3.0);
  EXPECT_TRUE(AreaVectorSum(bench.TakeScene()).isApprox(Vec3d(0, 0, 16)));
}

}  // namespace
}  // namespace pfseq
