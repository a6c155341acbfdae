// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/judge.h"

#include "renderer/core/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Key points far from each other, and copies of them in the second view at chosen distances.
class PlantedPair {
 public:
  PlantedPair() {
    pair_.first.width_px = pair_.second.width_px = 1000;
    pair_.first.height_px = pair_.second.height_px = 1000;
  }

  /// A place that both see `distance_m` apart; nothing: only the first, or the second, sees it.
  int Both(double distance_m) {
    const Vec3d place_m = NextPlace();
    AddFirst(place_m);
    AddSecond(place_m + Vec3d(0.0, distance_m, 0.0));
    return static_cast<int>(pair_.first.pixels_px.size()) - 1;
  }
  void OnlyFirst() { AddFirst(NextPlace()); }
  void OnlySecond() { AddSecond(NextPlace()); }
  void SkyInBoth() {
    AddFirst(std::nullopt);
    AddSecond(std::nullopt);
  }
  void AddFirst(const std::optional<Vec3d>& place_m) {
    Add(pair_.first, pair_.points.first_m, place_m);
  }
  void AddSecond(const std::optional<Vec3d>& place_m) {
    Add(pair_.second, pair_.points.second_m, place_m);
  }

  const JudgedPair& Pair() const { return pair_; }

 private:
  Vec3d NextPlace() { return {static_cast<double>(count_++), 0.0, 10.0}; }

  void Add(JudgedView& view, ScenePoints& points_m, const std::optional<Vec3d>& place_m) {
    const auto i = static_cast<double>(view.pixels_px.size());
    view.pixels_px.emplace_back(100.0 + 40.0 * std::fmod(i, 20.0),
                                100.0 + 40.0 * std::floor(i / 20.0));
    view.in_disc.emplace_back((view.pixels_px.back() - Vec2d(500.0, 500.0)) / 700.0);
    view.sizes_px.push_back(8.0);
    view.responses.push_back(1.0 / (1.0 + i));
    points_m.push_back(place_m);
  }

  JudgedPair pair_;
  int count_ = 0;
};

const Metric& MetricOf(const SettingResult& result, const std::string& name) {
  for (const Metric& metric : result.metrics) {
    if (metric.name == name) {
      return metric;
    }
  }
  ADD_FAILURE() << "no metric " << name;
  static const Metric none;
  return none;
}

DetectionJudgement Judged(const PlantedPair& planted, const JudgeSetting& setting = {}) {
  return JudgeDetections(planted.Pair(), setting, BootstrapDraws(1));
}

SettingResult JudgedMatches(const PlantedPair& planted,
                            const std::vector<std::pair<int, int>>& attempted) {
  return JudgeMatches(planted.Pair(), attempted, Judged(planted), {}, BootstrapDraws(1));
}

TEST(Judge, PlantedRepeatabilityIsFoundExactlyAtEachTolerance) {
  // Between each two tolerances i + 1 matches; 30 more points in the first view, 10 in the second.
  PlantedPair planted;
  std::vector<double> expected;
  int num_matches = 0;
  for (size_t i = 0; i < kTolerancesM.size(); ++i) {
    for (size_t k = 0; k <= i; ++k) {
      planted.Both(kTolerancesM[i] - 0.001);
      ++num_matches;
    }
    expected.push_back(num_matches);
  }
  for (int i = 0; i < 30; ++i) {
    planted.OnlyFirst();
  }
  for (int i = 0; i < 8; ++i) {
    planted.OnlySecond();
  }
  planted.SkyInBoth();
  planted.SkyInBoth();
  const SettingResult result = Judged(planted).result;
  EXPECT_EQ(MetricOf(result, "matches").values, expected);
  EXPECT_EQ(MetricOf(result, "detections_first").values[0], num_matches + 32.0);
  EXPECT_EQ(MetricOf(result, "detections_second").values[0], num_matches + 10.0);
  for (size_t i = 0; i < kTolerancesM.size(); ++i) {
    EXPECT_DOUBLE_EQ(MetricOf(result, "repeatability").values[i],
                     expected[i] / (num_matches + 10.0));
    EXPECT_DOUBLE_EQ(MetricOf(result, "repeatability_reference").values[i],
                     expected[i] / (num_matches + 32.0));
    EXPECT_LE(MetricOf(result, "repeatability").low[i],
              MetricOf(result, "repeatability").values[i]);
    EXPECT_GE(MetricOf(result, "repeatability").high[i],
              MetricOf(result, "repeatability").values[i]);
    // All points are apart: nothing is redundant.
    EXPECT_NEAR(MetricOf(result, "nonredundant_repeatability").values[i],
                expected[i] / (num_matches + 10.0),
                1e-3);
  }
}

