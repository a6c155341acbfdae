// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_painting.h"
#include "tests/scenes/canyon/wall_test_support.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kTexel_m = 0.005;

WallCanvas Spotted(uint64_t seed) {
  WallPainting painting = PlainWall(WallSurface::kPlaster, {{0, 4}, {2, 6}}, seed);
  painting.texel_m = kTexel_m;
  WallCanvas canvas = GreyCanvas(painting);
  PaintSpots(painting, canvas);
  return canvas;
}

/// Crumbs of their ragged edges do not count.
std::vector<WallRect> SpotsOf(WallCanvas& canvas) {
  std::vector<WallRect> spots;
  for (const auto& patch : PatchesWhere(canvas, IsPainted)) {
    if (patch.size() > 12) {
      spots.push_back(RectAround(patch));
    }
  }
  return spots;
}

TEST(WallSpots, AreSmallAndMostlyDarker) {
  WallCanvas canvas = Spotted(5);
  const WallRect wall = {canvas.LowM(), canvas.HighM()};
  const double darker =
      MeanOver(wall, canvas, [](const WallTexel& texel) { return texel.color[1] < 0.48F; });
  const double lighter =
      MeanOver(wall, canvas, [](const WallTexel& texel) { return texel.color[1] > 0.52F; });
  EXPECT_GT(darker, 1.5 * lighter);
  EXPECT_GT(darker + lighter, 0.01);
  EXPECT_LT(darker + lighter, 0.15);
}

TEST(WallSpots, AreFewOnOneWallAndManyOnAnother) {
  size_t least = 1000;
  size_t most = 0;
  for (uint64_t seed = 0; seed < 16; ++seed) {
    WallCanvas canvas = Spotted(seed);
    const std::vector<WallRect> spots = SpotsOf(canvas);
    double sum_m = 0.0;
    for (const WallRect& spot : spots) {
      sum_m += (spot.high_m - spot.low_m).maxCoeff();
    }
    EXPECT_NEAR(sum_m / static_cast<double>(spots.size()), 0.07, 0.02) << seed;
    least = std::min(least, spots.size());
    most = std::max(most, spots.size());
  }
  // On 4 square metres; some spots run into one another.
  EXPECT_GE(least, 40U);
  EXPECT_LE(least, 70U);
  EXPECT_GE(most, 90U);
  EXPECT_LE(most, 150U);
}

TEST(WallSpots, LieAllOverTheWall) {
  WallCanvas canvas = Spotted(5);
  for (const Vec2d& low_m : {Vec2d(0, 4), Vec2d(1, 4), Vec2d(0, 5), Vec2d(1, 5)}) {
    const double share = MeanOver({low_m, low_m + Vec2d::Ones()}, canvas, IsPainted);
    EXPECT_GT(share, 0.05);
    EXPECT_LT(share, 0.2);
  }
}

TEST(WallSpots, DarkOnesArePits) {
  WallCanvas canvas = Spotted(5);
  EXPECT_GT(
      PlacesWhere(canvas, [](const WallTexel& texel) { return HeightOf(texel) < -0.001; }).size(),
      1000U);
  const auto is_dark_but_flat = [](const WallTexel& texel) {
    return HeightOf(texel) == 0.0 && texel.color[1] < 0.5F;
  };
  EXPECT_TRUE(PlacesWhere(canvas, is_dark_but_flat).empty());
}

}  // namespace
}  // namespace pfseq
