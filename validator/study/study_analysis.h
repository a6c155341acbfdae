// SPDX-License-Identifier: Apache-2.0
// What a study's results say: how metrics change with a factor, and which settings overtake others.
#pragma once

#include "validator/report/result_set.h"
#include "validator/study/statistics.h"
#include "validator/study/study_plan.h"

#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

/// The pairs of views that differ in one factor alone: each sample (a pair in a repetition, and
/// with all combinations the other factors' levels) has a case of the results at every level.
struct FactorTable {
  /// [level][sample]: index of a case.
  std::vector<std::vector<size_t>> cases;

  size_t NumSamples() const { return cases.empty() ? 0 : cases.front().size(); }
};

/// The results' sources are those of the variants, in their order.
FactorTable TableOfFactor(const StudySpec& study,
                          const std::vector<StudyVariant>& variants,
                          const ResultSet& results,
                          size_t factor_idx);

/// [level][sample] of a setting; NaN where there is no value.
std::vector<std::vector<double>> ValuesOf(const FactorTable& table,
                                          const SettingGroup& group,
                                          std::string_view metric,
                                          size_t setting_idx,
                                          size_t tolerance_idx);

/// The mean over all settings with a value at every level of a sample.
std::vector<std::vector<double>> MeanValuesOf(const FactorTable& table,
                                              const SettingGroup& group,
                                              std::string_view metric,
                                              size_t tolerance_idx);

/// What a factor does to a metric.
struct Effect {
  /// At each level, and its change against the base (paired by samples; 0 at the base itself).
  std::vector<Interval> levels;
  std::vector<Interval> changes;
  VarianceShares shares;

  /// Greatest minus least mean of the levels; NaN without any.
  double Range() const;
};

Effect EffectOf(const std::vector<std::vector<double>>& values, size_t base_idx);

/// Two settings over the levels of a factor.
struct Comparison {
  bool is_triplets = true;
  size_t a_idx = 0;
  size_t b_idx = 0;
  /// Of a - b, paired by samples, at each level.
  std::vector<Interval> differences;
  /// What may be said, one sentence.
  std::string text;
};

/// Triplets that are compared with each other where a study names none.
inline constexpr size_t kMaxCompared = 4;

/// The study's `compare`, or else all pairs of the best triplet (at the base) of each detector and
/// descriptor, at most kMaxCompared of them; by matching score, detectors by repeatability.
std::vector<Comparison> CompareSettings(const StudySpec& study,
                                        const StudyFactor& factor,
                                        const FactorTable& table,
                                        const ResultSet& results);

/// "FREAK 44.0" and "SIFT" with "SIFT nopol 0.04 5.0 1.6 points, BruteForce": what tells two
/// settings apart, and what they share (empty when that is nothing).
struct ShortNames {
  std::string a;
  std::string b;
  std::string shared;
};
ShortNames ShortNamesOf(const std::string& a, const std::string& b);

/// What a factor does, one sentence of the verdict.
std::string EffectText(const StudyFactor& factor, const Effect& effect, const std::string& metric);

/// A sentence on differences a - b over levels: who is ahead where, by intervals that leave out 0,
/// and where the means cross.
std::string ComparisonText(const StudyFactor& factor,
                           const ShortNames& names,
                           const std::vector<Interval>& differences);

}  // namespace pfseq
