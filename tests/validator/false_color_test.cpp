// SPDX-License-Identifier: Apache-2.0
#include "validator/false_color.h"

#include <array>
#include <limits>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

std::array<int, 3> ColorOf(float distance_m) {
  const Image<uint8_t> picture = DistanceInColor(Image<float>(1, 1, 1, distance_m));
  return {picture.At(0, 0, 0), picture.At(0, 0, 1), picture.At(0, 0, 2)};
}

TEST(DistanceInColor, RunsFromViridisDarkEndToItsLightEnd) {
  // The ends of the colour map, purple and yellow, to within a step of 8 bit.
  const auto [near_red, near_green, near_blue] = ColorOf(2.0F);
  EXPECT_NEAR(near_red, 68, 1);
  EXPECT_NEAR(near_green, 1, 1);
  EXPECT_NEAR(near_blue, 84, 1);
  const auto [far_red, far_green, far_blue] = ColorOf(200.0F);
  EXPECT_NEAR(far_red, 253, 1);
  EXPECT_NEAR(far_green, 231, 1);
  EXPECT_NEAR(far_blue, 37, 1);
}

TEST(DistanceInColor, GetsLighterWithTheLogarithm) {
  int green = ColorOf(2.0F)[1];
  for (const float distance_m : {4.0F, 8.0F, 16.0F, 32.0F, 64.0F, 128.0F}) {
    EXPECT_GT(ColorOf(distance_m)[1], green) << distance_m;
    green = ColorOf(distance_m)[1];
  }
  // The middle of the scale, 20 m, is the middle of the colours: teal.
  EXPECT_NEAR(ColorOf(20.0F)[1], 145, 3);
}

TEST(DistanceInColor, BeyondTheEndsColoursStay) {
  EXPECT_EQ(ColorOf(0.5F), ColorOf(2.0F));
  EXPECT_EQ(ColorOf(450.0F), ColorOf(200.0F));
}

TEST(DistanceInColor, SkyIsGreyAndOutsideIsBlack) {
  EXPECT_EQ(ColorOf(std::numeric_limits<float>::infinity()), (std::array{225, 225, 225}));
  EXPECT_EQ(ColorOf(0.0F), (std::array{0, 0, 0}));
}

TEST(DistanceLegend, ShowsTheColoursOfItsDistances) {
  const Image<uint8_t> legend = DistanceLegend(560);
  ASSERT_EQ(legend.WidthPx(), 560);
  ASSERT_EQ(legend.HeightPx(), 44);
  // The bar lies between margins of 24 px: its ends and, for 20 m, its middle.
  for (const auto& [x, distance_m] : {std::pair(24, 2.0F), {280, 20.0F}, {535, 200.0F}}) {
    const std::array<int, 3> expected = ColorOf(distance_m);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(legend.At(x, 8, channel), expected[static_cast<size_t>(channel)], 2)
          << distance_m;
    }
  }
  EXPECT_EQ(legend.At(10, 8, 0), 255);
}

}  // namespace
}  // namespace pfseq
