// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_page.h"

#include "validator/report/data_uri.h"
#include "validator/report/html_page.h"

#include <bit>
#include <cmath>
#include <set>
#include <span>

namespace pfseq {
namespace {

using Json = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little);

Json NumberJson(double value) { return std::isnan(value) ? Json(nullptr) : Json(value); }

Json IntervalsJson(const std::vector<Interval>& intervals) {
  Json json = Json::array();
  for (const Interval& one : intervals) {
    json.push_back({{"count", one.count},
                    {"mean", NumberJson(one.mean)},
                    {"low", NumberJson(one.low)},
                    {"high", NumberJson(one.high)}});
  }
  return json;
}

Json EffectJson(const Effect& effect) {
  return {{"levels", IntervalsJson(effect.levels)},
          {"changes", IntervalsJson(effect.changes)},
          {"explained", NumberJson(effect.shares.levels)},
          {"by_samples", NumberJson(effect.shares.samples)},
          {"rest", NumberJson(effect.shares.rest)},
          {"range", NumberJson(effect.Range())}};
}

/// The effects of a factor on a metric of all settings.
Json MetricJson(const FactorTable& table,
                const SettingGroup& group,
                const std::string& metric,
                size_t base_idx) {
  const size_t num_tolerances = group.metrics.at(metric).num_values;
  const size_t num_levels = table.cases.size();
  std::array<std::vector<float>, 6> parts;
  for (std::vector<float>& part : parts) {
    part.resize(group.settings.size() * num_levels * num_tolerances);
  }
  std::vector<float> explained;
  for (size_t i = 0; i < group.settings.size(); ++i) {
    for (size_t t = 0; t < num_tolerances; ++t) {
      const Effect effect = EffectOf(ValuesOf(table, group, metric, i, t), base_idx);
      for (size_t level = 0; level < num_levels; ++level) {
        const size_t at = (i * num_levels + level) * num_tolerances + t;
        const Interval& mean = effect.levels[level];
        const Interval& change = effect.changes[level];
        const double values[] = {
            mean.mean, mean.low, mean.high, change.mean, change.low, change.high};
        for (size_t part = 0; part < parts.size(); ++part) {
          parts[part][at] = static_cast<float>(values[part]);
        }
      }
      explained.push_back(static_cast<float>(effect.shares.levels));
    }
  }
  const char* names[] = {"mean", "low", "high", "change", "change_low", "change_high"};
  Json json = {{"count", num_tolerances}};
  for (size_t part = 0; part < parts.size(); ++part) {
    json[names[part]] = Base64(std::as_bytes(std::span(parts[part])));
  }
  json["explained"] = Base64(std::as_bytes(std::span(explained)));
  return json;
}

Json FactorJson(const StudyContent& content, size_t factor_idx) {
  const StudyFactor& factor = content.study->factors[factor_idx];
  const FactorFindings& findings = content.factors[factor_idx];
  Json json = {{"name", factor.name},
               {"title", factor.title},
               {"base", factor.base_idx},
               {"numeric", factor.IsNumeric()},
               {"samples", findings.table.NumSamples()},
               {"labels", Json::array()},
               {"numbers", Json::array()}};
  for (const StudyLevel& level : factor.levels) {
    json["labels"].push_back(level.label);
    json["numbers"].push_back(level.number ? Json(*level.number) : Json(nullptr));
  }
  json["text"] = EffectText(factor, findings.triplets, "triplets' matching score");
  json["triplets_effect"] = EffectJson(findings.triplets);
  json["detectors_effect"] = EffectJson(findings.detectors);
  json["detections_effect"] = EffectJson(findings.detections);
  for (const bool is_triplets : {true, false}) {
    const SettingGroup& group =
        is_triplets ? content.results->triplets : content.results->detectors;
    Json& metrics = json[is_triplets ? "triplets" : "detectors"] = Json::object();
    for (const std::string& metric : StudyMetrics(is_triplets)) {
      if (group.Has(metric) && findings.table.NumSamples() > 0) {
        metrics[metric] = MetricJson(findings.table, group, metric, factor.base_idx);
      }
    }
  }
  json["comparisons"] = Json::array();
  for (const Comparison& one : findings.comparisons) {
    const SettingGroup& group =
        one.is_triplets ? content.results->triplets : content.results->detectors;
    const std::string& a = group.settings[one.a_idx].name;
    const std::string& b = group.settings[one.b_idx].name;
    const ShortNames names = ShortNamesOf(a, b);
    json["comparisons"].push_back({{"kind", one.is_triplets ? "triplets" : "detectors"},
                                   {"a", a},
                                   {"b", b},
                                   {"short_a", names.a},
                                   {"short_b", names.b},
                                   {"shared", names.shared},
                                   {"differences", IntervalsJson(one.differences)},
                                   {"text", one.text}});
  }
  return json;
}

Json NamesJson(const SettingGroup& group) {
  Json names = Json::array();
  for (const ReportSetting& setting : group.settings) {
    names.push_back(setting.name);
  }
  return names;
}

}  // namespace

