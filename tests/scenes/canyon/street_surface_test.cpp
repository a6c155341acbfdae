// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_surface.h"

#include "renderer/trace/ray_scene.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(StreetSurface, CarriagewayLiesAtZeroUnderTheWholeDrive) {
  PartBench bench;
  const StreetPlan plan = PlanStreets({}, {});
  BuildCarriageways(bench.Context(), plan);
  for (const Block& block : plan.blocks) {
    BuildPavement(bench.Context(), block);
  }
  const Scene scene = bench.TakeScene();
  EXPECT_TRUE(FindOverlaps(scene).texts.empty()) << FindOverlaps(scene).texts.front();
  const RayScene rays(std::make_shared<const Scene>(scene));
  for (const Vec2d& point_m : plan.drive_path_m) {
    for (const double side_m : {-1.0, 0.0, 1.0}) {
      const auto hit =
          rays.Intersect(Vec3d(point_m.x() + side_m, point_m.y() + side_m, 10.0), -Vec3d::UnitZ());
      ASSERT_TRUE(hit);
      // Asphalt, or paint 4 mm above it.
      EXPECT_NEAR(hit->distance_m, 9.998, 0.003);
    }
  }
}

TEST(StreetSurface, KerbIsAStepOfTwelveCentimetres) {
  PartBench bench;
  Block block;
  block.island = {{0, 0}, {40, 30}};
  BuildPavement(bench.Context(), block);
  const RayScene rays(std::make_shared<const Scene>(bench.TakeScene()));
  const auto top = rays.Intersect(Vec3d(20, 0.1, 10.0), -Vec3d::UnitZ());
  const auto face = rays.Intersect(Vec3d(20, -5.0, 0.06), Vec3d::UnitY());
  ASSERT_TRUE(top && face);
  EXPECT_NEAR(10.0 - top->distance_m, 0.12, 1e-6);
  EXPECT_NEAR(face->distance_m, 5.0, 1e-6);
  // Corners are round: the very corner is carriageway.
  EXPECT_FALSE(rays.Intersect(Vec3d(0.3, 0.3, 10.0), -Vec3d::UnitZ()));
}

}  // namespace
}  // namespace pfseq
