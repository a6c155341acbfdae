// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/report/report.h"
#include "validator/study/study_plan.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

struct StudyReportOptions {
  /// Of the variants, in their order: each holds bench and sequence.
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;
  /// The command that the page and the tables tell they were made by.
  std::string command;
};

/// Writes into `out` (made when missing):
///
///   study.html          one page that needs nothing else
///   tables/effects.csv  factor,level,metric,setup,tolerance_m,samples,mean,low,high,change,
///                       change_low,change_high,eta_squared: every effect
///   tables/NAME.csv, NAME.tex   a metric over a factor's levels, for the best settings; all.tex
///   figures/NAME.gp, NAME.svg, NAME.png
///
/// InputError when results are missing or damaged, SystemError when nothing can be written.
ReportSummary WriteStudyReport(const StudySpec& study,
                               const std::vector<StudyVariant>& variants,
                               const StudyReportOptions& options);

}  // namespace pfseq