const std::vector<std::string>& StudyMetrics(bool is_triplets) {
  static const std::vector<std::string> triplets = {
      "matching_score", "correct_matches", "precision", "recall", "attempted"};
  static const std::vector<std::string> detectors = {
      "repeatability", "matches", "detections_first", "nonredundant_repeatability"};
  return is_triplets ? triplets : detectors;
}

std::string StudyPageHtml(const StudyContent& content) {
  const StudySpec& study = *content.study;
  const ResultSet& results = *content.results;
  Json json;
  json["version"] = PFSEQ_VERSION;
  json["command"] = content.command;
  json["name"] = study.name;
  json["study"] = study.effective_yaml;
  json["design"] = study.design == StudyDesign::kOneAtATime ? "one at a time" : "all combinations";
  json["images"] = study.images;
  json["repetitions"] = study.repetitions.size();
  json["tolerances_m"] = results.tolerances_m;
  json["tolerances_deg"] = results.tolerances_deg;
  json["tolerance_m"] = study.tolerance_m;
  json["ranking"] = content.ranking;
  json["triplets"] = NamesJson(results.triplets);
  json["detectors"] = NamesJson(results.detectors);
  json["factors"] = Json::array();
  for (size_t i = 0; i < study.factors.size(); ++i) {
    json["factors"].push_back(FactorJson(content, i));
  }
  json["variants"] = Json::array();
  std::set<std::string> credits;
  for (size_t i = 0; i < content.variants->size(); ++i) {
    const ResultsSource& source = results.sources[i];
    json["variants"].push_back({{"name", (*content.variants)[i].name},
                                {"program", source.program_version},
                                {"opencv", source.opencv_version},
                                {"finished", source.finished}});
    credits.insert(SequenceCredits(source.sequence_folder));
  }
  credits.erase("");
  json["credits"] = credits;
  json["pictures"] = Json::array();
  for (const StudyPicture& picture : content.pictures) {
    json["pictures"].push_back({{"factor", picture.factor_idx},
                                {"level", picture.level_idx},
                                {"view", picture.view},
                                {"whole", picture.whole},
                                {"detail", picture.detail},
                                {"detail_px", picture.detail_px}});
  }
  json["remarks"] = content.remarks;
  json["files"] = Json::array();
  for (const ReportTable& table : content.tables) {
    json["files"].push_back({{"name", table.name}, {"caption", table.caption}});
  }
  json["has_figures"] = content.has_figures;
  const std::string shared = "validator/report/page/";
  const std::string own = "validator/study/page/";
  return AssemblePage(own + "study.html",
                      {shared + "metrics.js",
                       shared + "ui.js",
                       own + "study_data.js",
                       own + "study_verdict.js",
                       own + "study_curves.js",
                       own + "study_table.js",
                       own + "study_pictures.js"},
                      ScriptJson(json));
}

}  // namespace pfseq
