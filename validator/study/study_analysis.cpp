// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_analysis.h"

#include "renderer/core/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace pfseq {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Cases of each variant by lens and pair.
std::vector<std::map<std::string, size_t>> CasesByPair(const ResultSet& results) {
  std::vector<std::map<std::string, size_t>> cases(results.sources.size());
  for (size_t i = 0; i < results.cases.size(); ++i) {
    const ReportCase& one = results.cases[i];
    cases[one.source_idx].emplace(one.lens + "|" + one.pair, i);
  }
  return cases;
}

/// The best triplet at the base of each detector and descriptor, best first.
std::vector<size_t> BestOfKinds(const FactorTable& table,
                                const SettingGroup& group,
                                size_t base_idx,
                                size_t tolerance_idx) {
  std::map<std::string, std::pair<double, size_t>> best;
  for (size_t i = 0; i < group.settings.size(); ++i) {
    const double mean =
        MeanInterval(ValuesOf(table, group, "matching_score", i, tolerance_idx)[base_idx]).mean;
    const std::string kind = group.settings[i].detector + "|" + group.settings[i].descriptor;
    const auto [found, is_new] = best.emplace(kind, std::pair(mean, i));
    if (!is_new && !(found->second.first >= mean) && !std::isnan(mean)) {
      found->second = {mean, i};
    }
  }
  std::vector<std::pair<double, size_t>> ranked;
  for (const auto& [kind, entry] : best) {
    if (!std::isnan(entry.first)) {
      ranked.push_back(entry);
    }
  }
  std::sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  std::vector<size_t> settings;
  for (size_t i = 0; i < std::min(ranked.size(), kMaxCompared); ++i) {
    settings.push_back(ranked[i].second);
  }
  return settings;
}

}  // namespace

FactorTable TableOfFactor(const StudySpec& study,
                          const std::vector<StudyVariant>& variants,
                          const ResultSet& results,
                          size_t factor_idx) {
  PFSEQ_CHECK(variants.size() == results.sources.size());
  const std::vector<std::map<std::string, size_t>> cases = CasesByPair(results);
  const size_t num_levels = study.factors[factor_idx].levels.size();
  // By all that is the same: the other factors' levels, the repetition, the pair.
  std::map<std::pair<std::vector<size_t>, std::string>, std::vector<std::optional<size_t>>> samples;
  for (size_t v = 0; v < variants.size(); ++v) {
    std::vector<size_t> others = variants[v].level_idx;
    const size_t level = others[factor_idx];
    others[factor_idx] = 0;
    others.push_back(variants[v].repetition_idx);
    for (const auto& [pair, case_idx] : cases[v]) {
      std::vector<std::optional<size_t>>& sample = samples[{others, pair}];
      sample.resize(num_levels);
      sample[level] = case_idx;
    }
  }
  FactorTable table;
  table.cases.resize(num_levels);
  for (const auto& [key, sample] : samples) {
    if (std::all_of(
            sample.begin(), sample.end(), [](const auto& one) { return one.has_value(); })) {
      for (size_t level = 0; level < num_levels; ++level) {
        table.cases[level].push_back(*sample[level]);
      }
    }
  }
  return table;
}

std::vector<std::vector<double>> ValuesOf(const FactorTable& table,
                                          const SettingGroup& group,
                                          std::string_view metric,
                                          size_t setting_idx,
                                          size_t tolerance_idx) {
  std::vector<std::vector<double>> values;
  for (const std::vector<size_t>& cases : table.cases) {
    std::vector<double>& of_level = values.emplace_back();
    for (const size_t case_idx : cases) {
      of_level.push_back(group.Value(metric, setting_idx, case_idx, tolerance_idx));
    }
  }
  return values;
}

std::vector<std::vector<double>> MeanValuesOf(const FactorTable& table,
                                              const SettingGroup& group,
                                              std::string_view metric,
                                              size_t tolerance_idx) {
  const size_t num_levels = table.cases.size();
  std::vector<std::vector<double>> sums(num_levels, std::vector<double>(table.NumSamples(), 0.0));
  std::vector<double> counts(table.NumSamples(), 0.0);
  for (size_t i = 0; i < group.settings.size(); ++i) {
    const std::vector<std::vector<double>> values =
        ValuesOf(table, group, metric, i, tolerance_idx);
    for (size_t sample = 0; sample < counts.size(); ++sample) {
      if (std::none_of(values.begin(), values.end(), [&](const auto& of_level) {
            return std::isnan(of_level[sample]);
          })) {
        counts[sample] += 1.0;
        for (size_t level = 0; level < num_levels; ++level) {
          sums[level][sample] += values[level][sample];
        }
      }
    }
  }
  for (std::vector<double>& of_level : sums) {
    for (size_t sample = 0; sample < counts.size(); ++sample) {
      of_level[sample] = counts[sample] > 0.0 ? of_level[sample] / counts[sample] : kNone;
    }
  }
  return sums;
}

double Effect::Range() const {
  double least = kNone, most = kNone;
  for (const Interval& level : levels) {
    least = std::fmin(least, level.mean);
    most = std::fmax(most, level.mean);
  }
  return most - least;
}

Effect EffectOf(const std::vector<std::vector<double>>& values, size_t base_idx) {
  Effect effect;
  for (size_t level = 0; level < values.size(); ++level) {
    effect.levels.push_back(MeanInterval(values[level]));
    effect.changes.push_back(PairedInterval(values[level], values[base_idx]));
  }
  effect.shares = SharesOfVariance(values);
  return effect;
}

std::vector<Comparison> CompareSettings(const StudySpec& study,
                                        const StudyFactor& factor,
                                        const FactorTable& table,
                                        const ResultSet& results) {
  std::vector<Comparison> comparisons;
  const std::optional<size_t> tolerance = results.ToleranceIdx(study.tolerance_m);
  if (!tolerance || table.NumSamples() == 0) {
    return comparisons;
  }
  const auto add = [&](bool is_triplets, size_t a, size_t b) {
    const SettingGroup& group = is_triplets ? results.triplets : results.detectors;
    const char* metric = is_triplets ? "matching_score" : "repeatability";
    Comparison comparison{is_triplets, a, b, {}, ""};
    const std::vector<std::vector<double>> of_a = ValuesOf(table, group, metric, a, *tolerance);
    const std::vector<std::vector<double>> of_b = ValuesOf(table, group, metric, b, *tolerance);
    for (size_t level = 0; level < of_a.size(); ++level) {
      comparison.differences.push_back(PairedInterval(of_a[level], of_b[level]));
    }
    comparison.text = ComparisonText(factor,
                                     ShortNamesOf(group.settings[a].name, group.settings[b].name),
                                     comparison.differences);
    comparisons.push_back(std::move(comparison));
  };
  if (study.compare.empty()) {
    const std::vector<size_t> best =
        BestOfKinds(table, results.triplets, factor.base_idx, *tolerance);
    for (size_t i = 0; i < best.size(); ++i) {
      for (size_t j = i + 1; j < best.size(); ++j) {
        add(true, best[i], best[j]);
      }
    }
  }
  for (const std::array<std::string, 2>& names : study.compare) {
    for (const bool is_triplets : {true, false}) {
      const SettingGroup& group = is_triplets ? results.triplets : results.detectors;
      const std::optional<size_t> a = group.Find(names[0]);
      const std::optional<size_t> b = group.Find(names[1]);
      if (a && b) {
        add(is_triplets, *a, *b);
      }
    }
  }
  return comparisons;
}

}  // namespace pfseq
