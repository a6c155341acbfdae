// SPDX-License-Identifier: Apache-2.0
// Tables in the layout of the report of 2014: a column for each setting, a row for each tolerance
// (or for each level of a study's factor).
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
  /// What the rows are, for people and as the head of a column.
  std::string row_title = "Distance tolerance (m)";
  std::string row_id = "tolerance_m";
  std::vector<std::string> rows;
  /// Of a drawing over the rows: the axis, and what a row's number is multiplied with; without
  /// numbers the rows stand beside each other.
  std::string axis_title = "Distance tolerance (cm)";
  double axis_scale = 100.0;
  bool has_numbers = true;
  /// [row][setting]: counts as they are, shares with three decimals; empty where there is none.
  std::vector<std::vector<std::string>> cells;
  /// 95 % confidence limits of the cells, in the same form; none in the report's tables.
  std::vector<std::vector<std::string>> low;
  std::vector<std::vector<std::string>> high;
  /// For each row the columns of the best and second best value.
  std::vector<std::optional<size_t>> best;
  std::vector<std::optional<size_t>> second;

  bool HasIntervals() const { return !low.empty(); }
  /// Appends a row; limits may be empty. Marks the best.
  void AddRow(std::string row,
              const std::vector<double>& values,
              const std::vector<double>& low_values = {},
              const std::vector<double>& high_values = {});
};

/// Of a file: small letters, digits and underscores.
std::string TableFileName(const std::string& text);

/// The tables of all cases and metrics that the results have, with the settings that Highlights
/// chooses.
std::vector<ReportTable> MakeTables(const ResultSet& results);

/// The row and a column for each setting; intervals take two more, "SETTING low" and "... high".
std::string CsvText(const ReportTable& table);
/// A table* of booktabs with rotated headings: best bold, second best underlined, half the interval
/// behind -+. `origin` is the
/// command it was made by.
std::string TexText(const ReportTable& table, const std::string& origin);
/// A document that holds all of them, to be compiled beside them.
std::string TexDocument(const std::vector<ReportTable>& tables);

}  // namespace pfseq
