// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/kernel_grid.h"

#include <atomic>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kBlockPx = 8;

/// A spread away from the axis that grows with the distance to it.
SpreadKernel OutwardKernel(const Vec2d& from_axis_px) {
  SpreadKernel kernel(2);
  kernel.AddGaussian(0.02 * from_axis_px, 0.3, Vec3d(1.0, 0.5, 0.25));
  return kernel;
}

/// Counts how many kernels are made; expects all to be those of their places.
int NumMade(int width_px, int height_px, const Vec2d& axis_px) {
  std::atomic<int> num_made = 0;
  KernelGrid grid(width_px, height_px, kBlockPx, axis_px, [&](const Vec2d& middle_px) {
    ++num_made;
    return OutwardKernel(middle_px - axis_px);
  });
  for (int round = 0; round < 2; ++round) {
    for (int row = 0; row * kBlockPx < height_px; ++row) {
      for (int column = 0; column * kBlockPx < width_px; ++column) {
        const KernelGrid::Oriented found = grid.Of(column, row);
        const SpreadKernel expected =
            OutwardKernel(Vec2d(column + 0.5, row + 0.5) * kBlockPx - axis_px);
        for (int y = 0; y < expected.Side(); ++y) {
          for (int x = 0; x < expected.Side(); ++x) {
            EXPECT_NEAR(found.At(1, x, y), expected.At(1, x, y), 1e-6F)
                << column << " " << row << " " << x << " " << y;
          }
        }
      }
    }
  }
  return num_made;
}

TEST(KernelGrid, AQuarterStandsForAllAboutTheMiddle) {
  EXPECT_EQ(NumMade(64, 32, Vec2d(32, 16)), 4 * 2);
  // With a middle column.
  EXPECT_EQ(NumMade(40, 32, Vec2d(20, 16)), 3 * 2);
}

TEST(KernelGrid, EachBlockHasItsOwnWhereTheAxisIsElsewhere) {
  EXPECT_EQ(NumMade(64, 32, Vec2d(31, 16)), 8 * 2);
  EXPECT_EQ(NumMade(64, 32, Vec2d(32, 10)), 4 * 4);
  // The last blocks are cut off.
  EXPECT_EQ(NumMade(60, 30, Vec2d(30, 15)), 8 * 4);
}

}  // namespace
}  // namespace pfseq
