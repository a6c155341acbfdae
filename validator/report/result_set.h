// SPDX-License-Identifier: Apache-2.0
// The results of one or more benchmarks, side by side.
#pragma once

#include "validator/benchmark/view_source.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

/// A folder that `pfseq bench` wrote, and how it was made.
struct ResultsSource {
  /// The folder's name.
  std::string name;
  std::string sequence;
  std::string variant;
  std::string judge;
  uint64_t seed = 0;
  std::string program_version;
  std::string opencv_version;
  /// From run.json; empty where it is missing.
  std::string command;
  std::string finished;
  double wall_s = 0.0;
  /// Folder of the sequence; empty where it is not known or no longer there.
  std::filesystem::path sequence_folder;
};

/// A pair of views of one of the benchmarks.
struct ReportCase {
  size_t source_idx = 0;
  std::string lens;
  /// As in the results: "24", "front:0-front:1".
  std::string pair;
  ViewName first;
  ViewName second;
  /// For people: with lens and benchmark where there are several.
  std::string label;
};

/// A detector, or a triplet of detector, descriptor and matcher, by the words of its name.
struct ReportSetting {
  std::string name;
  std::string detector;
  bool is_polar = false;
  std::string descriptor;
  std::string matcher;
};

/// A metric of all settings on all cases.
struct MetricTable {
  /// Values of a setting on a case: one for each tolerance, or a single one.
  size_t num_values = 0;
  /// [setting][case][value]; NaN where there is none.
  std::vector<float> values;
};

/// All detectors, or all triplets.
struct SettingGroup {
  std::vector<ReportSetting> settings;
  size_t num_cases = 0;
  std::map<std::string, MetricTable, std::less<>> metrics;

  /// NaN where there is none. Metrics without tolerance have the same value at each.
  double Value(std::string_view metric,
               size_t setting_idx,
               size_t case_idx,
               size_t tolerance_idx) const;
  bool Has(std::string_view metric) const { return metrics.find(metric) != metrics.end(); }
  std::optional<size_t> Find(std::string_view name) const;
};

struct ResultSet {
  std::vector<ResultsSource> sources;
  std::vector<ReportCase> cases;
  std::vector<double> tolerances_m;
  /// Behind the distances; none unless all benchmarks have the same.
  std::vector<double> tolerances_deg;
  /// With `cpu_s`, the CPU time of the stages that a setting shares with its family, where
  /// times.csv has them.
  SettingGroup detectors;
  SettingGroup triplets;

  size_t NumTolerances() const { return tolerances_m.size() + tolerances_deg.size(); }
  /// Of a tolerance in metres.
  std::optional<size_t> ToleranceIdx(double tolerance_m) const;
};

/// Authors and licences of what the scene of a sequence is made from, which its sequence.yaml tells
/// in a comment at its end; empty where there are none, or no such file.
std::string SequenceCredits(const std::filesystem::path& sequence_folder);

/// Reads folders that `pfseq bench` wrote. InputError when results.json of one is missing, damaged
/// or has other distances.
ResultSet ReadResults(const std::vector<std::filesystem::path>& folders);

}  // namespace pfseq
