// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_report.h"

#include "renderer/core/file.h"
#include "validator/report/figures.h"
#include "validator/study/study_page.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// A table shows as many settings as its figure has curves.
constexpr size_t kMaxColumns = kMaxCurves;

std::string NumberText(double value) {
  return std::isnan(value) ? "" : fmt::format("{:.6g}", value);
}

FactorFindings Findings(const StudySpec& study,
                        const std::vector<StudyVariant>& variants,
                        const ResultSet& results,
                        size_t factor_idx) {
  const StudyFactor& factor = study.factors[factor_idx];
  FactorFindings findings;
  findings.table = TableOfFactor(study, variants, results, factor_idx);
  const size_t tolerance = results.ToleranceIdx(study.tolerance_m).value_or(0);
  const auto effect = [&](const SettingGroup& group, const char* metric) {
    return EffectOf(MeanValuesOf(findings.table, group, metric, tolerance), factor.base_idx);
  };
  findings.triplets = effect(results.triplets, "matching_score");
  findings.detectors = effect(results.detectors, "repeatability");
  findings.detections = effect(results.detectors, "detections_first");
  findings.comparisons = CompareSettings(study, factor, findings.table, results);
  return findings;
}

/// The best settings at the base, in the results' order.
std::vector<size_t> BestSettings(const FactorTable& table,
                                 const SettingGroup& group,
                                 const std::string& metric,
                                 size_t base_idx,
                                 size_t tolerance_idx) {
  std::vector<std::pair<double, size_t>> ranked;
  for (size_t i = 0; i < group.settings.size(); ++i) {
    const double mean =
        MeanInterval(ValuesOf(table, group, metric, i, tolerance_idx)[base_idx]).mean;
    if (!std::isnan(mean)) {
      ranked.emplace_back(-mean, i);
    }
  }
  std::sort(ranked.begin(), ranked.end());
  ranked.resize(std::min(ranked.size(), kMaxColumns));
  std::vector<size_t> best;
  for (const auto& [value, i] : ranked) {
    best.push_back(i);
  }
  std::sort(best.begin(), best.end());
  return best;
}

std::vector<ReportTable> TablesOf(const StudySpec& study,
                                  const StudyContent& content,
                                  size_t factor_idx,
                                  size_t tolerance_idx) {
  const StudyFactor& factor = study.factors[factor_idx];
  const FactorTable& samples = content.factors[factor_idx].table;
  std::vector<ReportTable> tables;
  for (const MetricName& metric : TableMetrics()) {
    for (const SettingGroup* group : {&content.results->detectors, &content.results->triplets}) {
      // Each metric is of one of the groups.
      const bool is_of_group = (group == &content.results->triplets) ==
                               (metric.id == "matching_score" || metric.id == "correct_matches");
      if (!is_of_group || !group->Has(metric.id) || samples.NumSamples() == 0) {
        continue;
      }
      ReportTable table;
      table.name = TableFileName(metric.id + " over " + factor.name);
      table.caption = fmt::format("{} within {:g} cm over {}, mean of {} samples",
                                  metric.title,
                                  100.0 * study.tolerance_m,
                                  factor.title,
                                  samples.NumSamples());
      table.metric = metric;
      table.row_title = factor.title;
      table.row_id = factor.name;
      table.axis_title = factor.title;
      table.axis_scale = 1.0;
      table.has_numbers = factor.IsNumeric();
      const std::vector<size_t> best =
          BestSettings(samples, *group, metric.id, factor.base_idx, tolerance_idx);
      std::vector<Effect> effects;
      for (const size_t i : best) {
        table.settings.push_back(group->settings[i].name);
        effects.push_back(
            EffectOf(ValuesOf(samples, *group, metric.id, i, tolerance_idx), factor.base_idx));
      }
      for (size_t level = 0; level < factor.levels.size(); ++level) {
        std::vector<double> means, low, high;
        for (const Effect& effect : effects) {
          means.push_back(effect.levels[level].mean);
          low.push_back(effect.levels[level].low);
          high.push_back(effect.levels[level].high);
        }
        table.AddRow(factor.levels[level].label, means, low, high);
      }
      if (!best.empty()) {
        tables.push_back(std::move(table));
      }
    }
  }
  return tables;
}

