// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/judge.h"

#include "validator/metrics/redundancy.h"
#include "validator/metrics/spread.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
using CellCounts = std::array<int, kNumBootstrapCells>;

double Share(double part, double whole) { return whole > 0.0 ? part / whole : kNone; }

/// Metrics under construction: a value of each name for each tolerance.
class MetricTable {
 public:
  void Add(const std::string& name, double value) { Of(name).values.push_back(value); }
  void Add(const std::string& name, double value, const Interval& interval) {
    Add(name, value);
    Of(name).low.push_back(interval.low);
    Of(name).high.push_back(interval.high);
  }
  void Add(const SpreadScores& scores) {
    Add("spread_cells", scores.cells);
    Add("spread_deviation", scores.deviation);
    Add("spread_distance", scores.distance);
    Add("spread_coverage", scores.coverage);
  }

  std::vector<Metric>& Metrics() { return metrics_; }

 private:
  Metric& Of(const std::string& name) {
    for (Metric& metric : metrics_) {
      if (metric.name == name) {
        return metric;
      }
    }
    metrics_.push_back({name, {}, {}, {}});
    return metrics_.back();
  }

  std::vector<Metric> metrics_;
};

/// The one-to-one pairs of detections by distance and by angle, each ascending.
struct MatchPairs {
  std::vector<PointPair> by_distance;
  std::vector<PointPair> by_angle;

  const std::vector<PointPair>& Of(const Tolerances& tolerances, size_t i) const {
    return tolerances.IsAngle(i) ? by_angle : by_distance;
  }
};

MatchPairs OneToOne(const PointsOfPair& points, const Tolerances& tolerances) {
  MatchPairs pairs;
  pairs.by_distance = OneToOneWithinDistance(points, kTolerancesM.back());
  if (!tolerances.angles_rad.empty()) {
    pairs.by_angle = OneToOneWithinAngle(points, tolerances.angles_rad.back());
  }
  return pairs;
}

/// How many of the ascending pairs are below a limit.
size_t NumBelow(const std::vector<PointPair>& pairs, double limit) {
  return static_cast<size_t>(std::lower_bound(pairs.begin(),
                                              pairs.end(),
                                              limit,
                                              [](const PointPair& pair, double value) {
                                                return pair.separation < value;
                                              }) -
                             pairs.begin());
}

/// The view with fewer detections counts the whole of a share.
bool IsFirstSmaller(const JudgedPair& pair) {
  return pair.first.pixels_px.size() <= pair.second.pixels_px.size();
}

CellCounts CellsOfDetections(const JudgedPair& pair) {
  CellCounts counts = {};
  for (const Vec2d& point : (IsFirstSmaller(pair) ? pair.first : pair.second).in_disc) {
    ++counts[BootstrapCell(point)];
  }
  return counts;
}

/// The cell of a match in the view that counts the whole.
int CellOfMatch(const JudgedPair& pair, const PointPair& match) {
  return BootstrapCell(IsFirstSmaller(pair) ? pair.first.in_disc[match.first_idx]
                                            : pair.second.in_disc[match.second_idx]);
}

Support SupportOf(const JudgedView& view, int idx) {
  return {view.pixels_px[idx], view.sizes_px[idx]};
}

double NumNonRedundant(const JudgedView& view) {
  NonRedundantCount count(view.width_px, view.height_px);
  for (size_t i = 0; i < view.pixels_px.size(); ++i) {
    count.Add(SupportOf(view, static_cast<int>(i)));
  }
  return count.Count();
}

/// The pair with only the strongest points left.
PointsOfPair BestPoints(const JudgedPair& pair, int num_best) {
  const auto best = [&](const JudgedView& view, const ScenePoints& points_m) {
    std::vector<int> order(points_m.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return view.responses[a] > view.responses[b];
    });
    order.resize(std::min(order.size(), static_cast<size_t>(num_best)));
    ScenePoints chosen;
    for (const int i : order) {
      chosen.push_back(points_m[i]);
    }
    return chosen;
  };
  return {best(pair.first, pair.points.first_m),
          best(pair.second, pair.points.second_m),
          pair.points.first_centre_m,
          pair.points.second_centre_m};
}

/// Goes through ascending pairs, tolerance by tolerance: `add` for each new pair, `settle` with the
/// number of pairs below each tolerance. Starts afresh, by `reset`, where angles begin.
template <typename Pairs, typename Reset, typename Add, typename Settle>
void ForEachTolerance(const Tolerances& tolerances,
                      const Pairs& pairs,
                      const Reset& reset,
                      const Add& add,
                      const Settle& settle) {
  size_t done = 0;
  for (size_t i = 0; i < tolerances.Size(); ++i) {
    if (i == 0 || i == kTolerancesM.size()) {
      done = 0;
      reset();
    }
    const std::vector<PointPair>& of_kind = pairs.Of(tolerances, i);
    const size_t count = NumBelow(of_kind, tolerances.Limit(i));
    for (; done < count; ++done) {
      add(of_kind[done]);
    }
    settle(count);
  }
}

double NumDetections(const JudgedPair& pair) {
  return static_cast<double>(std::min(pair.first.pixels_px.size(), pair.second.pixels_px.size()));
}

/// Shares of degenerate cases have no value.
void BlankShares(std::vector<Metric>& metrics) {
  for (Metric& metric : metrics) {
    const bool is_count = metric.name.find("matches") == 0 || metric.name == "correct_matches" ||
                          metric.name.find("detections") == 0 || metric.name == "attempted";
    if (!is_count) {
      std::fill(metric.values.begin(), metric.values.end(), kNone);
      std::fill(metric.low.begin(), metric.low.end(), kNone);
      std::fill(metric.high.begin(), metric.high.end(), kNone);
    }
  }
}

