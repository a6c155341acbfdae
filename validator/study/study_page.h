// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/report/report_table.h"
#include "validator/study/study_analysis.h"
#include "validator/study/study_pictures.h"

#include <string>
#include <vector>

namespace pfseq {

/// What is told of a factor besides the effects on each setting.
struct FactorFindings {
  FactorTable table;
  /// Of the mean over all triplets' matching scores, all detectors' repeatabilities and their
  /// numbers of detections in the first view.
  Effect triplets;
  Effect detectors;
  Effect detections;
  std::vector<Comparison> comparisons;
};

/// All that the page shows.
struct StudyContent {
  const StudySpec* study = nullptr;
  const std::vector<StudyVariant>* variants = nullptr;
  const ResultSet* results = nullptr;
  /// Of the study's factors, in their order.
  std::vector<FactorFindings> factors;
  /// Factors by the variance that their levels explain of the triplets' matching score.
  std::vector<size_t> ranking;
  std::vector<ReportTable> tables;
  std::vector<StudyPicture> pictures;
  std::vector<std::string> remarks;
  std::string command;
  bool has_figures = false;
};

/// The metrics that studies show, triplets' and detectors'.
const std::vector<std::string>& StudyMetrics(bool is_triplets);

/// The whole page, self-contained. Effects are base64 of little-endian float32,
/// [setting][level][tolerance], NaN where there is none.
std::string StudyPageHtml(const StudyContent& content);

}  // namespace pfseq
