// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/city.h"

#include "renderer/trace/ray_scene.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <ostream>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// One ray in so many may slip between the rounded edges of thin parts.
constexpr int kRaysPerSlip = 200000;

/// What must hold in any city: valid, rays from the drive and from above meet fronts, no two
/// triangles on one another, the drive's way free, all within 450 m.
void ExpectSoundCity(const CanyonSpec& canyon, const DriveSpec& drive, int num_rays) {
  const auto scene = std::make_shared<const Scene>(PlainCity(canyon, drive));
  scene->Validate("city");
  const SurfaceFaults overlaps = FindOverlaps(*scene);
  EXPECT_TRUE(overlaps.texts.empty()) << overlaps.texts.size() << ", " << overlaps.texts.front();

  const SurfaceFaults degenerate = FindDegenerate(*scene);
  EXPECT_TRUE(degenerate.texts.empty())
      << degenerate.texts.size() << ", " << degenerate.texts.front();

  const RayScene rays(scene);
  std::vector<Vec3d> eyes_m = EyesAlongDrive(drive, 4.0);
  const Bounds bounds = BoundsOfScene(*scene);
  RandomStream random({3});
  for (int i = 0; i < 40; ++i) {
    eyes_m.emplace_back(random.Uniform(bounds.low_m.x() + 40.0, bounds.high_m.x() - 40.0),
                        random.Uniform(bounds.low_m.y() + 40.0, bounds.high_m.y() - 40.0),
                        bounds.high_m.z() + 5.0);
  }
  const SurfaceFaults backs =
      FindBackFaces(rays, eyes_m, num_rays / static_cast<int>(eyes_m.size()), -1.0);
  EXPECT_LE(static_cast<int>(backs.texts.size()), 1 + backs.num_checked / kRaysPerSlip)
      << backs.texts.front();

  for (const Vec2d& point_m : SampleDrivePath(drive, 0.25)) {
    for (int i = 0; i < 16; ++i) {
      const double angle_rad = 2.0 * std::numbers::pi * i / 16.0;
      const Vec3d direction(std::cos(angle_rad), std::sin(angle_rad), 0.0);
      for (const double height_m : {0.05, 1.0, 2.0}) {
        EXPECT_FALSE(rays.Occluded(Vec3d(point_m.x(), point_m.y(), height_m), direction, 1.0))
            << point_m.transpose() << " at " << height_m;
      }
    }
  }
  double low_x_m = 0.0;
  double high_x_m = 0.0;
  double low_y_m = 0.0;
  double high_y_m = 0.0;
  for (const Vec2d& point_m : SampleDrivePath(drive, 1.0)) {
    low_x_m = std::min(low_x_m, point_m.x());
    high_x_m = std::max(high_x_m, point_m.x());
    low_y_m = std::min(low_y_m, point_m.y());
    high_y_m = std::max(high_y_m, point_m.y());
  }
  EXPECT_GT(bounds.low_m.x(), low_x_m - 450.0);
  EXPECT_LT(bounds.high_m.x(), high_x_m + 450.0);
  EXPECT_GT(bounds.low_m.y(), low_y_m - 450.0);
  EXPECT_LT(bounds.high_m.y(), high_y_m + 450.0);
}

TEST(City, IsSoundByDefault) {
  for (const uint64_t seed : {1U, 2U, 3U}) {
    CanyonSpec canyon;
    canyon.seed = seed;
    ExpectSoundCity(canyon, {}, 300000);
  }
}

TEST(City, HorizonIsClosedAllAround) {
  const auto scene = std::make_shared<const Scene>(PlainCity({}, {}));
  const RayScene rays(scene);
  RandomStream random({1});
  for (const Vec3d& eye_m : EyesAlongDrive({}, 5.0)) {
    for (int i = 0; i < 300; ++i) {
      // From three degrees below to three above the horizon.
      Vec3d direction = RandomDirection(random, 0.0);
      direction.z() = random.Uniform(-0.05, 0.05) * direction.head<2>().norm();
      ASSERT_TRUE(rays.Intersect(eye_m, direction.normalized())) << eye_m.transpose();
    }
  }
}

TEST(City, MoreDetailMeansMoreTriangles) {
  std::vector<size_t> counts;
  for (const double detail : {0.0, 0.5, 1.0, 2.0}) {
    CanyonSpec canyon;
    canyon.detail = detail;
    counts.push_back(PlainCity(canyon, {}).NumTriangles());
  }
  EXPECT_LT(counts[0], counts[1]);
  EXPECT_LT(counts[1], counts[2]);
  EXPECT_LT(counts[2], counts[3]);
}

TEST(City, MirrorsTheTurn) {
  DriveSpec drive;
  drive.turn = "right";
  ExpectSoundCity({}, drive, 100000);
}

struct Extreme {
  std::string name;
  CanyonSpec canyon;
  DriveSpec drive;
};

std::ostream& operator<<(std::ostream& out, const Extreme& extreme) { return out << extreme.name; }

class ExtremeCity : public testing::TestWithParam<Extreme> {};

TEST_P(ExtremeCity, IsSound) { ExpectSoundCity(GetParam().canyon, GetParam().drive, 60000); }

std::vector<Extreme> Extremes() {
  std::vector<Extreme> list;
  const auto add = [&](const std::string& name) -> Extreme& {
    list.push_back({name, {}, {}});
    return list.back();
  };
  add("NarrowStreets").canyon.street_width_m = {4.0, 5.0};
  add("WideStreets").canyon.street_width_m = {60.0, 100.0};
  Extreme& towers = add("Towers");
  towers.canyon.building_height_m = {80.0, 300.0};
  towers.canyon.surrounding_blocks = 0;
  add("Huts").canyon.building_height_m = {3.0, 4.0};
  add("FlatRoofs").canyon.pitched_roof_share = 0.0;
  add("PitchedRoofs").canyon.pitched_roof_share = 1.0;
  add("MostDetail").canyon.detail = 2.0;
  add("LeastDetail").canyon.detail = 0.0;
  add("NoSurroundings").canyon.surrounding_blocks = 0;
  Extreme& tiny = add("TinyDrive");
  tiny.drive.first_street_m = 0.0;
  tiny.drive.cross_street_m = 0.0;
  tiny.drive.last_street_m = 0.0;
  tiny.drive.corner_radius_m = 3.0;
  Extreme& close = add("StreetsSideBySide");
  close.drive.cross_street_m = 8.0;
  close.drive.corner_radius_m = 6.0;
  add("WideTurn").drive.corner_radius_m = 40.0;
  add("LongStreet").drive.last_street_m = 400.0;
  return list;
}

INSTANTIATE_TEST_SUITE_P(Specs, ExtremeCity, testing::ValuesIn(Extremes()), [](const auto& test) {
  return test.param.name;
});

}  // namespace
}  // namespace pfseq
