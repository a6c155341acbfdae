// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/spread_kernel.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

struct Moments {
  double sum = 0.0;
  Vec2d mean_px = Vec2d::Zero();
  double variance_x_px2 = 0.0;
};

/// Of a channel's weights, about the middle of the pixel.
Moments MomentsOf(const SpreadKernel& kernel, size_t channel) {
  const double cells_per_px = static_cast<double>(kernel.Side()) / (2 * kernel.ReachPx() + 1);
  Moments moments;
  double square = 0.0;
  for (int y = 0; y < kernel.Side(); ++y) {
    for (int x = 0; x < kernel.Side(); ++x) {
      const Vec2d place_px = Vec2d(x + 0.5, y + 0.5) / cells_per_px -
                             Vec2d::Constant(kernel.ReachPx() + 0.5);
      const double weight = kernel.At(channel, x, y);
      moments.sum += weight;
      moments.mean_px += weight * place_px;
      square += weight * place_px.x() * place_px.x();
    }
  }
  moments.mean_px /= moments.sum;
  moments.variance_x_px2 = square / moments.sum - moments.mean_px.x() * moments.mean_px.x();
  return moments;
}

TEST(SpreadKernel, AGaussianHasItsPlaceWidthAndLight) {
  SpreadKernel kernel(8);
  const Vec2d offset_px(1.3, -0.6);
  kernel.AddGaussian(offset_px, 1.1, Vec3d(0.5, 1.0, 2.0));
  for (size_t channel = 0; channel < 3; ++channel) {
    const Moments moments = MomentsOf(kernel, channel);
    EXPECT_NEAR(moments.sum, channel == 0 ? 0.5 : channel == 1 ? 1.0 : 2.0, 1e-3);
    EXPECT_LT((moments.mean_px - offset_px).norm(), 0.002);
    // The pixel is a box of 1 px, a cell one of half a pixel.
    constexpr double kCell_px = 1.0 / CellFilm::kCells;
    const double expected_px2 = 1.1 * 1.1 + 1.0 / 12.0 + kCell_px * kCell_px / 12.0;
    EXPECT_NEAR(moments.variance_x_px2, expected_px2, 0.002);
  }
}

TEST(SpreadKernel, TrimmedIsSmallerAndKeepsTheLight) {
  SpreadKernel kernel(12);
  kernel.AddGaussian(Vec2d::Zero(), 0.5, Vec3d::Constant(0.7));
  const SpreadKernel trimmed = kernel.Trimmed();
  EXPECT_LT(trimmed.ReachPx(), 4);
  EXPECT_NEAR(MomentsOf(trimmed, 1).sum, 1.0, 1e-5);
  EXPECT_LT(MomentsOf(trimmed, 1).mean_px.norm(), 1e-4);
}

}  // namespace
}  // namespace pfseq
