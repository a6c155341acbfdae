// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/curtain_wall.h"

#include "renderer/trace/ray_scene.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Scene Wall(Lod lod, PartBench& bench) {
  Building house;
  house.num_upper_floors = 4;
  house.floor_height_m = 3.0;
  house.eave_m = 17.0;
  house.bay_width_m = 1.5;
  house.frame = 1;
  RandomStream random({1});
  BuildCurtainWall(bench.Context(), house, SurfaceFrame(), 12.0, 4.0, lod, random);
  return bench.TakeScene();
}

TEST(CurtainWall, IsClosedThoughItsPanesAreOutOfTrue) {
  for (const Lod lod : {Lod::kFine, Lod::kMedium}) {
    PartBench bench;
    const SurfaceFaults holes = FindHoles(Wall(lod, bench), 12.0, 4.0, 17.0);
    EXPECT_TRUE(holes.texts.empty()) << holes.texts.front();
    EXPECT_EQ(bench.stats.num_windows, 8 * 4);
  }
}

TEST(CurtainWall, PanesLieBehindMullionsWithinMillimetres) {
  PartBench bench;
  const RayScene rays(std::make_shared<const Scene>(Wall(Lod::kFine, bench)));
  const auto pane = rays.Intersect(Vec3d(0.75, -5.0, 6.0), Vec3d::UnitY());
  const auto mullion = rays.Intersect(Vec3d(1.5, -5.0, 6.0), Vec3d::UnitY());
  ASSERT_TRUE(pane && mullion);
  EXPECT_GE(pane->distance_m, 5.0);
  EXPECT_LE(pane->distance_m, 5.0065);
  EXPECT_NEAR(mullion->distance_m, 4.9, 1e-6);
}

}  // namespace
}  // namespace pfseq
