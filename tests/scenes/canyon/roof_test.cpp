// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/roof.h"

#include "renderer/trace/ray_scene.h"
#include "scenes/canyon/party_wall.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <array>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

class Roof : public testing::TestWithParam<RoofKind> {};

TEST_P(Roof, ClosesTheHouseFromAbove) {
  for (const double detail : {0.0, 2.0}) {
    PartBench bench;
    Building house = RowHouse(bench.palette, FacadeStyle::kPlaster, 30, detail);
    house.roof = GetParam();
    house.roof_rise_m = house.roof == RoofKind::kFlat ? 0.5 : 3.2;
    const std::vector<Lod> lods = {Lod::kFine, Lod::kFlush, Lod::kFlush, Lod::kFlush};
    BuildRoof(bench.Context(detail), house, lods);
    BuildBlankWalls(std::array{house}, 0, bench.builder);
    const Scene scene = bench.TakeScene();
    const SurfaceFaults overlaps = FindOverlaps(scene);
    EXPECT_TRUE(overlaps.texts.empty()) << overlaps.texts.front();
    const RayScene rays(std::make_shared<const Scene>(scene));
    RandomStream random({1});
    for (int i = 0; i < 20000; ++i) {
      const Vec3d target_m(random.Uniform(0.01, 13.99), random.Uniform(0.01, 10.99), house.eave_m);
      const Vec3d back =
          Vec3d(random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0), 1.0).normalized();
      const auto hit = rays.Intersect(Vec3d(target_m + 30.0 * back), -back);
      ASSERT_TRUE(hit) << target_m.transpose();
      ASSERT_GT(hit->geometric_normal.dot(back), 0.0) << target_m.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         Roof,
                         testing::Values(RoofKind::kFlat, RoofKind::kMansard, RoofKind::kGable),
                         [](const auto& test) { return std::string(NameOf(test.param)); });

TEST(RoofHeight, FlatLiesUnderItsParapet) {
  PartBench bench;
  Building house = RowHouse(bench.palette, FacadeStyle::kPlaster, 30, 0.0);
  house.roof = RoofKind::kFlat;
  house.roof_rise_m = 0.5;
  BuildRoof(bench.Context(0.0), house, std::vector<Lod>(4, Lod::kCoarse));
  const RayScene rays(std::make_shared<const Scene>(bench.TakeScene()));
  const auto middle = rays.Intersect(Vec3d(7, 5, 100), -Vec3d::UnitZ());
  const auto parapet = rays.Intersect(Vec3d(7, 0.1, 100), -Vec3d::UnitZ());
  ASSERT_TRUE(middle && parapet);
  EXPECT_NEAR(100.0 - middle->distance_m, house.eave_m - 0.5, 1e-4);
  EXPECT_NEAR(100.0 - parapet->distance_m, house.eave_m, 1e-4);
}

TEST(RoofHeight, GableHasItsRidgeInTheMiddle) {
  PartBench bench;
  Building house = RowHouse(bench.palette, FacadeStyle::kPlaster, 30, 0.0);
  house.roof = RoofKind::kGable;
  house.roof_rise_m = 4.0;
  BuildRoof(bench.Context(0.0), house, std::vector<Lod>(4, Lod::kCoarse));
  const RayScene rays(std::make_shared<const Scene>(bench.TakeScene()));
  const auto ridge = rays.Intersect(Vec3d(7, 5.5, 100), -Vec3d::UnitZ());
  const auto half = rays.Intersect(Vec3d(7, 2.75, 100), -Vec3d::UnitZ());
  ASSERT_TRUE(ridge && half);
  EXPECT_NEAR(100.0 - ridge->distance_m, house.eave_m + 4.0, 1e-4);
  EXPECT_NEAR(100.0 - half->distance_m, house.eave_m + 2.0, 1e-4);
}

}  // namespace
}  // namespace pfseq