TEST(Judge, ConflictsAreSettledClosestFirst) {
  // Two of the first view are near one of the second: one match at each tolerance that allows any.
  PlantedPair planted;
  planted.AddFirst(Vec3d(0.0, 0.0, 10.0));
  planted.AddFirst(Vec3d(0.03, 0.0, 10.0));
  planted.AddSecond(Vec3d(0.018, 0.0, 10.0));
  planted.AddSecond(Vec3d(50.0, 0.0, 10.0));
  const DetectionJudgement judged = Judged(planted);
  EXPECT_EQ(judged.matches, (std::vector<int>{0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
}

TEST(Judge, PlantedMatchesAreFoundExactlyAtEachTolerance) {
  PlantedPair planted;
  std::vector<std::pair<int, int>> attempted;
  std::vector<double> correct;
  for (size_t i = 0; i < kTolerancesM.size(); ++i) {
    planted.Both(kTolerancesM[i] - 0.001);
    planted.Both(kTolerancesM[i] - 0.001);
    const int idx = static_cast<int>(2 * i);
    attempted.emplace_back(idx, idx);  // Right; the other is not attempted.
    correct.push_back(static_cast<double>(i) + 1.0);
  }
  attempted.emplace_back(1, 3);  // Wrong.
  planted.SkyInBoth();
  const int sky = static_cast<int>(planted.Pair().first.pixels_px.size()) - 1;
  attempted.emplace_back(sky, sky);  // Never right.
  const SettingResult result = JudgedMatches(planted, attempted);
  EXPECT_EQ(MetricOf(result, "correct_matches").values, correct);
  for (size_t i = 0; i < kTolerancesM.size(); ++i) {
    EXPECT_DOUBLE_EQ(MetricOf(result, "matching_score").values[i], correct[i] / 25.0);
    EXPECT_DOUBLE_EQ(MetricOf(result, "precision").values[i], correct[i] / 14.0);
    EXPECT_DOUBLE_EQ(MetricOf(result, "one_minus_precision").values[i], 1.0 - correct[i] / 14.0);
    EXPECT_DOUBLE_EQ(MetricOf(result, "recall").values[i], 0.5);
    EXPECT_DOUBLE_EQ(MetricOf(result, "score_over_repeatability").values[i], 0.5);
  }
  EXPECT_DOUBLE_EQ(MetricOf(result, "survival_rate").values[0], 14.0 / 25.0);
}

TEST(Judge, AnglesFollowTheDistances) {
  JudgeSetting setting;
  setting.tolerances.angles_rad = {0.001, 0.01};
  PlantedPair planted;
  planted.Both(0.05);  // 5 mrad from 10 m.
  planted.Both(0.005);
  const DetectionJudgement judged = Judged(planted, setting);
  ASSERT_EQ(judged.matches.size(), 14U);
  EXPECT_EQ(judged.matches[11], 2);
  EXPECT_EQ(judged.matches[12], 1);
  EXPECT_EQ(judged.matches[13], 2);
}

TEST(Judge, BestTakesTheStrongestOfEachView) {
  JudgeSetting setting;
  setting.best = {3};
  PlantedPair planted;
  planted.Both(0.0);
  planted.OnlyFirst();
  planted.Both(0.0);
  planted.Both(0.0);  // Fourth of the first view.
  const SettingResult result = Judged(planted, setting).result;
  EXPECT_EQ(MetricOf(result, "matches_best_3").values[0], 2.0);
  EXPECT_DOUBLE_EQ(MetricOf(result, "repeatability_best_3").values[0], 2.0 / 3.0);
}

TEST(Judge, DegenerateCasesAreFlaggedNotScored) {
  PlantedPair planted;
  planted.Both(0.0);
  planted.OnlySecond();
  const DetectionJudgement judged = Judged(planted);
  EXPECT_TRUE(judged.result.is_degenerate);
  EXPECT_EQ(MetricOf(judged.result, "matches").values[0], 1.0);
  EXPECT_TRUE(std::isnan(MetricOf(judged.result, "repeatability").values[0]));
  const SettingResult matched = JudgedMatches(planted, {{0, 0}});
  EXPECT_TRUE(matched.is_degenerate);
  EXPECT_EQ(MetricOf(matched, "correct_matches").values[0], 1.0);
  EXPECT_TRUE(std::isnan(MetricOf(matched, "matching_score").values[0]));
  EXPECT_TRUE(Judged(PlantedPair()).result.is_degenerate);
}

TEST(Judge, OverlappingDetectionsCountOnceWithoutRedundancy) {
  // Ten detections of one place in each view, one of another in the second.
  PlantedPair planted;
  JudgedPair pair;
  for (int i = 0; i < 10; ++i) {
    planted.Both(0.0);
  }
  pair = planted.Pair();
  for (int i = 0; i < 10; ++i) {
    pair.first.pixels_px[i] = pair.second.pixels_px[i] = Vec2d(i < 9 ? 300.0 : 700.0, 300.0);
  }
  // Of the nine at one place the world tells eight apart.
  for (int i = 0; i < 8; ++i) {
    pair.points.second_m[i] = Vec3d(1000.0 + i, 0.0, 0.0);
  }
  const SettingResult result = JudgeDetections(pair, {}, BootstrapDraws(1)).result;
  EXPECT_DOUBLE_EQ(MetricOf(result, "repeatability").values[0], 0.2);
  EXPECT_NEAR(MetricOf(result, "nonredundant_repeatability").values[0], 1.0, 1e-3);
}

}  // namespace
}  // namespace pfseq
