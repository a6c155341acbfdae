// SPDX-License-Identifier: Apache-2.0
#include "validator/report/ranking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace pfseq {

const std::vector<Measure>& VerdictMeasures() {
  static const std::vector<Measure> measures = {
      {"Repeatability", "repeatability", "matches", true, false},
      {"Matching score", "matching_score", "correct_matches", false, false},
      {"Spread", "spread_cells", "correct_matches", false, false},
      {"Speed", "cpu_s", "correct_matches", false, true}};
  return measures;
}

std::vector<Ranked> Rank(const SettingGroup& group,
                         const Measure& measure,
                         const std::vector<size_t>& cases,
                         size_t tolerance_idx,
                         const std::function<bool(const ReportSetting&)>& accepts,
                         double min_count) {
  std::vector<Ranked> ranked;
  if (cases.empty()) {
    return ranked;
  }
  for (size_t i = 0; i < group.settings.size(); ++i) {
    if (accepts && !accepts(group.settings[i])) {
      continue;
    }
    Ranked one{i, 0.0, std::numeric_limits<double>::infinity()};
    for (const size_t case_idx : cases) {
      one.value += group.Value(measure.metric, i, case_idx, tolerance_idx) /
                   static_cast<double>(cases.size());
      const double count = group.Value(measure.count, i, case_idx, tolerance_idx);
      one.count = std::isnan(count) ? 0.0 : std::min(one.count, count);
    }
    if (!std::isnan(one.value) && one.count >= min_count) {
      ranked.push_back(one);
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(), [&](const Ranked& a, const Ranked& b) {
    return measure.is_less_better ? a.value < b.value : a.value > b.value;
  });
  return ranked;
}

std::vector<VerdictLine> Verdict(const ResultSet& results) {
  std::vector<VerdictLine> lines;
  const std::optional<size_t> tolerance = results.ToleranceIdx(kVerdictToleranceM);
  if (!tolerance || results.cases.empty()) {
    return lines;
  }
  if (results.cases.size() > 1) {
    lines.push_back({"over all", std::vector<size_t>(results.cases.size()), {}});
    std::iota(lines[0].cases.begin(), lines[0].cases.end(), size_t{0});
  }
  for (size_t i = 0; i < results.cases.size(); ++i) {
    lines.push_back({results.cases[i].label, {i}, {}});
  }
  for (VerdictLine& line : lines) {
    for (const Measure& measure : VerdictMeasures()) {
      const SettingGroup& group = measure.is_of_detectors ? results.detectors : results.triplets;
      std::vector<Ranked> ranked = Rank(group, measure, line.cases, *tolerance);
      VerdictEntry entry{&measure, !ranked.empty(), std::nullopt, std::nullopt};
      if (ranked.empty()) {
        ranked = Rank(group, measure, line.cases, *tolerance, nullptr, kFewMatches);
      }
      if (!ranked.empty()) {
        entry.best = ranked[0];
      }
      if (ranked.size() > 1) {
        entry.second = ranked[1];
      }
      line.entries.push_back(entry);
    }
  }
  return lines;
}

std::vector<size_t> Highlights(const SettingGroup& group,
                               const std::string& count_metric,
                               const std::string& share_metric,
                               size_t num_tolerances) {
  std::set<size_t> chosen;
  for (size_t case_idx = 0; case_idx < group.num_cases; ++case_idx) {
    std::vector<bool> has_enough;
    for (size_t i = 0; i < group.settings.size(); ++i) {
      has_enough.push_back(group.Value(count_metric, i, case_idx, num_tolerances - 1) >=
                           kEnoughMatches);
    }
    for (const std::string& metric : {count_metric, share_metric}) {
      for (size_t t = 0; t < num_tolerances; ++t) {
        std::optional<size_t> best;
        for (size_t i = 0; i < group.settings.size(); ++i) {
          const double value = group.Value(metric, i, case_idx, t);
          if (has_enough[i] && !std::isnan(value) &&
              (!best || value > group.Value(metric, *best, case_idx, t))) {
            best = i;
          }
        }
        if (best) {
          chosen.insert(*best);
        }
      }
    }
  }
  return {chosen.begin(), chosen.end()};
}

}  // namespace pfseq
