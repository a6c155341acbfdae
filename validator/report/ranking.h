// SPDX-License-Identifier: Apache-2.0
// Which settings are best, by which measure.
#pragma once

#include "validator/report/result_set.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pfseq {

/// The tolerance at which the report of 2014 gives its expectations.
inline constexpr double kVerdictToleranceM = 0.04;
/// Fewer matches than this within the tolerance are too few to calibrate with (the report, section
/// on triplets): such a setting is not called best, however high its share.
inline constexpr double kEnoughMatches = 100.0;
/// Where none has enough (small images), the best with at least as many as these is told of, with
/// its count; fewer say nothing.
inline constexpr double kFewMatches = 10.0;

/// A measure of a group, and whether less of it is better.
struct Measure {
  std::string title;
  std::string metric;
  /// Metric of which a setting needs kEnoughMatches.
  std::string count;
  bool is_of_detectors = false;
  bool is_less_better = false;
};

/// What the verdict goes by: repeatability, matching score, spread, speed.
const std::vector<Measure>& VerdictMeasures();

struct Ranked {
  size_t setting_idx = 0;
  double value = 0.0;
  /// The least count of the cases.
  double count = 0.0;
};

/// Settings with a value and at least `min_count` matches on each of the cases, by their mean over
/// the cases, best first; equal ones in the order of the results. `accepts` selects settings.
std::vector<Ranked> Rank(const SettingGroup& group,
                         const Measure& measure,
                         const std::vector<size_t>& cases,
                         size_t tolerance_idx,
                         const std::function<bool(const ReportSetting&)>& accepts = nullptr,
                         double min_count = kEnoughMatches);

/// A line of the verdict: the best settings on one case, or over all.
struct VerdictEntry {
  const Measure* measure = nullptr;
  /// False: chosen among settings with kFewMatches, as none has kEnoughMatches.
  bool has_enough = true;
  std::optional<Ranked> best;
  std::optional<Ranked> second;
};
struct VerdictLine {
  std::string label;
  std::vector<size_t> cases;
  std::vector<VerdictEntry> entries;
};

/// Over all cases first, then each by itself. Empty when the tolerance was not measured.
std::vector<VerdictLine> Verdict(const ResultSet& results);

/// The report's choice of what to show: settings that have the most matches or the highest share at
/// least once, over all cases and distances; only those with kEnoughMatches at some distance of
/// that case. In the order of the results.
std::vector<size_t> Highlights(const SettingGroup& group,
                               const std::string& count_metric,
                               const std::string& share_metric,
                               size_t num_tolerances);

}  // namespace pfseq
