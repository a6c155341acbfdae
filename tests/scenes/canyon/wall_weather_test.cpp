// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/canyon/wall_test_support.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

const WallRect kHighWall = {{0, 0}, {4, 12}};

WallPainting Aged(WallSurface surface, const WallRect& area, double age, uint64_t seed) {
  WallPainting painting = PlainWall(surface, area, seed);
  painting.look.age = age;
  return painting;
}

WallCanvas Weathered(const WallPainting& painting) {
  WallCanvas canvas = GreyCanvas(painting);
  PaintWeather(painting, canvas);
  return canvas;
}

/// Mean dirt between two heights of a wall.
double DirtBetween(double low_m, double high_m, WallCanvas& canvas) {
  return MeanOver({{canvas.LowM().x(), low_m}, {canvas.HighM().x(), high_m}}, canvas, DirtOf);
}

TEST(WallWeather, SootGathersUnderTheEaveAndOverThePavement) {
  const auto mean_dirt = [](double low_m, double high_m) {
    double sum = 0.0;
    constexpr int kNumWalls = 16;
    for (uint64_t seed = 0; seed < kNumWalls; ++seed) {
      WallPainting painting = Aged(WallSurface::kBrick, {{0, low_m}, {4, high_m}}, 1.0, seed);
      painting.pavement_m = 2.0;
      painting.eave_m = 12.0;
      WallCanvas canvas = Weathered(painting);
      sum += DirtBetween(low_m, high_m, canvas) / kNumWalls;
    }
    return sum;
  };
  const double middle = mean_dirt(5.0, 8.0);
  EXPECT_GT(middle, 0.03);
  EXPECT_LT(middle, 0.15);
  EXPECT_GT(mean_dirt(11.9, 12.0), middle + 0.15);
  EXPECT_LT(mean_dirt(9.0, 9.5), middle + 0.03);
  EXPECT_GT(mean_dirt(2.0, 2.1), middle + 0.25);
  EXPECT_LT(mean_dirt(3.7, 3.9), middle + 0.03);
}

TEST(WallWeather, SootComesWithAgeSplashesComeAtOnce) {
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const auto weathered = [&](double age) {
      return Weathered(Aged(WallSurface::kBrick, kHighWall, age, seed));
    };
    WallCanvas as_new = weathered(0.0);
    WallCanvas used = weathered(0.5);
    WallCanvas old = weathered(1.0);
    // Nothing but the street's dirt.
    EXPECT_EQ(MeanOver({{0, 2}, {4, 12}}, as_new, IsPainted), 0.0) << seed;
    EXPECT_GT(DirtBetween(0.0, 0.2, as_new), 0.1) << seed;
    EXPECT_NEAR(DirtBetween(2.0, 12.0, old), 2.0 * DirtBetween(2.0, 12.0, used), 1e-4) << seed;
  }
}

TEST(WallWeather, DampRisesInSomeHouses) {
  int num_damp = 0;
  constexpr int kNumHouses = 60;
  for (uint64_t seed = 0; seed < kNumHouses; ++seed) {
    WallCanvas canvas = Weathered(Aged(WallSurface::kBrick, {{0, 0}, {2, 2}}, 0.0, seed));
    const double dirt = DirtBetween(0.55, 0.6, canvas);
    num_damp += dirt > 0.15 ? 1 : 0;
    // It ends below the first floor.
    EXPECT_LT(DirtBetween(1.9, 2.0, canvas), 0.1) << seed;
  }
  EXPECT_GT(num_damp, kNumHouses / 8);
  EXPECT_LT(num_damp, kNumHouses / 2);
}

/// Old walls of a surface, large enough that each has all kinds of damage that there are.
class Damage : public testing::TestWithParam<WallSurface> {
 protected:
  static constexpr int kNumWalls = 4;

  template <typename IsOfKind>
  size_t Count(double age, const IsOfKind& is_of_kind) const {
    size_t count = 0;
    for (uint64_t seed = 0; seed < kNumWalls; ++seed) {
      WallPainting painting = Aged(GetParam(), {{0, 2}, {9, 10}}, age, seed);
      painting.eave_m = 12.0;
      painting.texel_m = 0.03;
      WallCanvas canvas = Weathered(painting);
      count += PlacesWhere(canvas, is_of_kind).size();
    }
    return count;
  }

  bool IsOf(WallSurface surface) const { return GetParam() == surface; }
};

TEST_P(Damage, PlasterComesOffAndShowsBricks) {
  const auto is_deep = [](const WallTexel& texel) { return texel.height_m < -0.0095F; };
  const auto is_brick_red = [&](const WallTexel& texel) {
    return is_deep(texel) && texel.color[0] > texel.color[2] + 0.1F;
  };
  const size_t num_deep = Count(1.0, is_deep);
  if (IsOf(WallSurface::kPlaster)) {
    EXPECT_GT(num_deep, 1000U);
    EXPECT_GT(2 * Count(1.0, is_brick_red), num_deep);
  } else {
    EXPECT_EQ(num_deep, 0U);
  }
  EXPECT_EQ(Count(0.0, is_deep), 0U);
}

TEST_P(Damage, OtherSurfacesBleach) {
  const auto is_bleached = [](const WallTexel& texel) {
    return HeightOf(texel) == 0.0 && BrightnessOf(texel) > 0.52;
  };
  const size_t count = Count(1.0, is_bleached);
  if (IsOf(WallSurface::kPlaster)) {
    EXPECT_EQ(count, 0U);
  } else {
    EXPECT_GT(count, 1000U);
  }
  EXPECT_EQ(Count(0.0, is_bleached), 0U);
}

