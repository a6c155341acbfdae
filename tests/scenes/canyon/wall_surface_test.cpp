// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_surface.h"

#include "tests/scenes/canyon/wall_test_support.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

WallCanvas Surface(
    WallSurface surface, const WallRect& area, double texel_m, uint64_t seed, double age = 0.0) {
  WallLook look = PlainWall(surface, area, seed).look;
  look.age = age;
  WallCanvas canvas(area.low_m, area.high_m, texel_m);
  PaintSurface(look, canvas);
  return canvas;
}

double MeanHeight(const WallRect& part, WallCanvas& canvas) {
  return MeanOver(part, canvas, HeightOf);
}

/// Middles of the stretches along a part of a wall, or up it, that lie lower than `height_m`.
std::vector<double> JointsOf(const WallRect& part, int axis, double height_m, WallCanvas& canvas) {
  std::vector<double> joints_m;
  for (const Vec2d& stretch_m :
       StretchesWhere(part, axis, canvas.TexelM(), [&](const WallRect& slice) {
         return MeanHeight(slice, canvas) < height_m;
       })) {
    joints_m.push_back(stretch_m.mean());
  }
  return joints_m;
}

constexpr double kCourse_m = 0.077;
constexpr int kNumCourses = 7;
/// A wall of fifteen bricks' length that neither begins nor ends at a joint of any bond.
constexpr double kLeft_m = 0.015;
constexpr double kRight_m = kLeft_m + 15 * 0.24;

WallCanvas BricksInBond(int bond) {
  WallLook look;
  while (Brickwork(look).bond != bond) {
    ++look.seed;
  }
  return Surface(
      WallSurface::kBrick, {{kLeft_m, 0}, {kRight_m, kNumCourses * kCourse_m}}, 0.003, look.seed);
}

/// The upright joints of a course.
std::vector<double> JointsOfCourse(int course, WallCanvas& canvas) {
  const double middle_m = (course + 0.5) * kCourse_m;
  return JointsOf({{kLeft_m, middle_m - 0.024}, {kRight_m, middle_m + 0.024}}, 0, 0.0020, canvas);
}

TEST(Bricks, AreLaidInFourBonds) {
  const std::vector<std::vector<size_t>> num_bricks = {
      {15, 15, 15, 15, 15, 15, 15},
      {30, 15, 15, 15, 15, 15, 30},
      {15, 30, 15, 30, 15, 30, 15},
      {20, 20, 20, 20, 20, 20, 20},
  };
  for (int bond = 0; bond < 4; ++bond) {
    WallCanvas canvas = BricksInBond(bond);
    for (int course = 0; course < kNumCourses; ++course) {
      EXPECT_EQ(JointsOfCourse(course, canvas).size(), num_bricks[bond][course])
          << "bond " << bond << ", course " << course;
    }
  }
}

TEST(Bricks, CoverTheJointsOfTheCourseBelow) {
  for (int bond = 0; bond < 4; ++bond) {
    WallCanvas canvas = BricksInBond(bond);
    for (int course = 1; course < kNumCourses; ++course) {
      for (const double above_m : JointsOfCourse(course, canvas)) {
        for (const double below_m : JointsOfCourse(course - 1, canvas)) {
          EXPECT_GT(std::abs(above_m - below_m), 0.02) << "bond " << bond;
        }
      }
    }
  }
}

TEST(Bricks, LieOnBedsOfMortar) {
  WallCanvas canvas = BricksInBond(0);
  for (int course = 1; course < kNumCourses; ++course) {
    const double bed_m = course * kCourse_m;
    EXPECT_LT(MeanHeight({{kLeft_m, bed_m - 0.0031}, {kRight_m, bed_m + 0.0031}}, canvas), 0.0035);
    EXPECT_GT(MeanHeight({{kLeft_m, bed_m + 0.02}, {kRight_m, bed_m + 0.06}}, canvas), 0.0055);
  }
}

TEST(Bricks, AllBondsAreInUse) {
  std::vector<int> num_of_bond(4);
  for (uint64_t seed = 0; seed < 80; ++seed) {
    WallLook look;
    look.seed = seed;
    ++num_of_bond.at(static_cast<size_t>(Brickwork(look).bond));
  }
  EXPECT_GE(*std::min_element(num_of_bond.begin(), num_of_bond.end()), 10);
}

TEST(Ashlar, IsLaidInEvenCoursesAndSometimesRusticated) {
  int num_rusticated = 0;
  for (uint64_t seed = 0; seed < 10; ++seed) {
    WallCanvas canvas = Surface(WallSurface::kAshlar, {{0, 0.1}, {2, 2.6}}, 0.005, seed);
    const WallRect wall = {canvas.LowM(), canvas.HighM()};
    const auto beds_m = JointsOf(wall, 1, 0.5 * MeanHeight(wall, canvas), canvas);
    ASSERT_GE(beds_m.size(), 5U) << seed;
    const double course_m = beds_m[1] - beds_m[0];
    EXPECT_GT(course_m, 0.335) << seed;
    EXPECT_LT(course_m, 0.485) << seed;
    for (size_t i = 2; i < beds_m.size(); ++i) {
      EXPECT_NEAR(beds_m[i] - beds_m[i - 1], course_m, 0.011) << seed;
    }
    const double face_m =
        MeanHeight({{0, beds_m[0] + 0.1}, {2, beds_m[0] + course_m - 0.1}}, canvas);
    EXPECT_TRUE(std::abs(face_m - 0.006) < 0.002 || std::abs(face_m - 0.019) < 0.002) << face_m;
    num_rusticated += face_m > 0.012 ? 1 : 0;
  }
  EXPECT_GE(num_rusticated, 2);
  EXPECT_LE(num_rusticated, 8);
}

