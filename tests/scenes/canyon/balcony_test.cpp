// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/balcony.h"

#include "renderer/trace/ray_scene.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(Balcony, SticksOutAsFarAsAskedAndStandsOnItsSlab) {
  PartBench bench;
  BuildBalcony(bench.Context(), Building(), SurfaceFrame(), 1.0, 4.0, 5.0, 0.9, Lod::kFine);
  const Scene scene = bench.TakeScene();
  const Bounds bounds = BoundsOfScene(scene);
  EXPECT_NEAR(bounds.low_m.y(), -0.9, 0.02);
  EXPECT_NEAR(bounds.high_m.y(), 0.0, 0.02);
  EXPECT_NEAR(bounds.low_m.x(), 1.0, 0.01);
  EXPECT_NEAR(bounds.high_m.x(), 4.0, 0.01);
  EXPECT_NEAR(bounds.high_m.z(), 6.0, 0.05);
  EXPECT_EQ(bench.stats.num_balconies, 1);
  EXPECT_TRUE(FindOverlaps(scene).texts.empty()) << FindOverlaps(scene).texts.front();
}

TEST(Balcony, RailingIsDenserCloseBy) {
  const auto triangles = [](Lod lod, double detail) {
    PartBench bench;
    BuildRailing(bench.Context(detail), 0, SurfaceFrame(), 0.0, 3.0, 0.0, 0.9, lod);
    return bench.TakeScene().NumTriangles();
  };
  EXPECT_GT(triangles(Lod::kFine, 1.0), 2 * triangles(Lod::kMedium, 1.0));
  EXPECT_GT(triangles(Lod::kFine, 2.0), triangles(Lod::kFine, 1.0));
}

TEST(Balcony, OfPlateIsOpaqueFromTheStreet) {
  PartBench bench;
  BuildPlateBalcony(bench.Context(), Building(), SurfaceFrame(), 0.0, 3.0, 5.0);
  const RayScene rays(std::make_shared<const Scene>(bench.TakeScene()));
  for (double u_m = 0.05; u_m < 3.0; u_m += 0.1) {
    const auto hit = rays.Intersect(Vec3d(u_m, -5.0, 5.5), Vec3d::UnitY());
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance_m, 5.0 - 1.1, 0.02);
  }
}

TEST(Balcony, FrenchOneStaysBeforeItsWindow) {
  PartBench bench;
  BuildFrenchBalcony(bench.Context(), SurfaceFrame(), {{1, 3}, {2, 5}}, Lod::kFine);
  const Bounds bounds = BoundsOfScene(bench.TakeScene());
  EXPECT_GT(bounds.low_m.x(), 0.9F);
  EXPECT_LT(bounds.high_m.x(), 2.1F);
  EXPECT_GT(bounds.low_m.y(), -0.15F);
  EXPECT_LT(bounds.high_m.z(), 4.1F);
}

}  // namespace
}  // namespace pfseq
