// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/noise_tile.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

NoiseTile Tile(uint64_t seed) {
  return {1000.0,
          {{NoiseOctave::Kind::kGradient, 5, 1.0F}, {NoiseOctave::Kind::kBillow, 11, 0.5F}},
          seed};
}

TEST(NoiseTile, RepeatsAfterItsSideInBothDirections) {
  const NoiseTile tile = Tile(1);
  for (int i = 0; i < 100; ++i) {
    const float x_m = 7.3F * static_cast<float>(i) - 300.0F;
    const float y_m = 3.1F * static_cast<float>(i) - 100.0F;
    EXPECT_LT((tile.At(x_m, y_m) - tile.At(x_m + 1000.0F, y_m)).norm(), 2e-3F);
    EXPECT_LT((tile.At(x_m, y_m) - tile.At(x_m, y_m - 2000.0F)).norm(), 2e-3F);
  }
}

TEST(NoiseTile, IsContinuousAcrossItsEdge) {
  // A lattice that did not close would make a step there.
  const NoiseTile tile = Tile(1);
  float most = 0.0F;
  for (int i = 0; i < NoiseTile::kSizePx; ++i) {
    most = std::max(most, (tile.Pixel(-1, i) - tile.Pixel(0, i)).lpNorm<Eigen::Infinity>());
    most = std::max(most, (tile.Pixel(i, -1) - tile.Pixel(i, 0)).lpNorm<Eigen::Infinity>());
  }
  EXPECT_LT(most, 0.1F);
}

TEST(NoiseTile, HasMeanZeroAndTwoIndependentValues) {
  const NoiseTile tile = Tile(1);
  Vec2d sum = Vec2d::Zero();
  Vec2d squares = Vec2d::Zero();
  double product = 0.0;
  for (int row = 0; row < NoiseTile::kSizePx; ++row) {
    for (int column = 0; column < NoiseTile::kSizePx; ++column) {
      const Vec2d value = tile.Pixel(column, row).cast<double>();
      sum += value;
      squares += value.cwiseAbs2();
      product += value.x() * value.y();
    }
  }
  constexpr double kNum = NoiseTile::kSizePx * NoiseTile::kSizePx;
  EXPECT_LT((sum / kNum).norm(), 1e-5);
  EXPECT_GT((squares / kNum).minCoeff(), 0.02);
  EXPECT_LT(std::abs(product) / std::sqrt(squares.x() * squares.y()), 0.4);
}

TEST(NoiseTile, DependsOnTheSeedAlone) {
  EXPECT_EQ(Tile(1).At(123.4F, 56.7F), Tile(1).At(123.4F, 56.7F));
  EXPECT_NE(Tile(1).At(123.4F, 56.7F), Tile(2).At(123.4F, 56.7F));
}

}  // namespace
}  // namespace pfseq
