// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_life.h"

#include "scenes/canyon/tree.h"
#include "scenes/canyon/vehicle.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(Vehicle, IsClosedOnItsWheelsAndAsLargeAsItSays) {
  for (const VehicleKind kind : {VehicleKind::kHatchback,
                                 VehicleKind::kSaloon,
                                 VehicleKind::kOffRoader,
                                 VehicleKind::kVan,
                                 VehicleKind::kLorry}) {
    PartBench bench;
    RandomStream random({1});
    BuildVehicle(bench.Context(), kind, SurfaceFrame(), random);
    const Scene scene = bench.TakeScene();
    const Bounds bounds = BoundsOfScene(scene);
    EXPECT_NEAR(bounds.low_m.z(), 0.0, 0.01);
    EXPECT_NEAR(bounds.high_m.x() - bounds.low_m.x(), VehicleSize(kind).x(), 0.1);
    // Mirrors stand out.
    EXPECT_NEAR(bounds.high_m.y() - bounds.low_m.y(), VehicleSize(kind).y(), 0.45);
    EXPECT_LT(AreaVectorSum(scene).norm(), 1e-3);
    EXPECT_GT(SignedVolume(scene), 3.0);
    const SurfaceFaults backs = FindBacksFrom(Vec3d::UnitZ(), scene);
    EXPECT_TRUE(backs.texts.empty())
        << static_cast<int>(kind) << ": " << backs.texts.size() << " " << backs.texts.front();
  }
}

TEST(Tree, KeepsItsLeavesInItsCrown) {
  PartBench bench;
  TreeDesign design;
  design.leaf = bench.palette.leaf[0];
  RandomStream random({2});
  BuildTree(bench.Context(), design, {10, 5, 0.1}, random);
  const Scene scene = bench.TakeScene();
  size_t num_leaves = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (!IsSheet(mesh)) {
      continue;
    }
    num_leaves += mesh.triangles.size() / 2;
    for (const Vec3f& position_m : mesh.positions_m) {
      EXPECT_LE((position_m.head<2>() - Vec2f(10, 5)).norm(), design.crown_radius_m + 0.01);
      EXPECT_GT(position_m.z(), 0.5 * design.clear_m);
      EXPECT_LT(position_m.z(), design.height_m + 1.0);
    }
  }
  EXPECT_GT(num_leaves, 800U);
  EXPECT_TRUE(FindDegenerate(scene).texts.empty());
}

CanyonStats StatsOf(double street_life) {
  PartBench bench;
  CanyonSpec canyon;
  canyon.surrounding_blocks = 0;
  BuildCity(bench.Context(1.0, street_life), canyon, {});
  return bench.stats;
}

TEST(StreetLife, ComesInTheAmountAskedFor) {
  const CanyonStats none = StatsOf(0.0);
  const CanyonStats some = StatsOf(0.4);
  const CanyonStats much = StatsOf(2.0);
  EXPECT_EQ(none.num_vehicles + none.num_trees + none.num_people + none.num_wires + none.num_lamps,
            0);
  EXPECT_GT(some.num_vehicles, 5);
  EXPECT_GT(much.num_vehicles, some.num_vehicles);
  EXPECT_GT(much.num_people, some.num_people);
  EXPECT_GT(much.num_trees, 10);
  EXPECT_GT(much.num_wires, some.num_wires);
  EXPECT_GT(much.num_signs, some.num_signs);
}

}  // namespace
}  // namespace pfseq
