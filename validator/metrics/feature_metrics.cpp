// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/feature_metrics.h"

#include "validator/metrics/one_to_one.h"

#include <algorithm>
#include <limits>

namespace pfseq {
namespace {

double Share(int part, int whole) { return whole > 0 ? static_cast<double>(part) / whole : 0.0; }

void CountWithin(double distance_m, std::array<int, kTolerancesM.size()>& counts) {
  for (size_t i = 0; i < kTolerancesM.size(); ++i) {
    counts[i] += distance_m < kTolerancesM[i] ? 1 : 0;
  }
}

}  // namespace

int FeatureMetrics::NumDetections() const { return std::min(num_first, num_second); }

double FeatureMetrics::Repeatability(size_t tolerance_idx) const {
  return Share(matches[tolerance_idx], NumDetections());
}

double FeatureMetrics::MatchingScore(size_t tolerance_idx) const {
  return Share(correct_matches[tolerance_idx], NumDetections());
}

std::vector<double> MatchDistancesM(const std::vector<DescriptorMatch>& attempted,
                                    const std::vector<std::optional<Vec3d>>& first_m,
                                    const std::vector<std::optional<Vec3d>>& second_m) {
  std::vector<double> distances_m;
  distances_m.reserve(attempted.size());
  for (const DescriptorMatch& match : attempted) {
    const std::optional<Vec3d>& first = first_m[match.first_idx];
    const std::optional<Vec3d>& second = second_m[match.second_idx];
    distances_m.push_back(first && second ? (*first - *second).norm()
                                          : std::numeric_limits<double>::infinity());
  }
  return distances_m;
}

FeatureMetrics MeasureFeatures(const std::vector<std::optional<Vec3d>>& first_m,
                               const std::vector<std::optional<Vec3d>>& second_m,
                               const std::vector<double>& match_distances_m) {
  FeatureMetrics metrics;
  metrics.num_first = static_cast<int>(first_m.size());
  metrics.num_second = static_cast<int>(second_m.size());
  // Closest first: the pairs within a smaller tolerance are the beginning of those within the
  // largest.
  for (const PointPair& pair : OneToOneClosestFirst(first_m, second_m, kTolerancesM.back())) {
    CountWithin(pair.distance_m, metrics.matches);
  }
  for (const double distance_m : match_distances_m) {
    CountWithin(distance_m, metrics.correct_matches);
  }
  return metrics;
}

}  // namespace pfseq
