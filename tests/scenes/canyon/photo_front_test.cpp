// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/photo_front.h"

#include "scenes/canyon/facade_photos.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kFoot_m = kKerbHeight_m - 0.02;
constexpr double kPhotoHeight_m = 10.0;
constexpr double kRecess_m = 0.2;

/// A photograph of 20 x 10 m.
FacadePhoto PhotoWith(std::vector<WallRect> windows) {
  FacadePhoto photo;
  photo.image = std::make_shared<const Image<uint8_t>>(40, 20, 4, uint8_t{250});
  photo.size_m = {20.0, kPhotoHeight_m};
  photo.recess_m = kRecess_m;
  photo.windows = std::move(windows);
  return photo;
}

/// A front in the plane y = 0 that is as high as the photograph, its street at y < 0.
struct Front {
  Front(std::vector<WallRect> windows, double width_m, uint64_t seed = 0) {
    WallPaintings paintings(bench.palette, 0.2);
    BuildContext context = bench.Context();
    context.paintings = &paintings;
    Building house;
    house.photo = std::make_shared<const FacadePhoto>(PhotoWith(std::move(windows)));
    house.eave_m = kPhotoHeight_m + kFoot_m;
    house.seed = seed;
    BuildPhotoFront(context, house, SurfaceFrame(), width_m, 8.0);
    paintings.Finish(bench.palette);
    scene = bench.TakeScene();
  }

  /// Of the triangles that face the street at this depth behind the front.
  double AreaAtDepth(double depth_m) const {
    double area_m2 = 0.0;
    for (const Mesh& mesh : scene.meshes) {
      for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3d corner_m = mesh.positions_m[a].cast<double>();
        const Vec3d area = 0.5 * (mesh.positions_m[b].cast<double>() - corner_m)
                                     .cross(mesh.positions_m[c].cast<double>() - corner_m);
        if (area.y() < -0.99 * area.norm() && std::abs(corner_m.y() - depth_m) < 1e-5) {
          area_m2 += area.norm();
        }
      }
    }
    return area_m2;
  }

  /// Of all triangles that face the street or another way.
  double Area() const {
    double area_m2 = 0.0;
    for (const Mesh& mesh : scene.meshes) {
      for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3f& corner_m = mesh.positions_m[a];
        area_m2 +=
            0.5 * (mesh.positions_m[b] - corner_m).cross(mesh.positions_m[c] - corner_m).norm();
      }
    }
    return area_m2;
  }

  /// How far behind the front a ray from the street ends, at a place of the photograph.
  double DepthAt(double u_m, double v_m) const {
    const RayScene rays(std::make_shared<const Scene>(scene));
    const auto hit = rays.Intersect(Vec3d(u_m, -5.0, kFoot_m + v_m), Vec3d::UnitY());
    return hit ? hit->distance_m - 5.0 : -1.0;
  }

  PartBench bench;
  Scene scene;
};

/// Two windows of 3 x 4 and 2 x 2 m on different levels.
const std::vector<WallRect> kTwoWindows = {{{3, 4}, {6, 8}}, {{12, 1}, {14, 3}}};

/// A seed with which the photograph lies as it was taken, or mirrored.
uint64_t SeedOf(bool is_mirrored) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const bool has_wall_there = Front(kTwoWindows, 20.0, seed).DepthAt(4.5, 6.0) < 0.5 * kRecess_m;
    if (has_wall_there == is_mirrored) {
      return seed;
    }
  }
  ADD_FAILURE() << "expected one in 100 houses";
  return 0;
}

TEST(PhotoFront, IsClosedWithItsWindowsSetBack) {
  const Front front(kTwoWindows, 20.0, SeedOf(false));
  const SurfaceFaults holes = FindHoles(front.scene, 20.0, kFoot_m, kFoot_m + kPhotoHeight_m);
  EXPECT_TRUE(holes.texts.empty()) << holes.texts.front();
  EXPECT_TRUE(FindOverlaps(front.scene).texts.empty());
  EXPECT_NEAR(front.DepthAt(4.5, 6.0), kRecess_m, 1e-5);
  EXPECT_NEAR(front.DepthAt(3.05, 4.05), kRecess_m, 1e-5);
  EXPECT_NEAR(front.DepthAt(13.0, 2.0), kRecess_m, 1e-5);
  EXPECT_NEAR(front.DepthAt(2.95, 6.0), 0.0, 1e-5);
  EXPECT_NEAR(front.DepthAt(13.0, 3.05), 0.0, 1e-5);
  EXPECT_EQ(front.bench.stats.num_windows, 2);
  EXPECT_EQ(front.bench.stats.num_painted_walls, 1);
}

TEST(PhotoFront, WallAndWindowsTogetherCoverTheFront) {
  for (uint64_t seed = 0; seed < 4; ++seed) {
    const Front front(kTwoWindows, 20.0, seed);
    constexpr double kWindows_m2 = 3.0 * 4.0 + 2.0 * 2.0;
    constexpr double kReveals_m2 = (2.0 * (3.0 + 4.0) + 2.0 * (2.0 + 2.0)) * kRecess_m;
    EXPECT_NEAR(front.AreaAtDepth(0.0), 200.0 - kWindows_m2, 1e-3);
    EXPECT_NEAR(front.AreaAtDepth(kRecess_m), kWindows_m2, 1e-3);
    EXPECT_NEAR(front.Area(), 200.0 + kReveals_m2, 1e-3);
    const Bounds bounds = BoundsOfScene(front.scene);
    EXPECT_NEAR(bounds.low_m.z(), kFoot_m, 1e-5);
    EXPECT_NEAR(bounds.high_m.z(), kFoot_m + kPhotoHeight_m, 1e-5);
    EXPECT_NEAR(bounds.low_m.x(), 0.0, 1e-5);
    EXPECT_NEAR(bounds.high_m.x(), 20.0, 1e-5);
  }
}

