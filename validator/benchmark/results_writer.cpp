// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/results_writer.h"

#include "renderer/core/file.h"
#include "renderer/core/units.h"

#include <cmath>
#include <ctime>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

namespace pfseq {
namespace {

/// Counts without decimals; nothing for what has no value.
std::string ValueText(double value) {
  if (std::isnan(value)) {
    return "";
  }
  return value == std::floor(value) && std::abs(value) < 1e9 ? fmt::format("{:.0f}", value)
                                                             : fmt::format("{:.6f}", value);
}

/// A column of the tables; in quotes where it holds a comma.
std::string Field(const std::string& text) {
  return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

std::string TolerancesText(const Tolerances& tolerances, size_t i, bool is_angle) {
  if (tolerances.IsAngle(i) != is_angle) {
    return "";
  }
  return fmt::format("{:.6g}", is_angle ? DegFromRad(tolerances.Limit(i)) : tolerances.Limit(i));
}

std::string ResultsCsv(const BenchmarkResults& results) {
  std::string text = "lens,pair,metric,setup,tolerance_m,value,low,high,tolerance_deg\n";
  for (const SettingResult& setting : results.settings) {
    const PairOfViews& pair = results.pairs[setting.pair_idx];
    for (const Metric& metric : setting.metrics) {
      const bool has_tolerance = metric.values.size() == results.tolerances.Size();
      for (size_t i = 0; i < metric.values.size(); ++i) {
        const bool has_interval = !metric.low.empty();
        fmt::format_to(std::back_inserter(text),
                       "{},{},{},{},{},{},{},{},{}\n",
                       pair.lens,
                       pair.label,
                       metric.name,
                       Field(setting.setup),
                       has_tolerance ? TolerancesText(results.tolerances, i, false) : "",
                       ValueText(metric.values[i]),
                       has_interval ? ValueText(metric.low[i]) : "",
                       has_interval ? ValueText(metric.high[i]) : "",
                       has_tolerance ? TolerancesText(results.tolerances, i, true) : "");
      }
    }
  }
  return text;
}

std::string TimesCsv(const BenchmarkResults& results) {
  std::string text = "lens,pair,unit,stage,cpu_s\n";
  for (const StageTime& time : results.times) {
    const PairOfViews& pair = results.pairs[time.pair_idx];
    text += fmt::format(
        "{},{},{},{},{:.4f}\n", pair.lens, pair.label, Field(time.unit), time.stage, time.cpu_s);
  }
  return text;
}

std::string ArrayText(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) {
    const std::string number = ValueText(value);
    text += (text.size() > 1 ? "," : "") + (number.empty() ? "null" : number);
  }
  return text + "]";
}

/// What was measured and how.
nlohmann::ordered_json Description(const BenchmarkResults& results) {
  nlohmann::ordered_json json;
  json["format"] = "pfseq benchmark 2";
  json["program_version"] = PFSEQ_VERSION;
  json["opencv_version"] = CV_VERSION;
  json["sequence"] = results.sequence;
  json["variant"] = results.variant;
  json["judge"] = results.judge == Judge::kRay ? "ray" : "map";
  json["seed"] = results.seed;
  json["tolerances_m"] = kTolerancesM;
  std::vector<double> angles_deg;
  for (const double angle_rad : results.tolerances.angles_rad) {
    angles_deg.push_back(std::round(1e9 * DegFromRad(angle_rad)) / 1e9);
  }
  json["tolerances_deg"] = angles_deg;
  for (const PairOfViews& pair : results.pairs) {
    json["pairs"].push_back(
        {{"lens", pair.lens},
         {"pair", pair.label},
         {"first", {{"camera", pair.first.camera}, {"frame", pair.first.frame}}},
         {"second", {{"camera", pair.second.camera}, {"frame", pair.second.frame}}}});
  }
  return json;
}

/// One line a setting and pair; written by hand, as there are many.
std::string ResultsJson(const BenchmarkResults& results) {
  std::string text = Description(results).dump(1);
  text.resize(text.size() - 2);  // The closing brace; more keys follow.
  text += ",\n \"settings\": [\n";
  for (size_t i = 0; i < results.settings.size(); ++i) {
    const SettingResult& setting = results.settings[i];
    text += fmt::format("  {{\"setup\":{},\"pair\":{},\"degenerate\":{}",
                        nlohmann::json(setting.setup).dump(),
                        setting.pair_idx,
                        setting.is_degenerate);
    for (const Metric& metric : setting.metrics) {
      text += fmt::format(",\"{}\":{}", metric.name, ArrayText(metric.values));
      if (!metric.low.empty()) {
        text += fmt::format(",\"{0}_low\":{1},\"{0}_high\":{2}",
                            metric.name,
                            ArrayText(metric.low),
                            ArrayText(metric.high));
      }
    }
    text += i + 1 < results.settings.size() ? "},\n" : "}\n";
  }
  return text + " ]\n}\n";
}

}  // namespace

void WriteResults(const BenchmarkResults& results, const std::filesystem::path& folder) {
  WriteFileAtomically(folder / "results.csv", ResultsCsv(results));
  WriteFileAtomically(folder / "times.csv", TimesCsv(results));
  WriteFileAtomically(folder / "results.json", ResultsJson(results));
}

void WriteRun(const RunRecord& run, const std::filesystem::path& folder) {
  const std::time_t now = std::time(nullptr);
  std::tm utc = {};
  gmtime_r(&now, &utc);
  nlohmann::ordered_json json;
  json["command"] = run.command;
  json["sequence"] = std::filesystem::proximate(run.sequence, folder).generic_string();
  json["wall_s"] = run.wall_s;
  json["finished"] = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z",
                                 utc.tm_year + 1900,
                                 utc.tm_mon + 1,
                                 utc.tm_mday,
                                 utc.tm_hour,
                                 utc.tm_min,
                                 utc.tm_sec);
  WriteFileAtomically(folder / "run.json", json.dump(1) + "\n");
}

}  // namespace pfseq
