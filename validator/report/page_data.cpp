// SPDX-License-Identifier: Apache-2.0
#include "validator/report/page_data.h"

#include "validator/report/data_uri.h"
#include "validator/report/html_page.h"

#include <bit>
#include <set>
#include <span>

#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

using Json = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little);

Json GroupJson(const SettingGroup& group) {
  Json json = {{"settings", Json::array()}, {"metrics", Json::object()}};
  for (const ReportSetting& setting : group.settings) {
    json["settings"].push_back({{"name", setting.name},
                                {"detector", setting.detector},
                                {"polar", setting.is_polar},
                                {"descriptor", setting.descriptor},
                                {"matcher", setting.matcher}});
  }
  for (const auto& [name, table] : group.metrics) {
    json["metrics"][name] = {{"count", table.num_values},
                             {"values", Base64(std::as_bytes(std::span(table.values)))}};
  }
  return json;
}

Json SourcesJson(const ResultSet& results) {
  Json sources = Json::array();
  for (const ResultsSource& source : results.sources) {
    sources.push_back({{"name", source.name},
                       {"sequence", source.sequence},
                       {"variant", source.variant},
                       {"judge", source.judge},
                       {"seed", source.seed},
                       {"program", source.program_version},
                       {"opencv", source.opencv_version},
                       {"command", source.command},
                       {"finished", source.finished},
                       {"wall_s", source.wall_s},
                       {"credits", SequenceCredits(source.sequence_folder)}});
  }
  return sources;
}

Json RankedJson(const std::optional<Ranked>& ranked, const SettingGroup& group) {
  if (!ranked) {
    return nullptr;
  }
  return {{"setting", group.settings[ranked->setting_idx].name},
          {"value", ranked->value},
          {"count", ranked->count}};
}

Json VerdictJson(const PageContent& content) {
  Json lines = Json::array();
  for (const VerdictLine& line : content.verdict) {
    Json entries = Json::array();
    for (const VerdictEntry& entry : line.entries) {
      const SettingGroup& group =
          entry.measure->is_of_detectors ? content.results->detectors : content.results->triplets;
      entries.push_back({{"title", entry.measure->title},
                         {"metric", entry.measure->metric},
                         {"enough", entry.has_enough},
                         {"best", RankedJson(entry.best, group)},
                         {"second", RankedJson(entry.second, group)}});
    }
    lines.push_back({{"label", line.label}, {"entries", entries}});
  }
  return lines;
}

/// The 2014 curves of settings that were measured, on cases that are those pairs.
Json ReferenceJson(const PageContent& content) {
  std::set<std::string> pairs;
  for (const ReportCase& one : content.results->cases) {
    pairs.insert(one.pair);
  }
  Json curves = Json::array();
  for (const auto& [key, curve] : content.reference->Curves()) {
    const bool is_measured =
        content.results->detectors.Find(key.setup) || content.results->triplets.Find(key.setup);
    if (!is_measured || pairs.find(key.pair) == pairs.end()) {
      continue;
    }
    Json values = Json::array();
    for (const std::optional<double>& value : curve) {
      values.push_back(value ? Json(*value) : Json(nullptr));
    }
    curves.push_back(
        {{"metric", key.metric}, {"pair", key.pair}, {"setting", key.setup}, {"values", values}});
  }
  return curves;
}

Json BinsJson(const std::vector<FailureBin>& bins) {
  Json json = Json::array();
  for (const FailureBin& bin : bins) {
    json.push_back({{"label", bin.label}, {"attempted", bin.attempted}, {"correct", bin.correct}});
  }
  return json;
}

Json PicturesJson(const SequencePictures& pictures) {
  Json json = {{"pictures", Json::array()},
               {"failures", Json::array()},
               {"drives", Json::array()},
               {"remarks", pictures.remarks}};
  for (const ReportPicture& picture : pictures.pictures) {
    json["pictures"].push_back({{"case", picture.case_idx},
                                {"title", picture.title},
                                {"caption", picture.caption},
                                {"source", picture.source},
                                {"width", picture.width_px},
                                {"height", picture.height_px}});
  }
  for (const FailureTable& table : pictures.failures) {
    json["failures"].push_back({{"case", table.case_idx},
                                {"setting", table.setup},
                                {"radius", BinsJson(table.by_radius)},
                                {"distance", BinsJson(table.by_distance)},
                                {"blur", BinsJson(table.by_blur)}});
  }
  for (const DrivePath& drive : pictures.drives) {
    Json path = Json::array(), marks = Json::array();
    for (const DrivePoint& point : drive.path) {
      path.push_back({point.x_m, point.y_m});
    }
    for (const DriveMark& mark : drive.marks) {
      marks.push_back({{"label", mark.label}, {"at", {mark.x_m, mark.y_m}}});
    }
    json["drives"].push_back({{"source", drive.source_idx}, {"path", path}, {"marks", marks}});
  }
  return json;
}

}  // namespace

std::string PageDataJson(const PageContent& content) {
  const ResultSet& results = *content.results;
  Json json;
  json["version"] = PFSEQ_VERSION;
  json["command"] = content.command;
  json["sources"] = SourcesJson(results);
  json["cases"] = Json::array();
  for (const ReportCase& one : results.cases) {
    json["cases"].push_back(
        {{"label", one.label}, {"pair", one.pair}, {"lens", one.lens}, {"source", one.source_idx}});
  }
  json["tolerances_m"] = results.tolerances_m;
  json["tolerances_deg"] = results.tolerances_deg;
  json["verdict_tolerance_m"] = kVerdictToleranceM;
  json["enough_matches"] = kEnoughMatches;
  json["verdict"] = VerdictJson(content);
  json["conclusions"] = Json::array();
  for (const Conclusion& conclusion : content.conclusions) {
    json["conclusions"].push_back({{"claim", conclusion.claim},
                                   {"theirs", conclusion.theirs},
                                   {"ours", conclusion.ours},
                                   {"judgement", JudgementText(conclusion.judgement)}});
  }
  json["reference"] = ReferenceJson(content);
  json["files"] = Json::array();
  std::set<std::string> highlights;
  for (const ReportTable& table : content.tables) {
    json["files"].push_back({{"name", table.name}, {"caption", table.caption}});
    highlights.insert(table.settings.begin(), table.settings.end());
  }
  json["highlights"] = highlights;
  json["has_figures"] = content.has_figures;
  json["gallery"] = PicturesJson(content.pictures);
  json["detectors"] = GroupJson(results.detectors);
  json["triplets"] = GroupJson(results.triplets);
  return ScriptJson(json);
}

std::string PageHtml(const PageContent& content) {
  const std::string folder = "validator/report/page/";
  return AssemblePage(folder + "report.html",
                      {folder + "metrics.js",
                       folder + "data.js",
                       folder + "ui.js",
                       folder + "verdict.js",
                       folder + "curves.js",
                       folder + "table.js",
                       folder + "gallery.js"},
                      PageDataJson(content));
}

}  // namespace pfseq
