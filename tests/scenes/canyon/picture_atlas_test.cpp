// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/canyon_textures.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

double MeanGreen(const Image<uint8_t>& texels, int left, int top, int width, int height) {
  double sum = 0.0;
  for (int y = top; y < top + height; ++y) {
    for (int x = left; x < left + width; ++x) {
      sum += texels.At(x, y, 1);
    }
  }
  return sum / (width * height);
}

TEST(WindowAtlas, FramesAreLighterThanRooms) {
  const Texture plain = WindowAtlas(false);
  const Texture framed = WindowAtlas(true);
  const int cell_px = plain.texels.WidthPx() / kWindowAtlasCells;
  for (int cell = 0; cell < kWindowAtlasCells; ++cell) {
    const int left = cell * cell_px;
    // The bar in the middle of the wings.
    EXPECT_GT(MeanGreen(framed.texels, left + cell_px / 2 - 2, cell_px / 2, 4, cell_px / 4), 150.0);
  }
  EXPECT_LT(MeanGreen(plain.texels, 0, 0, plain.texels.WidthPx(), plain.texels.HeightPx()), 128.0);
}

TEST(WindowAtlas, EveryTexelIsOpaque) {
  for (const Texture& atlas : {WindowAtlas(true), ShopAtlas(), CurtainWallTexture()}) {
    for (int y = 0; y < atlas.texels.HeightPx(); ++y) {
      for (int x = 0; x < atlas.texels.WidthPx(); ++x) {
        ASSERT_EQ(atlas.texels.At(x, y, 3), 255) << atlas.name << ' ' << x << ' ' << y;
      }
    }
  }
}

}  // namespace
}  // namespace pfseq