void AddBest(const JudgedPair& pair, const JudgeSetting& setting, MetricTable& table) {
  for (const int num_best : setting.best) {
    const PointsOfPair best = BestPoints(pair, num_best);
    const MatchPairs pairs = OneToOne(best, setting.tolerances);
    const double whole = static_cast<double>(std::min(best.first_m.size(), best.second_m.size()));
    for (size_t i = 0; i < setting.tolerances.Size(); ++i) {
      const auto count = static_cast<double>(
          NumBelow(pairs.Of(setting.tolerances, i), setting.tolerances.Limit(i)));
      table.Add(fmt::format("matches_best_{}", num_best), count);
      table.Add(fmt::format("repeatability_best_{}", num_best), Share(count, whole));
    }
  }
}

}  // namespace

DetectionJudgement JudgeDetections(const JudgedPair& pair,
                                   const JudgeSetting& setting,
                                   const BootstrapDraws& draws) {
  DetectionJudgement judgement;
  judgement.result.is_degenerate = NumDetections(pair) < 2.0;
  const MatchPairs pairs = OneToOne(pair.points, setting.tolerances);
  const CellCounts whole = CellsOfDetections(pair);
  const double first_volume = NumNonRedundant(pair.first);
  const double second_volume = NumNonRedundant(pair.second);
  const bool volume_in_first = first_volume <= second_volume;
  const JudgedView& volume_view = volume_in_first ? pair.first : pair.second;

  MetricTable table;
  CellCounts part = {};
  SpreadCounter spread;
  NonRedundantCount volume(volume_view.width_px, volume_view.height_px);
  ForEachTolerance(
      setting.tolerances,
      pairs,
      [&] {
        part = {};
        spread = SpreadCounter();
        volume = NonRedundantCount(volume_view.width_px, volume_view.height_px);
      },
      [&](const PointPair& match) {
        ++part[CellOfMatch(pair, match)];
        spread.Add(pair.first.in_disc[match.first_idx]);
        volume.Add(SupportOf(volume_view, volume_in_first ? match.first_idx : match.second_idx));
      },
      [&](size_t count) {
        const auto matches = static_cast<double>(count);
        judgement.matches.push_back(static_cast<int>(count));
        table.Add("matches", matches);
        table.Add(
            "repeatability", Share(matches, NumDetections(pair)), draws.IntervalOf(part, whole));
        table.Add("repeatability_reference",
                  Share(matches, static_cast<double>(pair.first.pixels_px.size())));
        table.Add("nonredundant_repeatability",
                  Share(volume.Count(), std::min(first_volume, second_volume)));
        table.Add(spread.Scores());
      });
  AddBest(pair, setting, table);
  table.Add("detections_first", static_cast<double>(pair.first.pixels_px.size()));
  table.Add("detections_second", static_cast<double>(pair.second.pixels_px.size()));
  table.Add("uniformity",
            Uniformity(pair.first.pixels_px, pair.first.width_px, pair.first.height_px));
  judgement.result.metrics = std::move(table.Metrics());
  if (judgement.result.is_degenerate) {
    BlankShares(judgement.result.metrics);
  }
  return judgement;
}

SettingResult JudgeMatches(const JudgedPair& pair,
                           const std::vector<std::pair<int, int>>& attempted,
                           const DetectionJudgement& detections,
                           const JudgeSetting& setting,
                           const BootstrapDraws& draws) {
  MatchPairs pairs;
  for (const auto& [first_idx, second_idx] : attempted) {
    pairs.by_distance.push_back(
        {first_idx, second_idx, DistanceM(pair.points, first_idx, second_idx)});
    if (!setting.tolerances.angles_rad.empty()) {
      pairs.by_angle.push_back(
          {first_idx, second_idx, AngleRad(pair.points, first_idx, second_idx)});
    }
  }
  for (std::vector<PointPair>* kind : {&pairs.by_distance, &pairs.by_angle}) {
    std::stable_sort(kind->begin(), kind->end(), [](const PointPair& a, const PointPair& b) {
      return a.separation < b.separation;
    });
  }
  const CellCounts whole = CellsOfDetections(pair);
  const auto num_attempted = static_cast<double>(attempted.size());
  MetricTable table;
  CellCounts part = {};
  SpreadCounter spread;
  size_t tolerance = 0;
  ForEachTolerance(
      setting.tolerances,
      pairs,
      [&] {
        part = {};
        spread = SpreadCounter();
      },
      [&](const PointPair& match) {
        ++part[CellOfMatch(pair, match)];
        spread.Add(pair.first.in_disc[match.first_idx]);
      },
      [&](size_t count) {
        const auto correct = static_cast<double>(count);
        const double recall = Share(correct, detections.matches[tolerance++]);
        const double precision = Share(correct, num_attempted);
        table.Add("correct_matches", correct);
        table.Add(
            "matching_score", Share(correct, NumDetections(pair)), draws.IntervalOf(part, whole));
        table.Add("precision", precision);
        table.Add("one_minus_precision", 1.0 - precision);
        table.Add("recall", recall);
        table.Add("score_over_repeatability", recall);
        table.Add(spread.Scores());
      });
  table.Add("attempted", num_attempted);
  table.Add("survival_rate",
            Share(num_attempted, static_cast<double>(pair.first.pixels_px.size())));
  SettingResult result;
  result.is_degenerate = detections.result.is_degenerate;
  result.metrics = std::move(table.Metrics());
  if (result.is_degenerate) {
    BlankShares(result.metrics);
  }
  return result;
}

}  // namespace pfseq
