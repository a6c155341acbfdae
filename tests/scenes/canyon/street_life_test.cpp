// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_life.h"

#include "renderer/trace/ray_scene.h"
#include "scenes/canyon/roof_props.h"
#include "scenes/canyon/street_props.h"
#include "scenes/canyon/tree.h"
#include "scenes/canyon/vehicle.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <functional>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Rays at a thing from all around and above.
SurfaceFaults BacksOf(const Scene& scene) {
  const RayScene rays(std::make_shared<const Scene>(scene));
  const Bounds bounds = BoundsOfScene(scene);
  const Vec3d center_m = 0.5 * (bounds.low_m + bounds.high_m).cast<double>();
  SurfaceFaults faults;
  RandomStream random({8});
  for (int i = 0; i < 20000; ++i) {
    const Vec3d target_m =
        center_m + 0.5 * Vec3d(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1))
                             .cwiseProduct((bounds.high_m - bounds.low_m).cast<double>());
    const Vec3d back = RandomDirection(random, 0.02);
    const auto hit = rays.Intersect(Vec3d(target_m + 30.0 * back), -back);
    ++faults.num_checked;
    if (hit && hit->geometric_normal.dot(back) < 0.0 && !IsSheet(scene.meshes[hit->mesh_idx])) {
      faults.texts.push_back(scene.meshes[hit->mesh_idx].name);
    }
  }
  return faults;
}

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
    const SurfaceFaults backs = BacksOf(scene);
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

using PropBuilder = std::function<void(const BuildContext&, const SurfaceFrame&, RandomStream&)>;

TEST(StreetProps, ShowNoBackFacesAndStandOnThePavement) {
  const std::vector<PropBuilder> builders = {
      [](const BuildContext& context, const SurfaceFrame& frame, RandomStream&) {
        BuildLampPost(context, frame, 7.0);
      },
      [](const BuildContext& context, const SurfaceFrame& frame, RandomStream&) {
        BuildBollard(context, frame);
      },
      BuildTrafficLight,
      BuildSignPost,
      BuildPerson,
      BuildAdvertisingColumn,
      BuildBusShelter,
      BuildCabinet};
  for (size_t i = 0; i < builders.size(); ++i) {
    PartBench bench;
    RandomStream random({4, i});
    builders[i](bench.Context(), SurfaceFrame(), random);
    const Scene scene = bench.TakeScene();
    const SurfaceFaults backs = BacksOf(scene);
    EXPECT_TRUE(backs.texts.empty())
        << i << ": " << backs.texts.size() << " " << backs.texts.front();
    EXPECT_NEAR(BoundsOfScene(scene).low_m.z(), -0.015, 0.015) << i;
    EXPECT_TRUE(FindDegenerate(scene).texts.empty()) << i;
  }
}

TEST(Roofline, AntennasShowNoBackFaces) {
  PartBench bench;
  RandomStream random({4});
  BuildAntenna(bench.Context(), Vec3d::Zero(), random);
  EXPECT_TRUE(BacksOf(bench.TakeScene()).texts.empty());
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

TEST(StreetLife, WiresHangHighOverTheStreet) {
  PartBench bench;
  const StreetPlan plan = PlanStreets({}, {});
  HangWires(bench.Context(), plan, 3);
  const Scene scene = bench.TakeScene();
  ASSERT_FALSE(scene.meshes.empty());
  EXPECT_GT(BoundsOfScene(scene).low_m.z(), 4.5F);
  EXPECT_LT(BoundsOfScene(scene).high_m.z(), 9.8F);
}

}  // namespace
}  // namespace pfseq
