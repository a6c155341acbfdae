// SPDX-License-Identifier: Apache-2.0
// A report of benchmarks: a page, tables and figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

struct ReportOptions {
  /// Folders that `pfseq bench` wrote.
  std::vector<std::filesystem::path> results;
  /// Where their sequences lie, for pictures: one for all, or one each. Empty: where the results
  /// say.
  std::vector<std::filesystem::path> sequences;
  std::filesystem::path out;
  bool has_pictures = true;
  /// The command that the page and the tables tell they were made by.
  std::string command;
  int num_threads = 1;
  bool quiet = false;
};

/// What was written, and what could not be.
struct ReportSummary {
  std::filesystem::path page;
  size_t num_tables = 0;
  /// False: gnuplot is missing; the scripts alone were written.
  bool has_figures = false;
  std::vector<std::string> remarks;
};

/// Writes into `out` (made when missing):
///
///   report.html        one page that needs nothing else
///   tables/NAME.csv, NAME.tex   in the layout of the report of 2014; all.tex holds them all
///   figures/NAME.gp, NAME.svg, NAME.png   their curves, drawn by gnuplot
///
/// InputError when results are missing or damaged, SystemError when nothing can be written.
ReportSummary WriteReport(const ReportOptions& options);

}  // namespace pfseq
