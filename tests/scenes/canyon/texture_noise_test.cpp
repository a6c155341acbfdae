// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/texture_noise.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(TileNoise, RepeatsWithoutASeam) {
  for (double y = 0.0; y < 1.0; y += 0.037) {
    EXPECT_NEAR(TileNoise(1, 8, 1e-9, y), TileNoise(1, 8, 1.0 - 1e-9, y), 1e-6);
    EXPECT_NEAR(TileNoise(1, 8, y, 0.3), TileNoise(1, 8, y + 1.0, 1.3), 1e-9);
    EXPECT_NEAR(TileFractal(1, 4, 3, 0.25, y), TileFractal(1, 4, 3, -0.75, y), 1e-9);
  }
}

TEST(TileNoise, FillsItsRangeAndDependsOnTheSeed) {
  double low = 1.0;
  double high = 0.0;
  double difference = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double value = TileNoise(1, 16, 0.0613 * i, 0.0377 * i);
    low = std::min(low, value);
    high = std::max(high, value);
    difference += std::abs(value - TileNoise(2, 16, 0.0613 * i, 0.0377 * i));
  }
  EXPECT_GE(low, 0.0);
  EXPECT_LT(low, 0.2);
  EXPECT_LT(high, 1.0);
  EXPECT_GT(high, 0.8);
  EXPECT_GT(difference, 100.0);
}

}  // namespace
}  // namespace pfseq
