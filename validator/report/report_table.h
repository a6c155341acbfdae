// SPDX-License-Identifier: Apache-2.0
// Tables in the layout of the report of 2014: a row for each tolerance, a column for each setting.
#pragma once

#include "validator/report/result_set.h"

#include <optional>
#include <string>
#include <vector>

namespace pfseq {

/// A metric as people read it.
struct MetricName {
  std::string id;
  std::string title;
  bool is_share = false;
};

/// The four metrics of the report: matches, repeatability, correct_matches, matching_score.
const std::vector<MetricName>& TableMetrics();

struct ReportTable {
  /// Of its files: "matching_score_pair_24".
  std::string name;
  std::string caption;
  MetricName metric;
  std::vector<std::string> settings;
  std::vector<double> tolerances_m;
  /// [tolerance][setting]: counts as they are, shares with three decimals; empty where there is
  /// none.
  std::vector<std::vector<std::string>> cells;
  /// For each tolerance the columns of the best and second best value.
  std::vector<std::optional<size_t>> best;
  std::vector<std::optional<size_t>> second;
};

/// The tables of all cases and metrics that the results have, with the settings that Highlights
/// chooses.
std::vector<ReportTable> MakeTables(const ResultSet& results);

/// tolerance_m and a column for each setting.
std::string CsvText(const ReportTable& table);
/// A table* of booktabs with rotated headings: best bold, second best underlined. `origin` is the
/// command it was made by.
std::string TexText(const ReportTable& table, const std::string& origin);
/// A document that holds all of them, to be compiled beside them.
std::string TexDocument(const std::vector<ReportTable>& tables);

}  // namespace pfseq
