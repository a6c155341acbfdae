// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_painting.h"

#include "tests/scenes/canyon/wall_test_support.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

WallPainting PlainPainting(WallSurface surface) { return PlainWall(surface, {{0, 4}, {3, 7}}); }

/// Mean green of a part of a wall whose area starts at (0, 4), 3 m high.
double MeanGreen(const Texture& texture, const Vec2d& low_m, const Vec2d& high_m) {
  double sum = 0.0;
  int count = 0;
  const double per_m = texture.texels.WidthPx() / 3.0;
  for (int y = static_cast<int>((7.0 - high_m.y()) * per_m); y < (7.0 - low_m.y()) * per_m; ++y) {
    for (int x = static_cast<int>(low_m.x() * per_m); x < high_m.x() * per_m; ++x, ++count) {
      sum += texture.texels.At(x, y, 1);
    }
  }
  return sum / count;
}

class PaintedSurface : public testing::TestWithParam<WallSurface> {};

TEST_P(PaintedSurface, DependsOnItsDescriptionAlone) {
  WallPainting painting = PlainPainting(GetParam());
  const PaintedWall wall = Paint(painting);
  const PaintedWall again = Paint(painting);
  EXPECT_EQ(wall.color.texels, again.color.texels);
  EXPECT_EQ(wall.normal.texels, again.normal.texels);
  painting.look.seed = 6;
  EXPECT_NE(Paint(painting).color.texels, wall.color.texels);
}

TEST_P(PaintedSurface, KeepsTheColourItIsAskedForWhenNew) {
  WallPainting painting = PlainPainting(GetParam());
  painting.look.age = 0.0;
  const Vec2d low_m(0.2, 4.2);
  const double green = MeanGreen(Paint(painting).color, low_m, {2.8, 6.4}) / 255.0;
  EXPECT_NEAR(green, 0.65, 0.13);
}

INSTANTIATE_TEST_SUITE_P(Surfaces,
                         PaintedSurface,
                         testing::Values(WallSurface::kPlaster,
                                         WallSurface::kBrick,
                                         WallSurface::kAshlar,
                                         WallSurface::kConcrete,
                                         WallSurface::kRubble),
                         [](const auto& test) {
                           return "Surface" + std::to_string(static_cast<int>(test.param));
                         });

TEST(WallPainting, RubbleIsOfStonesThatDifferMoreThanAshlarDoes) {
  const auto spread = [](WallSurface surface) {
    WallPainting painting = PlainPainting(surface);
    painting.look.age = 0.0;
    const Texture wall = Paint(painting).color;
    // Of means over 25 cm: less than a stone, more than grain and joints.
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kNum = 8;
    for (int i = 0; i < kNum * kNum; ++i) {
      const Vec2d low_m(0.25 + 0.3 * (i % kNum), 4.25 + 0.25 * (i / kNum));
      const double green = MeanGreen(wall, low_m, low_m + Vec2d(0.25, 0.25));
      sum += green;
      squares += green * green;
    }
    const double mean = sum / (kNum * kNum);
    return std::sqrt(squares / (kNum * kNum) - mean * mean) / mean;
  };
  EXPECT_GT(spread(WallSurface::kRubble), 1.6 * spread(WallSurface::kAshlar));
}

TEST(WallPainting, RainLeavesStreaksUnderALedgeAlone) {
  WallPainting painting = PlainPainting(WallSurface::kPlaster);
  painting.look.age = 1.0;
  const Texture without = Paint(painting).color;
  painting.ledges = {{1.0, 2.0, 6.0}};
  const Texture with = Paint(painting).color;
  EXPECT_LT(MeanGreen(with, {1.0, 5.6}, {2.0, 5.98}),
            MeanGreen(without, {1.0, 5.6}, {2.0, 5.98}) - 3.0);
  EXPECT_EQ(MeanGreen(with, {0.0, 4.0}, {0.9, 7.0}), MeanGreen(without, {0.0, 4.0}, {0.9, 7.0}));
  EXPECT_EQ(MeanGreen(with, {1.0, 6.05}, {2.0, 7.0}), MeanGreen(without, {1.0, 6.05}, {2.0, 7.0}));
}

TEST(WallPainting, TexelsHaveTheSizeAsked) {
  WallPainting painting = PlainPainting(WallSurface::kBrick);
  painting.normal_step = 2;
  const PaintedWall wall = Paint(painting);
  EXPECT_EQ(wall.color.texels.WidthPx(), 150);
  EXPECT_EQ(wall.color.texels.HeightPx(), 150);
  EXPECT_EQ(wall.normal.texels.WidthPx(), 75);
  EXPECT_FALSE(wall.normal.is_srgb);
  EXPECT_TRUE(wall.color.is_srgb);
}

TEST(WallPainting, PhotographsLieUprightAndWhereTheyAreTold) {
  // Red above, blue below; the left half of the lower part is green.
  auto image = std::make_shared<Image<uint8_t>>(40, 20, 4, uint8_t{255});
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      image->At(x, y, 0) = y < 10 ? 200 : 20;
      image->At(x, y, 1) = y >= 10 && x < 20 ? 200 : 20;
      image->At(x, y, 2) = y >= 10 && x >= 20 ? 200 : 20;
    }
  }
  WallPainting painting = PlainPainting(WallSurface::kPlaster);
  painting.photo = {image, nullptr, nullptr, {0, 4}, {3, 3}, false};
  const Texture wall = Paint(painting).color;
  EXPECT_GT(wall.texels.At(75, 30, 0), 150);
  EXPECT_GT(wall.texels.At(30, 120, 1), 150);
  EXPECT_GT(wall.texels.At(120, 120, 2), 150);
  painting.photo.is_mirrored = true;
  EXPECT_GT(Paint(painting).color.texels.At(120, 120, 1), 150);
}

TEST(WallPainting, MapsOfAPhotographTiltTheNormalAndSetTheRoughness) {
  WallPainting painting = PlainPainting(WallSurface::kPlaster);
  const auto even = [](uint8_t red, uint8_t green, uint8_t blue) {
    auto image = std::make_shared<Image<uint8_t>>(8, 8, 4, uint8_t{255});
    for (int i = 0; i < 64; ++i) {
      image->At(i % 8, i / 8, 0) = red;
      image->At(i % 8, i / 8, 1) = green;
      image->At(i % 8, i / 8, 2) = blue;
    }
    return image;
  };
  // (0.6, 0.2, 0.8), about.
  painting.photo = {
      even(120, 120, 120), even(204, 153, 230), even(0, 51, 0), {0, 4}, {3, 3}, false};
  const auto mean = [](const Texture& texture, int channel) {
    double sum = 0.0;
    for (int y = 0; y < texture.texels.HeightPx(); ++y) {
      for (int x = 0; x < texture.texels.WidthPx(); ++x) {
        sum += texture.texels.At(x, y, channel);
      }
    }
    return sum / static_cast<double>(texture.texels.NumPixels());
  };
  const double length = std::hypot(0.6, 0.2, 0.804);
  const PaintedWall wall = Paint(painting);
  EXPECT_NEAR(mean(wall.normal, 0) / 127.5 - 1.0, 0.6 / length, 0.02);
  EXPECT_NEAR(mean(wall.normal, 1) / 127.5 - 1.0, 0.2 / length, 0.02);
  EXPECT_NEAR(mean(wall.roughness, 1), 51.0, 0.5);
  painting.photo.is_mirrored = true;
  EXPECT_NEAR(mean(Paint(painting).normal, 0) / 127.5 - 1.0, -0.6 / length, 0.02);
}

}  // namespace
}  // namespace pfseq
