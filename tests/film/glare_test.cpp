// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/glare.h"

#include "tests/film/small_lens.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Image<float> Star() {
  Image<float> image(kSmallSizePx, kSmallSizePx, 3);
  image.At(150, 140, 0) = 1e6F;
  image.At(150, 140, 1) = 2e6F;
  return image;
}

double Sum(const Image<float>& image, int channel) {
  double sum = 0.0;
  for (int y = 0; y < image.HeightPx(); ++y) {
    for (int x = 0; x < image.WidthPx(); ++x) {
      sum += image.At(x, y, channel);
    }
  }
  return sum;
}

TEST(Glare, KeepsTheLight) {
  Image<float> image = Star();
  Glare({.bloom = 0.2, .bloom_radius_px = 8.0, .veil = 0.1}, SmallLens()).Apply(image, 2);
  EXPECT_NEAR(Sum(image, 0), 1e6, 2e3);
  EXPECT_NEAR(Sum(image, 1), 2e6, 4e3);
  EXPECT_EQ(Sum(image, 2), 0.0);
}

TEST(Glare, HalfOfTheBloomFallsWithinItsRadius) {
  for (const double radius_px : {4.0, 12.0}) {
    Image<float> image = Star();
    Glare({.bloom = 0.2, .bloom_radius_px = radius_px}, SmallLens()).Apply(image, 2);
    EXPECT_NEAR(image.At(150, 140, 0), 0.8e6, 0.02e6);
    double inside = 0.0;
    for (int y = 0; y < kSmallSizePx; ++y) {
      for (int x = 0; x < kSmallSizePx; ++x) {
        const bool is_near = std::hypot(x - 150, y - 140) < radius_px;
        inside += is_near ? image.At(x, y, 0) : 0.0;
      }
    }
    EXPECT_NEAR((inside - 0.8e6) / 0.2e6, 0.5, 0.03) << radius_px;
  }
}

TEST(Glare, VeilIsEvenOverTheImageCircle) {
  Image<float> image = Star();
  Glare({.veil = 0.1}, SmallLens()).Apply(image, 2);
  const double area_px2 = std::numbers::pi * kSmallCircleRadiusPx * kSmallCircleRadiusPx;
  EXPECT_NEAR(image.At(40, 150, 0), 0.1e6 / area_px2, 0.01e6 / area_px2);
  EXPECT_EQ(image.At(40, 150, 0), image.At(200, 100, 0));
  EXPECT_EQ(image.At(2, 2, 0), 0.0F);
}

TEST(Glare, DoesNotDependOnThreads) {
  Image<float> one = Star();
  Image<float> three = Star();
  const GlareSpec spec{.bloom = 0.2, .bloom_radius_px = 20.0, .veil = 0.1};
  Glare(spec, SmallLens()).Apply(one, 1);
  Glare(spec, SmallLens()).Apply(three, 3);
  EXPECT_EQ(one, three);
}

}  // namespace
}  // namespace pfseq
