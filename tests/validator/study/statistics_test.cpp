// SPDX-License-Identifier: Apache-2.0
#include "validator/study/statistics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(StudentT975, IsThatOfTheTables) {
  // Abramowitz and Stegun, table 26.10, and the normal distribution's 1.95996.
  EXPECT_NEAR(StudentT975(1), 12.706, 5e-4);
  EXPECT_NEAR(StudentT975(2), 4.303, 5e-4);
  EXPECT_NEAR(StudentT975(5), 2.571, 5e-4);
  EXPECT_NEAR(StudentT975(9), 2.262, 5e-4);
  EXPECT_NEAR(StudentT975(30), 2.042, 5e-4);
  EXPECT_NEAR(StudentT975(1e6), 1.95996, 1e-4);
}

TEST(MeanInterval, IsThatOfStudentsSleepData) {
  // Student 1908, table on hyoscine: hours of sleep gained, differences of two drugs on ten
  // patients; mean 1.58, sd 1.23, t(9) = 4.0621.
  const std::vector<double> a = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
  const std::vector<double> b = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
  const Interval paired = PairedInterval(a, b);
  EXPECT_EQ(paired.count, 10U);
  EXPECT_NEAR(paired.mean, 1.58, 1e-12);
  EXPECT_NEAR(paired.low, 0.7001142, 1e-6);
  EXPECT_NEAR(paired.high, 2.4598858, 1e-6);
  EXPECT_TRUE(paired.IsAbove0());
  EXPECT_TRUE(PairedInterval(b, a).IsBelow0());
}

TEST(MeanInterval, LeavesOutWhatHasNoValue) {
  const Interval two = MeanInterval({kNone, 1.0, 3.0});
  EXPECT_EQ(two.count, 2U);
  EXPECT_EQ(two.mean, 2.0);
  EXPECT_NEAR(two.high - 2.0, StudentT975(1), 1e-9);  // s / sqrt(n) is 1.
  const Interval one = MeanInterval({4.0, kNone});
  EXPECT_EQ(one.mean, 4.0);
  EXPECT_TRUE(std::isnan(one.low));
  EXPECT_FALSE(one.IsAbove0());
  EXPECT_TRUE(std::isnan(MeanInterval({}).mean));
}

TEST(PairedInterval, NeedsBothValues) {
  const Interval interval = PairedInterval({1.0, kNone, 5.0}, {0.0, 1.0, 2.0});
  EXPECT_EQ(interval.count, 2U);
  EXPECT_EQ(interval.mean, 2.0);
}

TEST(SharesOfVariance, SplitWhatIsAdded) {
  // Levels 0 and 2, samples 0, 1 and 5, nothing else: sums of squares 6 and 28.
  const VarianceShares shares = SharesOfVariance({{0.0, 1.0, 5.0}, {2.0, 3.0, 7.0}});
  EXPECT_NEAR(shares.levels, 6.0 / 34.0, 1e-12);
  EXPECT_NEAR(shares.samples, 28.0 / 34.0, 1e-12);
  EXPECT_NEAR(shares.rest, 0.0, 1e-12);
}

TEST(SharesOfVariance, TellInteraction) {
  // Each level is best on one sample: the means are all the same.
  const VarianceShares shares = SharesOfVariance({{0.0, 1.0}, {1.0, 0.0}});
  EXPECT_NEAR(shares.rest, 1.0, 1e-12);
  // A sample that lacks a level does not count.
  const VarianceShares same = SharesOfVariance({{0.0, 1.0, 9.0}, {1.0, 0.0, kNone}});
  EXPECT_NEAR(same.rest, 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(SharesOfVariance({{1.0, 1.0}, {1.0, 1.0}}).levels));
}

}  // namespace
}  // namespace pfseq
