// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/painted_front.h"

#include "tests/scenes/canyon/canyon_test_support.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

const WallRect kArea = {{0.0, 5.0}, {3.0, 8.0}};

/// What an ordered wall's colour looks like; a house of ashlar with its street to the south.
Image<uint8_t> PaintedColor(bool is_rubble) {
  PartBench bench;
  WallPaintings paintings(bench.palette, 0.03);
  BuildContext context = bench.Context();
  context.paintings = &paintings;
  Building house = RowHouse(bench.palette, FacadeStyle::kAshlar, 3, 1.0);
  house.is_rubble = is_rubble;
  const int wall =
      OrderWall(context, house, SurfaceFrame{}, house.wall, kArea, {}, 5.0, Lod::kFine);
  EXPECT_NE(wall, house.wall);
  EXPECT_EQ(bench.stats.num_painted_walls, 1);
  paintings.Finish(bench.palette);
  const Material& material = bench.palette.materials[static_cast<size_t>(wall)];
  return bench.palette.textures[static_cast<size_t>(material.base_color_texture_idx)].texels;
}

/// From the darkest to the lightest mean of green over a quarter of a metre.
int Spread(const Image<uint8_t>& color) {
  const int step = color.WidthPx() / 12;
  int least = 255;
  int most = 0;
  for (int y = 0; y + step <= color.HeightPx(); y += step) {
    for (int x = 0; x + step <= color.WidthPx(); x += step) {
      int sum = 0;
      for (int j = 0; j < step; ++j) {
        for (int i = 0; i < step; ++i) {
          sum += color.At(x + i, y + j, 1);
        }
      }
      least = std::min(least, sum / (step * step));
      most = std::max(most, sum / (step * step));
    }
  }
  return most - least;
}

TEST(PaintedFront, RubbleHousesHaveRubbleWalls) {
  EXPECT_GT(Spread(PaintedColor(true)), Spread(PaintedColor(false)) + 20);
}

TEST(PaintedFront, FarAndNarrowWallsKeepThePalettes) {
  PartBench bench;
  const Building house = RowHouse(bench.palette, FacadeStyle::kAshlar, 3, 1.0);
  const auto order = [&](WallPaintings* paintings, const WallRect& area, Lod lod) {
    BuildContext context = bench.Context();
    context.paintings = paintings;
    return OrderWall(context, house, SurfaceFrame{}, house.wall, area, {}, 5.0, lod);
  };
  WallPaintings paintings(bench.palette, 0.03);
  EXPECT_EQ(order(nullptr, kArea, Lod::kFine), house.wall);
  EXPECT_EQ(order(&paintings, kArea, Lod::kCoarse), house.wall);
  EXPECT_EQ(order(&paintings, {{0.0, 5.0}, {0.1, 8.0}}, Lod::kFine), house.wall);
  EXPECT_NE(order(&paintings, kArea, Lod::kMedium), house.wall);
}

}  // namespace
}  // namespace pfseq
