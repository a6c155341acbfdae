// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/bootstrap.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

using Counts = std::array<int, kNumBootstrapCells>;

TEST(Bootstrap, EqualSharesInAllCellsLeaveNoDoubt) {
  Counts part, whole;
  part.fill(3);
  whole.fill(10);
  const Interval interval = BootstrapDraws(1).IntervalOf(part, whole);
  EXPECT_DOUBLE_EQ(interval.low, 0.3);
  EXPECT_DOUBLE_EQ(interval.high, 0.3);
}

TEST(Bootstrap, WidthIsThatOfTheMeanOfTheCells) {
  // Shares of 0 and 1 by halves: deviation 0.5 / sqrt(64), 95 % within 1.96 of it.
  Counts part, whole;
  whole.fill(100);
  for (int i = 0; i < kNumBootstrapCells; ++i) {
    part[i] = i % 2 == 0 ? 100 : 0;
  }
  const Interval interval = BootstrapDraws(1).IntervalOf(part, whole);
  EXPECT_NEAR(interval.low, 0.5 - 1.96 / 16.0, 0.03);
  EXPECT_NEAR(interval.high, 0.5 + 1.96 / 16.0, 0.03);
}

TEST(Bootstrap, FollowsFromTheSeedAlone) {
  Counts part, whole;
  whole.fill(7);
  for (int i = 0; i < kNumBootstrapCells; ++i) {
    part[i] = i % 7;
  }
  const Interval one = BootstrapDraws(5).IntervalOf(part, whole);
  const Interval again = BootstrapDraws(5).IntervalOf(part, whole);
  const Interval other = BootstrapDraws(6).IntervalOf(part, whole);
  EXPECT_EQ(one.low, again.low);
  EXPECT_EQ(one.high, again.high);
  EXPECT_TRUE(one.low != other.low || one.high != other.high);
}

TEST(Bootstrap, NothingHasNoInterval) {
  EXPECT_TRUE(std::isnan(BootstrapDraws(1).IntervalOf(Counts{}, Counts{}).low));
}

TEST(Bootstrap, CellsHaveEqualAreas) {
  Counts counts = {};
  for (int y = 0; y < 800; ++y) {
    for (int x = 0; x < 800; ++x) {
      const Vec2d point((x + 0.5) / 400.0 - 1.0, (y + 0.5) / 400.0 - 1.0);
      if (point.norm() < 1.0) {
        ++counts[BootstrapCell(point)];
      }
    }
  }
  for (const int count : counts) {
    EXPECT_NEAR(count, 800 * 800 * 0.785398 / 64.0, 120.0);
  }
}

}  // namespace
}  // namespace pfseq
