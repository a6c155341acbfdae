// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/vehicle.h"

#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// A vehicle on a road at z = 0 that drives along X.
struct Vehicle {
  explicit Vehicle(VehicleKind kind, uint64_t seed = 1) {
    RandomStream random({seed});
    BuildVehicle(bench.Context(), kind, SurfaceFrame(), random);
    scene = bench.TakeScene();
    bounds = BoundsOfScene(scene);
  }

  Bounds BoundsOf(int Palette::*member) const {
    return BoundsOfScene(PartOf(scene, bench.palette.*member));
  }
  /// The paints among its materials.
  std::set<int> Paints() const {
    std::set<int> paints;
    for (const int paint : bench.palette.car_paint) {
      if (!PartOf(scene, paint).meshes.empty()) {
        paints.insert(paint);
      }
    }
    return paints;
  }

  PartBench bench;
  Scene scene;
  Bounds bounds;
};

class VehicleOf : public testing::TestWithParam<VehicleKind> {};

TEST_P(VehicleOf, StandsOnTheRoadAndIsAsLargeAsItSays) {
  const Vehicle vehicle(GetParam());
  const Vec2d size_m = VehicleSize(GetParam());
  EXPECT_EQ(vehicle.bench.stats.num_vehicles, 1);
  EXPECT_NEAR(vehicle.bounds.low_m.z(), 0.0, 1e-6);
  EXPECT_NEAR(vehicle.BoundsOf(&Palette::tyre).low_m.z(), 0.0, 1e-6);
  const Vec3f extent_m = vehicle.bounds.high_m - vehicle.bounds.low_m;
  EXPECT_NEAR(extent_m.x(), size_m.x(), 0.1);
  // Its mirrors stand out; its wheels and its body do not.
  EXPECT_GT(extent_m.y(), size_m.y());
  EXPECT_LT(extent_m.y(), size_m.y() + 0.4);
  const Bounds tyres = vehicle.BoundsOf(&Palette::tyre);
  EXPECT_NEAR(tyres.high_m.y() - tyres.low_m.y(), size_m.y(), 0.02);
  // Its two sides are alike.
  EXPECT_NEAR(vehicle.bounds.high_m.y(), -vehicle.bounds.low_m.y(), 1e-5);
  EXPECT_GT(extent_m.z(), 1.3);
  EXPECT_LT(extent_m.z(), 3.5);
}

TEST_P(VehicleOf, IsClosed) {
  const Vehicle vehicle(GetParam());
  const SurfaceFaults backs = FindBacksFrom(Vec3d::UnitZ(), vehicle.scene);
  EXPECT_GT(backs.num_checked, 10000);
  EXPECT_TRUE(backs.texts.empty()) << backs.texts.size() << " " << backs.texts.front();
  EXPECT_TRUE(FindDegenerate(vehicle.scene).texts.empty());
  EXPECT_LT(AreaVectorSum(vehicle.scene).norm(), 1e-3);
  EXPECT_GT(SignedVolume(vehicle.scene), 2.0);
}

TEST_P(VehicleOf, HasItsTailLampsBehindAndItsHeadLampsBefore) {
  const Vehicle vehicle(GetParam());
  const double half_m = 0.5 * VehicleSize(GetParam()).x();
  const Bounds tail = vehicle.BoundsOf(&Palette::tail_lamp);
  EXPECT_LT(tail.high_m.x(), -0.9 * half_m);
  EXPECT_LT(tail.low_m.x(), -half_m);
  // One on each side.
  EXPECT_NEAR(tail.low_m.y(), -tail.high_m.y(), 1e-5);
  EXPECT_GT(tail.high_m.y(), 0.5);
  // Number plates are of the head lamps' material, at both ends.
  const Bounds pale = vehicle.BoundsOf(&Palette::head_lamp);
  EXPECT_GT(pale.high_m.x(), half_m);
  EXPECT_LT(pale.low_m.x(), -half_m);
}

TEST_P(VehicleOf, ShowsGlassAboveItsPaint) {
  const Vehicle vehicle(GetParam());
  const Bounds glass = vehicle.BoundsOf(&Palette::car_glass);
  EXPECT_GT(glass.low_m.z(), 0.25 * vehicle.bounds.high_m.z());
  EXPECT_LE(glass.high_m.z(), vehicle.bounds.high_m.z());
  // A windscreen before the middle.
  EXPECT_GT(glass.high_m.x(), 0.0F);
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         VehicleOf,
                         testing::Values(VehicleKind::kHatchback,
                                         VehicleKind::kSaloon,
                                         VehicleKind::kOffRoader,
                                         VehicleKind::kVan,
                                         VehicleKind::kLorry),
                         [](const auto& test) {
                           return "Kind" + std::to_string(static_cast<int>(test.param));
                         });

TEST(Vehicle, IsOfOnePaintThatIsDrawn) {
  std::set<int> all;
  for (uint64_t seed = 0; seed < 12; ++seed) {
    const std::set<int> paints = Vehicle(VehicleKind::kSaloon, seed).Paints();
    EXPECT_EQ(paints.size(), 1U);
    all.insert(paints.begin(), paints.end());
  }
  EXPECT_EQ(all.size(), PlainPalette().car_paint.size());
}

TEST(Vehicle, FollowsItsFrame) {
  // Along Y.
  PartBench bench;
  RandomStream random({1});
  const Vec3d middle_m(5.0, 7.0, 0.2);
  BuildVehicle(bench.Context(),
               VehicleKind::kHatchback,
               {middle_m, Vec3d::UnitY(), Vec3d::UnitZ(), Vec3d::UnitX()},
               random);
  const Scene scene = bench.TakeScene();
  const Bounds bounds = BoundsOfScene(scene);
  EXPECT_NEAR(bounds.low_m.z(), 0.2, 1e-5);
  EXPECT_NEAR(bounds.high_m.y() - bounds.low_m.y(), 3.95, 0.1);
  EXPECT_NEAR(0.5 * (bounds.high_m.x() + bounds.low_m.x()), 5.0, 1e-3);
  EXPECT_LT(BoundsOfScene(PartOf(scene, bench.palette.tail_lamp)).high_m.y(), 7.0F - 1.7F);
  EXPECT_GT(SignedVolume(scene), 2.0);
}

}  // namespace
}  // namespace pfseq
