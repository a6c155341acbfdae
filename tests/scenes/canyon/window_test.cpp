// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/window.h"

#include "renderer/trace/ray_scene.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Scene WallWithWindow(Lod lod, const WindowDesign& design, double detail) {
  PartBench bench;
  Building house;
  house.window = design;
  const Opening opening{{1.0, 1.0}, {2.2, 2.8}};
  RandomStream random({1});
  BuildWallWithOpenings(
      bench.builder, 0, SurfaceFrame(), {0, 0}, {3, 4}, {{1.0, 2.2, {{1.0, 2.8}}}});
  BuildWindow(bench.Context(detail), house, SurfaceFrame(), opening, 0, lod, random);
  return bench.TakeScene();
}

TEST(Window, ClosesItsOpeningAtEachLevelOfDetail) {
  WindowDesign design;
  design.transom_share = 0.3;
  design.has_surround = true;
  design.blind_share = 1.0;
  for (const Lod lod : {Lod::kFine, Lod::kMedium, Lod::kCoarse, Lod::kFlush}) {
    const Scene scene = WallWithWindow(lod, design, 1.0);
    const SurfaceFaults holes = FindHoles(scene, 3.0, 0.0, 4.0);
    EXPECT_TRUE(holes.texts.empty()) << static_cast<int>(lod) << ": " << holes.texts.front();
    const SurfaceFaults overlaps = FindOverlaps(scene);
    EXPECT_TRUE(overlaps.texts.empty()) << overlaps.texts.front();
  }
}

TEST(Window, LiesInItsReveal) {
  WindowDesign design;
  design.reveal_m = 0.3;
  const RayScene rays(std::make_shared<const Scene>(WallWithWindow(Lod::kFine, design, 0.0)));
  // Rim of the frame at the reveal's depth, a pane behind it.
  const auto frame = rays.Intersect(Vec3d(1.02, -5.0, 1.02), Vec3d::UnitY());
  const auto pane = rays.Intersect(Vec3d(1.3, -5.0, 1.5), Vec3d::UnitY());
  ASSERT_TRUE(frame && pane);
  EXPECT_NEAR(frame->distance_m, 5.3, 1e-6);
  EXPECT_NEAR(pane->distance_m, 5.335, 1e-6);
}

TEST(Window, FinerLevelsHaveMoreTriangles) {
  const WindowDesign design;
  const size_t fine = WallWithWindow(Lod::kFine, design, 1.0).NumTriangles();
  const size_t medium = WallWithWindow(Lod::kMedium, design, 1.0).NumTriangles();
  const size_t coarse = WallWithWindow(Lod::kCoarse, design, 1.0).NumTriangles();
  EXPECT_GT(fine, medium);
  EXPECT_GT(medium, coarse);
}

TEST(Glazing, PanesShowOnePictureTogether) {
  PartBench bench;
  Glazing glazing;
  glazing.frame = 0;
  glazing.glass = 1;
  glazing.num_columns = 2;
  glazing.rim_m = 0.1;
  glazing.bar_m = 0.2;
  BuildGlazing(bench.builder, SurfaceFrame(), {{0, 0}, {2, 1}}, 0.0, glazing);
  const Scene scene = bench.TakeScene();
  const Mesh& panes = scene.meshes[1];
  ASSERT_EQ(panes.triangles.size(), 4U);
  // The left pane goes from 0.1 to 0.9 m of 2 m.
  EXPECT_FLOAT_EQ(panes.texcoords[0].x(), 0.05F);
  EXPECT_FLOAT_EQ(panes.texcoords[1].x(), 0.45F);
  EXPECT_FLOAT_EQ(panes.texcoords[0].y(), 0.9F);
  EXPECT_FLOAT_EQ(panes.texcoords[2].y(), 0.1F);
}

TEST(AtlasCell, LiesInsideOneCell) {
  RandomStream random({3});
  for (int i = 0; i < 100; ++i) {
    const TextureWindow cell = AtlasCell(4, random);
    EXPECT_EQ(std::floor(cell.u0 * 4), std::floor(cell.u1 * 4));
    EXPECT_EQ(std::floor(cell.v0 * 4), std::floor(cell.v1 * 4));
    EXPECT_LT(cell.u0, cell.u1);
  }
}

}  // namespace
}  // namespace pfseq
