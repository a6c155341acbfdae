// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/facade.h"

#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

class Facade : public testing::TestWithParam<FacadeStyle> {};

TEST_P(Facade, StreetFrontIsClosedAndWithoutOverlaps) {
  for (const Lod lod : {Lod::kFine, Lod::kMedium, Lod::kCoarse}) {
    for (const double detail : {0.0, 1.0, 2.0}) {
      PartBench bench;
      const Building house = RowHouse(bench.palette, GetParam(), 10, detail);
      BuildFacades(bench.Context(detail), house, {lod, Lod::kFlush, Lod::kFlush, Lod::kFlush});
      AddBox(bench.builder, 0, SurfaceFrame(), {-50, -1, -50}, {50, kKerbHeight_m, 50}, kFaceTop);
      const Scene scene = bench.TakeScene();
      const SurfaceFaults holes = FindHoles(scene, 14.0, kKerbHeight_m, house.eave_m);
      EXPECT_TRUE(holes.texts.empty()) << static_cast<int>(lod) << ": " << holes.texts.front();
      const SurfaceFaults overlaps = FindOverlaps(scene);
      EXPECT_TRUE(overlaps.texts.empty()) << overlaps.texts.front();
    }
  }
}

TEST_P(Facade, EveryUpperFloorHasWindows) {
  PartBench bench;
  const Building house = RowHouse(bench.palette, GetParam(), 20, 1.0);
  BuildFacades(bench.Context(), house, {Lod::kFine, Lod::kFlush, Lod::kFlush, Lod::kFlush});
  EXPECT_GT(bench.stats.num_windows, 2 * 3 * house.num_upper_floors);
}

/// How far a street front in the plane y = 0 stands out (toward -y).
double Protrusion(FacadeStyle style, double relief) {
  PartBench bench;
  Building house = RowHouse(bench.palette, style, 10, 1.0);
  house.roof = RoofKind::kFlat;
  // No downpipe, which is as thick on any front.
  house.cornice_m = 0.0;
  BuildContext context = bench.Context();
  context.relief = relief;
  BuildFacades(context, house, {Lod::kFine, Lod::kFlush, Lod::kFlush, Lod::kFlush});
  double most_m = 0.0;
  for (const Mesh& mesh : bench.TakeScene().meshes) {
    for (const Vec3f& vertex_m : mesh.positions_m) {
      most_m = std::max(most_m, -static_cast<double>(vertex_m.y()));
    }
  }
  return most_m;
}

TEST_P(Facade, ReliefScalesHowFarAFrontStandsOut) {
  const double ordinary_m = Protrusion(GetParam(), 1.0);
  EXPECT_GT(ordinary_m, 0.02);
  EXPECT_NEAR(Protrusion(GetParam(), 0.3), 0.3 * ordinary_m, 0.1 * ordinary_m + 0.01);
}

INSTANTIATE_TEST_SUITE_P(Styles,
                         Facade,
                         testing::Values(FacadeStyle::kBrick,
                                         FacadeStyle::kInterwar,
                                         FacadeStyle::kPlaster,
                                         FacadeStyle::kAshlar,
                                         FacadeStyle::kConcrete,
                                         FacadeStyle::kGlass),
                         [](const auto& test) { return std::string(NameOf(test.param)); });

TEST(FacadeFrame, LooksOutOfTheFootprint) {
  Building house;
  house.lot.footprint_m = {{0, 0}, {14, 0}, {14, 11}, {0, 11}};
  const SurfaceFrame east = FrameOfEdge(house, 1);
  EXPECT_TRUE(east.out.isApprox(Vec3d::UnitX()));
  EXPECT_TRUE(east.right.isApprox(Vec3d::UnitY()));
  EXPECT_TRUE(east.At(2, 3, 1).isApprox(Vec3d(15, 2, 3)));
  EXPECT_DOUBLE_EQ(EdgeLength(house, 1), 11.0);
}

TEST(BayGrid, FillsTheFrontWithBaysOfAboutTheWantedWidth) {
  Building house;
  house.bay_width_m = 2.8;
  const BayGrid grid = GridOf(house, 14.0);
  EXPECT_EQ(grid.num_bays, 5);
  EXPECT_NEAR(grid.Center(0) + grid.Center(4), 14.0, 1e-9);
  EXPECT_EQ(GridOf(house, 1.2).num_bays, 0);
}

}  // namespace
}  // namespace pfseq
