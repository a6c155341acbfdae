// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/gap_histogram.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(GapHistogram, QuantilesAreThoseOfTheSortedValues) {
  GapHistogram histogram;
  std::vector<double> values_m;
  RandomStream random{5};
  for (int i = 0; i < 10000; ++i) {
    values_m.push_back(std::pow(10.0, random.Uniform(-8.0, 1.0)));
    histogram.Add(values_m.back());
  }
  std::sort(values_m.begin(), values_m.end());
  for (const double share : {0.01, 0.5, 0.99, 1.0}) {
    const double exact_m = values_m[static_cast<size_t>(std::ceil(share * 10000.0)) - 1];
    EXPECT_GE(histogram.QuantileM(share), exact_m * (1.0 - 1e-9));
    EXPECT_LE(histogram.QuantileM(share), exact_m * 1.024);
  }
}

TEST(GapHistogram, SumOfTwoIsThatOfAllValues) {
  GapHistogram a, b, both;
  for (const double gap_m : {1e-7, 1e-3, 0.5}) {
    a.Add(gap_m);
    both.Add(gap_m);
  }
  for (const double gap_m : {2e-7, 3e-7, 4.0}) {
    b.Add(gap_m);
    both.Add(gap_m);
  }
  a.Add(b);
  for (const double share : {0.1, 0.5, 0.7, 1.0}) {
    EXPECT_EQ(a.QuantileM(share), both.QuantileM(share));
  }
}

TEST(GapHistogram, HoldsZeroInfinityAndNotANumber) {
  GapHistogram histogram;
  EXPECT_EQ(histogram.QuantileM(0.5), 0.0);
  histogram.Add(0.0);
  histogram.Add(0.0);
  EXPECT_EQ(histogram.QuantileM(0.5), 1e-12);
  histogram.Add(std::numeric_limits<double>::infinity());
  histogram.Add(std::nan(""));
  EXPECT_EQ(histogram.QuantileM(0.5), 1e-12);
  EXPECT_EQ(histogram.QuantileM(0.75), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace pfseq
