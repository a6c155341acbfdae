// SPDX-License-Identifier: Apache-2.0
#include "validator/features/sift.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// A bright round blob on grey, centred at a position in our convention.
Image<uint8_t> BlobImage(const Vec2d& centre_px) {
  Image<uint8_t> rgb(120, 90, 3);
  for (int y = 0; y < rgb.HeightPx(); ++y) {
    for (int x = 0; x < rgb.WidthPx(); ++x) {
      const double squared_px2 = (Vec2d(x + 0.5, y + 0.5) - centre_px).squaredNorm();
      const double value = 60.0 + 180.0 * std::exp(-squared_px2 / (2.0 * 3.0 * 3.0));
      for (int channel = 0; channel < 3; ++channel) {
        rgb.At(x, y, channel) = static_cast<uint8_t>(std::lround(value));
      }
    }
  }
  return rgb;
}

Image<uint8_t> NoiseImage() {
  Image<uint8_t> rgb(160, 120, 3);
  RandomStream random{7};
  for (int y = 0; y < rgb.HeightPx(); ++y) {
    for (int x = 0; x < rgb.WidthPx(); ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        rgb.At(x, y, channel) = static_cast<uint8_t>(random.Integer(0, 255));
      }
    }
  }
  return rgb;
}

TEST(Sift, FindsABlobWhereItIs) {
  // OpenCV 4.6 is a quarter of a pixel off to the right and down (its issue 23123).
  const Vec2d bias_px(0.25, 0.25);
  for (const Vec2d& centre_px : {Vec2d(60.5, 45.5), Vec2d(61.0, 40.25)}) {
    const Features features = DetectSift(BlobImage(centre_px), SiftSetting());
    ASSERT_FALSE(features.pixels_px.empty());
    for (const Vec2d& pixel_px : features.pixels_px) {
      EXPECT_LT((pixel_px - centre_px - bias_px).norm(), 0.1) << pixel_px.transpose();
    }
  }
}

TEST(Sift, GivesADescriptorForEachPoint) {
  const Features features = DetectSift(NoiseImage(), SiftSetting());
  EXPECT_GT(features.pixels_px.size(), 20U);
  EXPECT_EQ(features.descriptors.WidthPx(), 128);
  EXPECT_EQ(static_cast<size_t>(features.descriptors.HeightPx()), features.pixels_px.size());
  const auto values = features.descriptors.Values();
  EXPECT_GT(*std::max_element(values.begin(), values.end()), 50);
}

TEST(Sift, FindsNothingInAnEvenImage) {
  const Features features = DetectSift(Image<uint8_t>(64, 64, 3, 128), SiftSetting());
  EXPECT_TRUE(features.pixels_px.empty());
  EXPECT_EQ(features.descriptors.HeightPx(), 0);
}

TEST(Sift, HigherContrastThresholdKeepsFewerPoints) {
  SiftSetting strict;
  strict.contrast_threshold = 0.3;
  EXPECT_LT(DetectSift(NoiseImage(), strict).pixels_px.size(),
            DetectSift(NoiseImage(), SiftSetting()).pixels_px.size());
}

TEST(Sift, IsNamedAsInTheStudy) {
  EXPECT_EQ(SiftSetting().Name(), "SIFT nopol 0.04 5.0 1.6");
  EXPECT_EQ((SiftSetting{3, 0.02, 20.0, 3.0}).Name(), "SIFT nopol 0.02 20.0 3.0");
}

}  // namespace
}  // namespace pfseq
