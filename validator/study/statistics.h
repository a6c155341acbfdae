// SPDX-License-Identifier: Apache-2.0
// What few samples can tell. Values that are NaN are left out.
#pragma once

#include <cstddef>
#include <vector>

namespace pfseq {

/// A mean with its two-sided 95 % confidence interval by Student's t distribution (Student 1908,
/// "The probable error of a mean"): mean -+ t(0.975, n - 1) s / sqrt(n). It takes the samples for
/// independent and about normal. Limits are NaN below two samples, all is NaN without any.
struct Interval {
  size_t count = 0;
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;

  bool IsAbove0() const { return low > 0.0; }
  bool IsBelow0() const { return high < 0.0; }
};

Interval MeanInterval(const std::vector<double>& values);

/// Of a[i] - b[i]: what both have in common (the place, the scene) drops out (Box, Hunter and
/// Hunter, "Statistics for Experimenters", 2nd ed. 2005, section 3.2). Sizes agree.
Interval PairedInterval(const std::vector<double>& a, const std::vector<double>& b);

/// t such that a Student variable of so many degrees of freedom (> 0) lies within -+t with
/// probability 0.95; by the regularised incomplete beta function (Abramowitz and Stegun 26.7.1).
double StudentT975(double degrees_of_freedom);

/// How the variance of a table of levels by samples, without replication, splits (analysis of
/// variance in two ways; Fisher 1925). Parts of the sum of squares; they add up to 1. NaN where
/// nothing varies.
struct VarianceShares {
  /// Eta squared: what the levels' means explain.
  double levels = 0.0;
  /// What the samples' means explain: some places and scenes are harder than others.
  double samples = 0.0;
  /// What is neither: the levels do not act alike on all samples.
  double rest = 0.0;
};

/// Of values[level][sample]; samples without a value at each level are left out.
VarianceShares SharesOfVariance(const std::vector<std::vector<double>>& values);

}  // namespace pfseq