TEST_P(Damage, RepairsLieOnTheWallAndCracksInIt) {
  const auto is_repaired = [](const WallTexel& texel) { return HeightOf(texel) > 0.0029; };
  const auto is_cracked = [](const WallTexel& texel) {
    return HeightOf(texel) < -0.001 && BrightnessOf(texel) < 0.47;
  };
  EXPECT_GT(Count(1.0, is_repaired), 1000U);
  EXPECT_EQ(Count(0.0, is_repaired), 0U);
  EXPECT_GT(Count(1.0, is_cracked), 50U);
  EXPECT_EQ(Count(0.0, is_cracked), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Surfaces,
    Damage,
    testing::Values(WallSurface::kPlaster, WallSurface::kBrick, WallSurface::kConcrete),
    [](const auto& test) { return "Surface" + std::to_string(static_cast<int>(test.param)); });

/// Where two walls that differ in one thing look different.
std::vector<Vec2d> Differences(const WallPainting& a, const WallPainting& b) {
  WallCanvas first = Weathered(a);
  WallCanvas second = Weathered(b);
  std::vector<Vec2d> places_m;
  for (int y = 0; y < first.HeightPx(); ++y) {
    for (int x = 0; x < first.WidthPx(); ++x) {
      if ((first.At(x, y).color != second.At(x, y).color).any() ||
          first.At(x, y).dirt != second.At(x, y).dirt) {
        places_m.push_back(first.PointOf(x, y));
      }
    }
  }
  return places_m;
}

TEST(WallWeather, CracksStartAtTheLowerCornersOfSomeOpenings) {
  const std::vector<WallRect> openings = {{{1.5, 4}, {2.5, 6}}, {{6.5, 4}, {7.5, 6}}};
  int num_cracked = 0;
  for (uint64_t seed = 0; seed < 12; ++seed) {
    for (const WallSurface surface : {WallSurface::kPlaster, WallSurface::kBrick}) {
      WallPainting without = Aged(surface, {{0, 2}, {9, 8}}, 1.0, seed);
      without.texel_m = 0.04;
      WallPainting with = without;
      with.openings = openings;
      std::vector<bool> is_cracked(openings.size());
      for (const Vec2d& place_m : Differences(with, without)) {
        const size_t i = place_m.x() < 4.5 ? 0 : 1;
        const double nearest_m =
            std::min((place_m - openings[i].low_m).norm(),
                     (place_m - Vec2d(openings[i].high_m.x(), openings[i].low_m.y())).norm());
        EXPECT_LT(nearest_m, 1.0);
        is_cracked[i] = true;
      }
      const auto count = std::count(is_cracked.begin(), is_cracked.end(), true);
      if (surface == WallSurface::kBrick) {
        EXPECT_EQ(count, 0);
      } else {
        num_cracked += static_cast<int>(count);
      }
    }
  }
  // Three of ten, of 24.
  EXPECT_GT(num_cracked, 2);
  EXPECT_LT(num_cracked, 14);
}

/// Walls with one ledge.
class Streaks : public testing::Test {
 protected:
  static constexpr Ledge kLedge = {1.0, 2.0, 6.0};

  static WallPainting Wall(double age, uint64_t seed) {
    return Aged(WallSurface::kConcrete, {{0, 4}, {3, 7}}, age, seed);
  }

  /// How much dirtier than without the ledge a part of walls is, on average.
  static double Added(const WallRect& part, double age) {
    double sum = 0.0;
    constexpr uint64_t kNumWalls = 12;
    for (uint64_t seed = 0; seed < kNumWalls; ++seed) {
      WallPainting painting = Wall(age, seed);
      WallCanvas without = Weathered(painting);
      painting.ledges = {kLedge};
      WallCanvas with = Weathered(painting);
      sum += MeanOver(part, with, DirtOf) - MeanOver(part, without, DirtOf);
    }
    return sum / kNumWalls;
  }
};

TEST_F(Streaks, RunDownFromALedgeAlone) {
  for (uint64_t seed = 0; seed < 4; ++seed) {
    WallPainting painting = Wall(1.0, seed);
    const WallPainting without = painting;
    painting.ledges = {kLedge};
    const WallRect wet = RectAround(Differences(painting, without));
    EXPECT_NEAR(wet.low_m.x(), 1.0, 0.041);
    EXPECT_NEAR(wet.high_m.x(), 2.0, 0.041);
    EXPECT_LT(wet.high_m.y(), 6.0);
    EXPECT_GT(wet.high_m.y(), 5.9);
  }
}

TEST_F(Streaks, AreStrongestAtItsEndsAndFade) {
  const double left = Added({{1.0, 5.6}, {1.04, 5.9}}, 1.0);
  const double middle = Added({{1.3, 5.6}, {1.7, 5.9}}, 1.0);
  const double right = Added({{1.96, 5.6}, {2.0, 5.9}}, 1.0);
  EXPECT_GT(middle, 0.02);
  EXPECT_GT(left, 1.5 * middle);
  EXPECT_GT(right, 1.5 * middle);
  EXPECT_LT(Added({{1.3, 4.0}, {1.7, 4.3}}, 1.0), 0.4 * middle);
}

TEST_F(Streaks, GrowWithAge) {
  const WallRect under = {{1.0, 5.0}, {2.0, 5.9}};
  const double as_new = Added(under, 0.0);
  EXPECT_GT(as_new, 0.0);
  EXPECT_GT(Added(under, 1.0), 4.0 * as_new);
}

}  // namespace
}  // namespace pfseq
