// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/feature_metrics.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using Points = std::vector<std::optional<Vec3d>>;
using testing::ElementsAre;

/// Points 10 m apart, of which the second set has those of `offsets_m` moved by so much.
struct Planted {
  Points first;
  Points second;

  explicit Planted(const std::vector<double>& offsets_m) {
    for (size_t i = 0; i < offsets_m.size(); ++i) {
      const Vec3d point_m(10.0 * static_cast<double>(i), -3.0, 20.0);
      first.push_back(point_m);
      second.push_back(point_m + Vec3d(0.0, 0.6, 0.8) * offsets_m[i]);
    }
  }
};

TEST(FeatureMetrics, CountsPlantedPointsAtEachTolerance) {
  // Two each just inside 5 mm, 1 cm, 5 cm and 15 cm; one far away.
  Planted planted({0.004, 0.0049, 0.006, 0.0099, 0.041, 0.049, 0.11, 0.149, 3.0});
  // The sky: no place, but detected; the second image has fewer points.
  planted.first.insert(planted.first.end(), 5, std::nullopt);
  planted.second.push_back(std::nullopt);

  const FeatureMetrics metrics = MeasureFeatures(planted.first, planted.second, {});
  EXPECT_THAT(metrics.matches, ElementsAre(2, 4, 4, 4, 4, 6, 6, 6, 6, 6, 6, 8));
  EXPECT_THAT(metrics.correct_matches, testing::Each(0));
  EXPECT_EQ(metrics.num_first, 14);
  EXPECT_EQ(metrics.num_second, 10);
  EXPECT_EQ(metrics.NumDetections(), 10);
  EXPECT_DOUBLE_EQ(metrics.Repeatability(0), 0.2);
  EXPECT_DOUBLE_EQ(metrics.Repeatability(11), 0.8);
}

TEST(FeatureMetrics, CorrectMatchesAreAttemptedOnesWithinTolerance) {
  const Planted planted({0.001, 0.025, 0.07, 0.2});
  // Right pairs, and one wrong pair 10 m apart.
  const std::vector<DescriptorMatch> attempted = {{0, 0, 9}, {1, 1, 9}, {2, 3, 9}, {3, 3, 9}};
  const std::vector<double> distances_m = MatchDistancesM(attempted, planted.first, planted.second);
  EXPECT_NEAR(distances_m[1], 0.025, 1e-9);
  EXPECT_GT(distances_m[2], 9.0);

  const FeatureMetrics metrics = MeasureFeatures(planted.first, planted.second, distances_m);
  EXPECT_THAT(metrics.correct_matches, ElementsAre(1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2));
  EXPECT_DOUBLE_EQ(metrics.MatchingScore(0), 0.25);
  EXPECT_DOUBLE_EQ(metrics.MatchingScore(11), 0.5);
}

TEST(FeatureMetrics, MatchesInTheSkyAreWrong) {
  Planted planted({0.0, 0.0});
  planted.second[1] = std::nullopt;
  const std::vector<double> distances_m =
      MatchDistancesM({{0, 0, 0}, {1, 1, 0}}, planted.first, planted.second);
  EXPECT_EQ(distances_m[1], std::numeric_limits<double>::infinity());
  EXPECT_EQ(MeasureFeatures(planted.first, planted.second, distances_m).correct_matches[11], 1);
}

TEST(FeatureMetrics, NoDetectionsScoreZero) {
  const FeatureMetrics metrics = MeasureFeatures({}, Planted({0.0}).second, {});
  EXPECT_EQ(metrics.NumDetections(), 0);
  EXPECT_EQ(metrics.Repeatability(3), 0.0);
  EXPECT_EQ(metrics.MatchingScore(3), 0.0);
}

TEST(FeatureMetrics, TolerancesAreThoseOfTheStudy) {
  EXPECT_THAT(kTolerancesM,
              ElementsAre(0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.10, 0.15));
}

}  // namespace
}  // namespace pfseq
