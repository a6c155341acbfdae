// SPDX-License-Identifier: Apache-2.0
// The measures of the 2014 study (Mikolajczyk and Schmid 2005, with a sphere in 3D as the
// criterion): two points match when they are closer than a tolerance in the world.
//
//   matches          pairs of detected points that match, one-to-one, closest first
//   repeatability    matches / detections
//   correct matches  attempted matches (of a matcher) that match
//   matching score   correct matches / detections
//
// Detections are the fewer of the two images'. Points without a place in the world (sky) are
// detections that never match.
#pragma once

#include "renderer/core/vector.h"
#include "validator/matching/brute_force_matcher.h"

#include <array>
#include <optional>
#include <vector>

namespace pfseq {

/// The study's twelve tolerances.
inline constexpr std::array<double, 12> kTolerancesM = {
    0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.10, 0.15};

/// Counts for each of kTolerancesM.
struct FeatureMetrics {
  int num_first = 0;
  int num_second = 0;
  std::array<int, kTolerancesM.size()> matches = {};
  std::array<int, kTolerancesM.size()> correct_matches = {};

  int NumDetections() const;
  /// 0 when there are no detections; so below.
  double Repeatability(size_t tolerance_idx) const;
  double MatchingScore(size_t tolerance_idx) const;
};

/// Distance in the world between the two points of each attempted match; +inf where one has no
/// place.
std::vector<double> MatchDistancesM(const std::vector<DescriptorMatch>& attempted,
                                    const std::vector<std::optional<Vec3d>>& first_m,
                                    const std::vector<std::optional<Vec3d>>& second_m);

FeatureMetrics MeasureFeatures(const std::vector<std::optional<Vec3d>>& first_m,
                               const std::vector<std::optional<Vec3d>>& second_m,
                               const std::vector<double>& match_distances_m);

}  // namespace pfseq
