// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/fractal_tile.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(FractalTile, HasMeanZeroAndUnitDeviation) {
  const FractalTile tile(3);
  double sum = 0.0;
  double sum2 = 0.0;
  constexpr int kSize = FractalTile::kSize_px;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double value = tile.At(x, y);
      sum += value;
      sum2 += value * value;
    }
  }
  EXPECT_NEAR(sum / (kSize * kSize), 0.0, 1e-4);
  EXPECT_NEAR(sum2 / (kSize * kSize), 1.0, 1e-3);
}

TEST(FractalTile, RepeatsWithoutASeamAndIsContinuous) {
  const FractalTile& tile = SharedFractal();
  for (int i = 0; i < 200; ++i) {
    const double x = 3.7 * i - 200.0;
    const double y = 1.3 * i - 90.0;
    EXPECT_FLOAT_EQ(tile.At(x, y), tile.At(x + FractalTile::kSize_px, y - FractalTile::kSize_px));
    EXPECT_NEAR(tile.At(x, y), tile.At(x + 1e-3, y), 0.02);
  }
}

}  // namespace
}  // namespace pfseq
