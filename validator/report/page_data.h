// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/report/conclusions.h"
#include "validator/report/ranking.h"
#include "validator/report/report_table.h"
#include "validator/report/result_set.h"
#include "validator/report/sequence_pictures.h"

#include <string>
#include <vector>

namespace pfseq {

/// All that the page shows.
struct PageContent {
  const ResultSet* results = nullptr;
  const Reference2014* reference = nullptr;
  std::vector<VerdictLine> verdict;
  std::vector<Conclusion> conclusions;
  std::vector<ReportTable> tables;
  SequencePictures pictures;
  /// The command that makes the report.
  std::string command;
  bool has_figures = false;
};

/// The page's data as JSON, safe within a script element. Metrics are base64 of little-endian
/// float32, [setting][case][value], NaN where there is none.
std::string PageDataJson(const PageContent& content);

/// The whole page, self-contained: page/report.html with styles, scripts and data filled in.
std::string PageHtml(const PageContent& content);

}  // namespace pfseq