TEST(PhotoFront, IsMirroredOnHalfOfTheHouses) {
  const Front mirrored(kTwoWindows, 20.0, SeedOf(true));
  EXPECT_NEAR(mirrored.DepthAt(20.0 - 4.5, 6.0), kRecess_m, 1e-5);
  EXPECT_NEAR(mirrored.DepthAt(20.0 - 13.0, 2.0), kRecess_m, 1e-5);
  EXPECT_NEAR(mirrored.DepthAt(4.5, 6.0), 0.0, 1e-5);
  int num_mirrored = 0;
  constexpr int kNumHouses = 60;
  for (uint64_t seed = 0; seed < kNumHouses; ++seed) {
    num_mirrored += Front(kTwoWindows, 20.0, seed).DepthAt(4.5, 6.0) < 0.5 * kRecess_m ? 1 : 0;
  }
  // Four standard deviations.
  EXPECT_NEAR(num_mirrored, 0.5 * kNumHouses, 4.0 * std::sqrt(0.25 * kNumHouses));
}

TEST(PhotoFront, WideFrontsShowThePhotographSeveralTimes) {
  const Front front(kTwoWindows, 40.0, SeedOf(false));
  EXPECT_EQ(front.bench.stats.num_windows, 4);
  EXPECT_NEAR(front.AreaAtDepth(kRecess_m), 2.0 * 16.0, 1e-3);
  EXPECT_NEAR(front.AreaAtDepth(0.0), 400.0 - 2.0 * 16.0, 1e-3);
  EXPECT_NEAR(front.DepthAt(24.5, 6.0), kRecess_m, 1e-5);
}

TEST(PhotoFront, IsStretchedSoThatWholePhotographsFit) {
  // By a tenth: windows are as much wider.
  const Front wider(kTwoWindows, 22.0, SeedOf(false));
  EXPECT_NEAR(wider.AreaAtDepth(kRecess_m), 1.1 * 16.0, 1e-3);
  EXPECT_NEAR(wider.DepthAt(1.1 * 5.95, 6.0), kRecess_m, 1e-5);
  EXPECT_NEAR(wider.DepthAt(1.1 * 6.05, 6.0), 0.0, 1e-5);
  // By no more than 15 %: at 28 m a second one begins at 23 m and is cut off in its first window.
  const Front cut(kTwoWindows, 28.0, SeedOf(false));
  const double part_m = 28.0 - 0.05 - (23.0 + 1.15 * 3.0);
  EXPECT_NEAR(cut.AreaAtDepth(kRecess_m), 1.15 * 16.0 + 4.0 * part_m, 1e-3);
  EXPECT_EQ(cut.bench.stats.num_windows, 3);
  EXPECT_NEAR(cut.AreaAtDepth(0.0) + cut.AreaAtDepth(kRecess_m), 280.0, 1e-3);
}

TEST(PhotoFront, WindowsThatDoNotFitStayFlat) {
  // At the rim 5 cm of wall are left; what is narrower than 25 cm, or lies on another window, is
  // no window.
  const Front rim({{{18.0, 2.0}, {20.0, 4.0}}}, 20.0);
  EXPECT_NEAR(rim.AreaAtDepth(kRecess_m), 1.95 * 2.0, 1e-3);
  const Front narrow({{{5.0, 2.0}, {5.2, 4.0}}, {{8.0, 2.0}, {9.0, 2.24}}}, 20.0);
  EXPECT_EQ(narrow.AreaAtDepth(kRecess_m), 0.0);
  EXPECT_NEAR(narrow.AreaAtDepth(0.0), 200.0, 1e-3);
  EXPECT_EQ(narrow.bench.stats.num_windows, 0);
  const Front twice({{{5.0, 2.0}, {7.0, 4.0}}, {{6.0, 3.0}, {9.0, 6.0}}}, 20.0);
  EXPECT_EQ(twice.bench.stats.num_windows, 1);
  EXPECT_NEAR(twice.AreaAtDepth(kRecess_m), 4.0, 1e-3);
  EXPECT_NEAR(twice.AreaAtDepth(0.0), 196.0, 1e-3);
}

TEST(PhotoFront, WindowsBesideAndAboveOneAnotherLeaveNoGap) {
  // Rows that overlap in height, and two windows that share an edge's level.
  const Front front({{{1, 1}, {3, 4}}, {{5, 2}, {7, 6}}, {{9, 4}, {11, 6}}, {{1, 6}, {3, 8}}},
                    20.0);
  EXPECT_EQ(front.bench.stats.num_windows, 4);
  EXPECT_NEAR(front.AreaAtDepth(0.0), 200.0 - 6.0 - 8.0 - 4.0 - 4.0, 1e-3);
  EXPECT_TRUE(FindHoles(front.scene, 20.0, kFoot_m, kFoot_m + kPhotoHeight_m).texts.empty());
  EXPECT_TRUE(FindOverlaps(front.scene).texts.empty());
}

TEST(PhotoFront, NeedsAPhotograph) {
  PartBench bench;
  const BuildContext context = bench.Context();
  EXPECT_DEATH(BuildPhotoFront(context, Building(), SurfaceFrame(), 20.0, 8.0), "building.photo");
}

}  // namespace
}  // namespace pfseq