TEST(Concrete, IsCastInPanelsOfOneSize) {
  for (uint64_t seed = 0; seed < 6; ++seed) {
    WallCanvas canvas = Surface(WallSurface::kConcrete, {{0.2, 0.2}, {9.2, 9.2}}, 0.02, seed);
    const auto joints_m = [&](int axis) {
      return JointsOf({canvas.LowM(), canvas.HighM()}, axis, -0.005, canvas);
    };
    const std::vector<double> upright_m = joints_m(0);
    const std::vector<double> level_m = joints_m(1);
    ASSERT_GE(upright_m.size(), 2U);
    ASSERT_EQ(level_m.size(), 2U);
    EXPECT_GT(upright_m[0], 2.4 - 0.02);
    EXPECT_LT(upright_m[0], 4.0 + 0.02);
    EXPECT_GT(level_m[0], 2.9 - 0.02);
    EXPECT_LT(level_m[0], 3.4 + 0.02);
    EXPECT_NEAR(upright_m[1], 2.0 * upright_m[0], 0.041);
    EXPECT_NEAR(level_m[1], 2.0 * level_m[0], 0.041);
  }
}

TEST(Concrete, HasHolesWhereTheFormworkWasTied) {
  int num_with_holes = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    WallCanvas canvas = Surface(WallSurface::kConcrete, {{0.9, 1.1}, {3.9, 3.1}}, 0.01, seed);
    // How much deeper the wall is within 1 cm of places than 4 to 7 cm beside them, on average.
    const auto depth_m = [&](const std::vector<Vec2d>& places_m) {
      double sum_m = 0.0;
      for (const Vec2d& place_m : places_m) {
        const auto over = [&](double from_m, double to_m) {
          return MeanHeight({place_m + Vec2d(from_m, -0.01), place_m + Vec2d(to_m, 0.01)}, canvas);
        };
        sum_m += 0.5 * (over(-0.07, -0.04) + over(0.04, 0.07)) - over(-0.01, 0.01);
      }
      return sum_m / static_cast<double>(places_m.size());
    };
    const double ties_m =
        depth_m({{1.2, 1.4}, {2.4, 1.4}, {3.6, 1.4}, {1.2, 2.8}, {2.4, 2.8}, {3.6, 2.8}});
    const double between_m =
        depth_m({{1.8, 1.4}, {1.8, 2.1}, {1.2, 2.1}, {2.4, 2.1}, {1.8, 2.8}, {3.3, 2.1}});
    EXPECT_NEAR(between_m, 0.0, 0.002) << seed;
    const bool has_holes = ties_m > 0.005;
    EXPECT_NEAR(ties_m, has_holes ? 0.0095 : 0.0, has_holes ? 0.0035 : 0.001) << seed;
    num_with_holes += has_holes ? 1 : 0;
  }
  // Not where it has been washed.
  EXPECT_GT(num_with_holes, 10);
  EXPECT_LT(num_with_holes, 20);
}

TEST(Rubble, IsOfFieldStonesWithLowerJointsOfPaleMortar) {
  for (uint64_t seed = 0; seed < 4; ++seed) {
    WallCanvas canvas = Surface(WallSurface::kRubble, {{0, 0}, {4, 4}}, 0.01, seed);
    const auto stones =
        PatchesWhere(canvas, [](const WallTexel& texel) { return texel.height_m > 0.0045F; });
    const auto num_stones = std::count_if(
        stones.begin(), stones.end(), [](const auto& stone) { return stone.size() > 100; });
    // 2.5 by 2.5 on a square metre, and parts of some at the edges.
    EXPECT_GT(num_stones, 85);
    EXPECT_LT(num_stones, 125);
    double green = 0.0;
    int num_mortar = 0;
    canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& /*point_m*/) {
      if (texel.height_m < 0.001F) {
        green += texel.color[1];
        ++num_mortar;
      }
    });
    // A little paler than the wall's 0.65.
    EXPECT_NEAR(green / num_mortar, 0.68, 0.01);
  }
}

TEST(Plaster, IsBlotchierWithAge) {
  // Standard deviation of the brightness of squares of half a metre.
  const auto spread = [](double age) {
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kNumWalls = 4;
    for (uint64_t seed = 0; seed < kNumWalls; ++seed) {
      WallCanvas canvas = Surface(WallSurface::kPlaster, {{0, 0}, {4, 4}}, 0.02, seed, age);
      for (int i = 0; i < 64; ++i) {
        const Vec2d low_m(0.5 * (i % 8), 0.5 * (i / 8));
        const double mean = MeanOver({low_m, low_m + Vec2d::Constant(0.5)}, canvas, BrightnessOf);
        sum += mean;
        squares += mean * mean;
      }
    }
    const double mean = sum / (64 * kNumWalls);
    return std::sqrt(squares / (64 * kNumWalls) - mean * mean);
  };
  EXPECT_GT(spread(1.0), 1.1 * spread(0.0));
}

}  // namespace
}  // namespace pfseq
