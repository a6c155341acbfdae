// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/canyon_textures.h"

#include <cstdlib>

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
  for (const Texture& atlas : {WindowAtlas(true), ShopAtlas(), SignAtlas(), CurtainWallTexture()}) {
    for (int y = 0; y < atlas.texels.HeightPx(); ++y) {
      for (int x = 0; x < atlas.texels.WidthPx(); ++x) {
        ASSERT_EQ(atlas.texels.At(x, y, 3), 255) << atlas.name << ' ' << x << ' ' << y;
      }
    }
  }
}

TEST(SignAtlas, BoardsBearLetters) {
  const Texture signs = SignAtlas();
  const int width_px = signs.texels.WidthPx() / kSignAtlasColumns;
  const int height_px = signs.texels.HeightPx() / kSignAtlasRows;
  for (int row = 0; row < kSignAtlasRows; ++row) {
    int changes = 0;
    const int y = row * height_px + height_px / 2;
    for (int x = 1; x < width_px; ++x) {
      changes += std::abs(signs.texels.At(x, y, 1) - signs.texels.At(x - 1, y, 1)) > 20 ? 1 : 0;
    }
    EXPECT_GE(changes, 8) << "row " << row;
  }
}

}  // namespace
}  // namespace pfseq
