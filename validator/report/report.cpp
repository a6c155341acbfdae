// SPDX-License-Identifier: Apache-2.0
#include "validator/report/report.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "validator/grid/setting.h"
#include "validator/report/figures.h"
#include "validator/report/page_data.h"

#include <algorithm>

namespace pfseq {
namespace {

constexpr size_t kNumShown = 2;

void LocateSequences(const ReportOptions& options, ResultSet& results) {
  if (options.sequences.empty()) {
    return;
  }
  if (options.sequences.size() != 1 && options.sequences.size() != results.sources.size()) {
    throw InputError("--sequence: expected one for all or one for each of {} results, got {}",
                     results.sources.size(),
                     options.sequences.size());
  }
  for (size_t i = 0; i < results.sources.size(); ++i) {
    const std::filesystem::path& folder = options.sequences[options.sequences.size() == 1 ? 0 : i];
    if (!std::filesystem::exists(folder)) {
      throw InputError("--sequence {}: no such folder", folder.string());
    }
    results.sources[i].sequence_folder = folder;
  }
}

bool CanBeMeasured(const std::string& name) {
  try {
    return ParseName(name).matcher.has_value();
  } catch (const InputError&) {
    return false;  // Features from elsewhere.
  }
}

/// The best over all, and the best with another detector.
std::vector<std::string> ShownSettings(const ResultSet& results) {
  std::vector<std::string> shown, detectors;
  const std::optional<size_t> tolerance = results.ToleranceIdx(kVerdictToleranceM);
  if (!tolerance) {
    return shown;
  }
  std::vector<size_t> cases;
  for (size_t i = 0; i < results.cases.size(); ++i) {
    cases.push_back(i);
  }
  Measure measure = {"", "matching_score", "correct_matches", false, false};
  std::vector<Ranked> best = Rank(results.triplets, measure, cases, *tolerance);
  if (best.empty()) {
    best = Rank(results.triplets, measure, cases, *tolerance, nullptr, kFewMatches);
  }
  for (const Ranked& ranked : best) {
    const ReportSetting& setting = results.triplets.settings[ranked.setting_idx];
    if (shown.size() < kNumShown && CanBeMeasured(setting.name) &&
        std::find(detectors.begin(), detectors.end(), setting.detector) == detectors.end()) {
      shown.push_back(setting.name);
      detectors.push_back(setting.detector);
    }
  }
  for (const ReportSetting& setting : results.triplets.settings) {
    if (shown.empty() && CanBeMeasured(setting.name)) {
      shown.push_back(setting.name);  // Nothing has enough matches: any is better than none.
    }
  }
  return shown;
}

}  // namespace

ReportSummary WriteReport(const ReportOptions& options) {
  ResultSet results = ReadResults(options.results);
  LocateSequences(options, results);
  const Reference2014 reference;
  PageContent content;
  content.results = &results;
  content.reference = &reference;
  content.verdict = Verdict(results);
  content.conclusions = JudgeConclusions(results, reference);
  content.tables = MakeTables(results);
  content.command = options.command;
  if (options.has_pictures) {
    content.pictures =
        MakeSequencePictures(results, ShownSettings(results), options.num_threads, options.quiet);
  } else {
    content.pictures.remarks.push_back("Pictures were left out (--no-pictures).");
  }
  content.has_figures = WriteTables(content.tables, options.out, options.command);
  const std::filesystem::path page = options.out / "report.html";
  WriteFileAtomically(page, PageHtml(content));
  return {page, content.tables.size(), content.has_figures, content.pictures.remarks};
}

}  // namespace pfseq
