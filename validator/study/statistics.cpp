// SPDX-License-Identifier: Apache-2.0
#include "validator/study/statistics.h"

#include "renderer/core/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <unsupported/Eigen/SpecialFunctions>

namespace pfseq {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double Square(double value) { return value * value; }

/// The probability that a Student variable lies outside -+t.
double BothTails(double t, double degrees_of_freedom) {
  const double x = degrees_of_freedom / (degrees_of_freedom + t * t);
  return Eigen::numext::betainc(0.5 * degrees_of_freedom, 0.5, x);
}

}  // namespace

double StudentT975(double degrees_of_freedom) {
  PFSEQ_CHECK(degrees_of_freedom > 0.0, "{} degrees of freedom", degrees_of_freedom);
  constexpr double kOutside = 0.05;
  double low = 0.0;
  double high = 1.0;
  while (BothTails(high, degrees_of_freedom) > kOutside) {
    high *= 2.0;
  }
  constexpr int kNumHalvings = 60;
  for (int i = 0; i < kNumHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (BothTails(middle, degrees_of_freedom) > kOutside ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Interval MeanInterval(const std::vector<double>& values) {
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known), [](double value) {
    return !std::isnan(value);
  });
  if (known.empty()) {
    return {0, kNone, kNone, kNone};
  }
  const double mean = Mean(known);
  if (known.size() < 2) {
    return {1, mean, kNone, kNone};
  }
  double squares = 0.0;
  for (const double value : known) {
    squares += Square(value - mean);
  }
  const auto count = static_cast<double>(known.size());
  const double half = StudentT975(count - 1.0) * std::sqrt(squares / (count - 1.0) / count);
  return {known.size(), mean, mean - half, mean + half};
}

Interval PairedInterval(const std::vector<double>& a, const std::vector<double>& b) {
  PFSEQ_CHECK(a.size() == b.size(), "{} and {} samples", a.size(), b.size());
  std::vector<double> differences(a.size());
  std::transform(a.begin(), a.end(), b.begin(), differences.begin(), std::minus<>());
  return MeanInterval(differences);
}

VarianceShares SharesOfVariance(const std::vector<std::vector<double>>& values) {
  std::vector<std::vector<double>> columns;
  for (size_t sample = 0; !values.empty() && sample < values[0].size(); ++sample) {
    std::vector<double> column;
    for (const std::vector<double>& level : values) {
      column.push_back(level[sample]);
    }
    if (std::none_of(column.begin(), column.end(), [](double v) { return std::isnan(v); })) {
      columns.push_back(std::move(column));
    }
  }
  if (columns.empty()) {
    return {kNone, kNone, kNone};
  }
  const auto num_samples = static_cast<double>(columns.size());
  const auto num_levels = static_cast<double>(values.size());
  std::vector<double> level_means(values.size(), 0.0);
  std::vector<double> sample_means;
  for (const std::vector<double>& column : columns) {
    sample_means.push_back(Mean(column));
    for (size_t level = 0; level < column.size(); ++level) {
      level_means[level] += column[level] / num_samples;
    }
  }
  const double mean = Mean(sample_means);
  double total = 0.0, of_levels = 0.0, of_samples = 0.0;
  for (const std::vector<double>& column : columns) {
    for (const double value : column) {
      total += Square(value - mean);
    }
  }
  for (const double level_mean : level_means) {
    of_levels += num_samples * Square(level_mean - mean);
  }
  for (const double sample_mean : sample_means) {
    of_samples += num_levels * Square(sample_mean - mean);
  }
  if (total <= 0.0) {
    return {kNone, kNone, kNone};
  }
  return {
      of_levels / total, of_samples / total, std::max(0.0, total - of_levels - of_samples) / total};
}

}  // namespace pfseq
