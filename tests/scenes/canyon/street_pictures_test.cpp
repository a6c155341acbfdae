// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/random.h"
#include "scenes/canyon/canyon_textures.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kCells = 8;

/// How often green changes by more than a third along a line of texels.
int NumEdges(const Image<uint8_t>& texels, int left, int y, int width) {
  int count = 0;
  for (int x = left + 1; x < left + width; ++x) {
    count += std::abs(texels.At(x, y, 1) - texels.At(x - 1, y, 1)) > 20 ? 1 : 0;
  }
  return count;
}

TEST(StreetPictures, AreOpaqueAndTheSameEachTime) {
  for (Texture (*paint)() : {&StreetPictureAtlas, &SignAtlas}) {
    const Texture atlas = paint();
    const Texture again = paint();
    for (int y = 0; y < atlas.texels.HeightPx(); ++y) {
      for (int x = 0; x < atlas.texels.WidthPx(); ++x) {
        ASSERT_EQ(atlas.texels.At(x, y, 3), 255) << atlas.name << ' ' << x << ' ' << y;
        for (int channel = 0; channel < 3; ++channel) {
          ASSERT_EQ(atlas.texels.At(x, y, channel), again.texels.At(x, y, channel)) << atlas.name;
        }
      }
    }
  }
}

TEST(SignAtlas, BoardsBearLetters) {
  const Texture signs = SignAtlas();
  const int width_px = signs.texels.WidthPx() / kSignAtlasColumns;
  const int height_px = signs.texels.HeightPx() / kSignAtlasRows;
  EXPECT_EQ(width_px, 8 * height_px);
  for (int row = 0; row < kSignAtlasRows; ++row) {
    for (int column = 0; column < kSignAtlasColumns; ++column) {
      const int y = row * height_px + height_px / 2;
      EXPECT_GE(NumEdges(signs.texels, column * width_px, y, width_px), 8)
          << "row " << row << " column " << column;
    }
  }
}

TEST(StreetPictureAtlas, PlatesBearWords) {
  const Texture atlas = StreetPictureAtlas();
  const int cell_px = atlas.texels.WidthPx() / kCells;
  for (int column = 0; column < kCells; ++column) {
    // Through the upper of two lines, in the third row.
    const int y = 2 * cell_px + static_cast<int>(0.33 * cell_px);
    EXPECT_GE(NumEdges(atlas.texels, column * cell_px, y, cell_px), 8) << column;
  }
}

TEST(StreetPictureAtlas, RoadSignsAreRedOrBlueOnWhiteAndNeverGreen) {
  const Texture atlas = StreetPictureAtlas();
  const int cell_px = atlas.texels.WidthPx() / kCells;
  for (int cell = 0; cell < 2 * kCells; ++cell) {
    int num_colored = 0;
    int num_white = 0;
    for (int y = 0; y < cell_px; ++y) {
      for (int x = 0; x < cell_px; ++x) {
        const auto at = [&](int channel) {
          return atlas.texels.At(cell % kCells * cell_px + x, cell / kCells * cell_px + y, channel);
        };
        const int red = at(0);
        const int green = at(1);
        const int blue = at(2);
        num_colored += red > 2 * green || blue > 2 * red ? 1 : 0;
        num_white += red > 150 && green > 150 && blue > 150 ? 1 : 0;
        EXPECT_LT(green, 1.3 * std::max(red, blue) + 10) << cell;
      }
    }
    EXPECT_GT(num_colored, 0.1 * cell_px * cell_px) << cell;
    EXPECT_GT(num_white, 0.03 * cell_px * cell_px) << cell;
  }
}

TEST(StreetPictureAtlas, NoTwoPostersAreAlike) {
  const Texture atlas = StreetPictureAtlas();
  const int cell_px = atlas.texels.WidthPx() / kCells;
  const auto mean_difference = [&](int a, int b) {
    double sum = 0.0;
    for (int y = 0; y < cell_px; ++y) {
      for (int x = 0; x < cell_px; ++x) {
        const auto green = [&](int cell) {
          return atlas.texels.At(cell % kCells * cell_px + x, cell / kCells * cell_px + y, 1);
        };
        sum += std::abs(green(a) - green(b));
      }
    }
    return sum / (cell_px * cell_px);
  };
  for (int a = 3 * kCells; a < kCells * kCells; ++a) {
    for (int b = 3 * kCells; b < a; ++b) {
      EXPECT_GT(mean_difference(a, b), 10.0) << a << ' ' << b;
    }
  }
}

TEST(StreetPictureCell, IsAnyPictureOfItsKindWithoutItsRim) {
  const auto cells_of = [](StreetPicture kind) {
    RandomStream random({5});
    std::set<std::pair<int, int>> cells;
    for (int i = 0; i < 2000; ++i) {
      const TextureWindow window = StreetPictureCell(kind, random);
      const int column = static_cast<int>(window.u0 * kCells);
      const int row = static_cast<int>(window.v0 * kCells);
      EXPECT_NEAR(window.u0 * kCells - column, 0.01, 1e-9);
      EXPECT_NEAR(window.u1 * kCells - column, 0.99, 1e-9);
      EXPECT_NEAR(window.v0 * kCells - row, 0.01, 1e-9);
      EXPECT_NEAR(window.v1 * kCells - row, 0.99, 1e-9);
      cells.insert({row, column});
    }
    return cells;
  };
  const auto rows = [](int first, int last) {
    std::set<std::pair<int, int>> cells;
    for (int row = first; row <= last; ++row) {
      for (int column = 0; column < kCells; ++column) {
        cells.insert({row, column});
      }
    }
    return cells;
  };
  EXPECT_EQ(cells_of(StreetPicture::kSign), rows(0, 1));
  EXPECT_EQ(cells_of(StreetPicture::kPlate), rows(2, 2));
  EXPECT_EQ(cells_of(StreetPicture::kPoster), rows(3, 7));
}

}  // namespace
}  // namespace pfseq