/// A name as a column of a CSV file.
std::string Field(const std::string& text) {
  return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

std::string EffectsCsv(const StudySpec& study, const StudyContent& content) {
  std::string text =
      "factor,level,metric,setup,tolerance_m,samples,mean,low,high,change,change_low,change_high,"
      "eta_squared\n";
  const ResultSet& results = *content.results;
  for (size_t f = 0; f < study.factors.size(); ++f) {
    const StudyFactor& factor = study.factors[f];
    const FactorTable& table = content.factors[f].table;
    for (const bool is_triplets : {false, true}) {
      const SettingGroup& group = is_triplets ? results.triplets : results.detectors;
      for (const std::string& metric : StudyMetrics(is_triplets)) {
        if (!group.Has(metric) || table.NumSamples() == 0) {
          continue;
        }
        const bool has_tolerance = group.metrics.at(metric).num_values > 1;
        for (size_t i = 0; i < group.settings.size(); ++i) {
          for (size_t t = 0; t < (has_tolerance ? results.tolerances_m.size() : 1); ++t) {
            const Effect effect = EffectOf(ValuesOf(table, group, metric, i, t), factor.base_idx);
            for (size_t level = 0; level < factor.levels.size(); ++level) {
              const Interval& mean = effect.levels[level];
              const Interval& change = effect.changes[level];
              fmt::format_to(std::back_inserter(text),
                             "{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                             factor.name,
                             Field(factor.levels[level].label),
                             metric,
                             Field(group.settings[i].name),
                             has_tolerance ? fmt::format("{:g}", results.tolerances_m[t]) : "",
                             mean.count,
                             NumberText(mean.mean),
                             NumberText(mean.low),
                             NumberText(mean.high),
                             NumberText(change.mean),
                             NumberText(change.low),
                             NumberText(change.high),
                             NumberText(effect.shares.levels));
            }
          }
        }
      }
    }
  }
  return text;
}

std::vector<size_t> RankFactors(const std::vector<FactorFindings>& factors) {
  std::vector<size_t> ranking(factors.size());
  std::iota(ranking.begin(), ranking.end(), size_t{0});
  const auto explained = [&](size_t i) {
    const double share = factors[i].triplets.shares.levels;
    return std::isnan(share) ? -1.0 : share;
  };
  std::stable_sort(ranking.begin(), ranking.end(), [&](size_t a, size_t b) {
    return explained(a) > explained(b);
  });
  return ranking;
}

}  // namespace

ReportSummary WriteStudyReport(const StudySpec& study,
                               const std::vector<StudyVariant>& variants,
                               const StudyReportOptions& options) {
  std::vector<std::filesystem::path> benches;
  for (const std::filesystem::path& folder : options.folders) {
    benches.push_back(folder / "bench");
  }
  const ResultSet results = ReadResults(benches);
  StudyContent content;
  content.study = &study;
  content.variants = &variants;
  content.results = &results;
  content.command = options.command;
  const size_t tolerance = results.ToleranceIdx(study.tolerance_m).value_or(0);
  for (size_t i = 0; i < study.factors.size(); ++i) {
    content.factors.push_back(Findings(study, variants, results, i));
    const std::vector<ReportTable> tables = TablesOf(study, content, i, tolerance);
    content.tables.insert(content.tables.end(), tables.begin(), tables.end());
  }
  content.ranking = RankFactors(content.factors);
  content.pictures = MakeStudyPictures(study, variants, results, content.remarks);
  WriteFileAtomically(options.out / "tables" / "effects.csv", EffectsCsv(study, content));
  content.has_figures = WriteTables(content.tables, options.out, options.command);
  const std::filesystem::path page = options.out / "study.html";
  WriteFileAtomically(page, StudyPageHtml(content));
  return {page, content.tables.size(), content.has_figures, content.remarks};
}

}  // namespace pfseq
