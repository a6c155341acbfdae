// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/ground_floor.h"

#include "scenes/canyon/shapes.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(GroundFloor, HasNoHolesWhateverItHolds) {
  for (const bool has_shops : {true, false}) {
    for (const double width_m : {1.8, 4.0, 9.5, 23.0}) {
      for (const Lod lod : {Lod::kFine, Lod::kMedium, Lod::kCoarse}) {
        PartBench bench;
        Building house;
        house.has_shops = has_shops;
        RandomStream random({static_cast<uint64_t>(width_m)});
        BuildGroundFloor(
            bench.Context(), house, SurfaceFrame(), width_m, 4.2, true, 8.0, lod, random);
        // The pavement closes the openings that reach down to it.
        AddBox(bench.builder, 0, SurfaceFrame(), {-50, -1, -50}, {50, kKerbHeight_m, 50}, kFaceTop);
        const Scene scene = bench.TakeScene();
        const SurfaceFaults holes = FindHoles(scene, width_m, kKerbHeight_m, 4.2);
        EXPECT_TRUE(holes.texts.empty()) << width_m << " m: " << holes.texts.front();
        const SurfaceFaults overlaps = FindOverlaps(scene);
        EXPECT_TRUE(overlaps.texts.empty()) << overlaps.texts.front();
      }
    }
  }
}

TEST(GroundFloor, CountsItsShops) {
  PartBench bench;
  Building house;
  house.has_shops = true;
  RandomStream random({5});
  BuildGroundFloor(
      bench.Context(), house, SurfaceFrame(), 14.0, 4.2, false, 8.0, Lod::kFine, random);
  EXPECT_GE(bench.stats.num_shops, 2);
  EXPECT_LE(bench.stats.num_shops, 4);
}

TEST(GroundFloor, LeavesRoomToWalkUnderWhatSticksOut) {
  PartBench bench;
  Building house;
  house.has_shops = true;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random({seed});
    BuildGroundFloor(
        bench.Context(2.0), house, SurfaceFrame(), 14.0, 4.2, true, 8.0, Lod::kFine, random);
  }
  const Scene scene = bench.TakeScene();
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3f& position_m : mesh.positions_m) {
      EXPECT_GT(position_m.y(), -1.0F);
      if (position_m.z() > 0.3F && position_m.z() < 2.0F) {
        EXPECT_GT(position_m.y(), -0.15F) << position_m.transpose();
      }
    }
  }
}

}  // namespace
}  // namespace pfseq
