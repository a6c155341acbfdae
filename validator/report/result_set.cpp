// SPDX-License-Identifier: Apache-2.0
#include "validator/report/result_set.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parse_number.h"
#include "renderer/sequence/layout.h"
#include "validator/report/csv_line.h"
#include "validator/report/stage_times.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <unordered_map>

#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

using Json = nlohmann::json;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr std::string_view kFormat = "pfseq benchmark ";
/// The same as others under another name; left out.
const std::set<std::string, std::less<>> kAliases = {"one_minus_precision",
                                                     "score_over_repeatability"};

/// Algorithms begin with a capital letter, values do not.
ReportSetting SettingFromName(const std::string& name, bool is_triplet) {
  ReportSetting setting{name, "", false, "", ""};
  std::vector<std::string> algorithms;
  std::istringstream words(name);
  for (std::string word; words >> word;) {
    if (std::isupper(static_cast<unsigned char>(word[0])) != 0) {
      algorithms.push_back(word);
    }
    setting.is_polar |= word == "pol";
  }
  setting.detector = algorithms.empty() ? name : algorithms.front();
  if (is_triplet) {
    setting.matcher = algorithms.empty() ? "" : algorithms.back();
    setting.descriptor = algorithms.size() > 2 ? algorithms[1] : setting.detector;
  }
  return setting;
}

ViewName ViewFrom(const Json& json) { return {json.at("camera"), json.at("frame")}; }

Json ParseFile(const std::filesystem::path& path) {
  try {
    return Json::parse(ReadFile(path));
  } catch (const Json::exception& error) {
    throw InputError(
        "{}: expected the JSON that pfseq bench writes; {}", path.string(), error.what());
  }
}

/// Fills in one group from many benchmarks; settings keep the order in which they come.
class GroupBuilder {
 public:
  explicit GroupBuilder(bool is_triplets) : is_triplets_(is_triplets) {}

  void Add(const std::string& name, size_t case_idx, const Json& json, size_t num_tolerances) {
    const auto [found, is_new] = index_.emplace(name, group_.settings.size());
    if (is_new) {
      group_.settings.push_back(SettingFromName(name, is_triplets_));
    }
    for (const auto& [metric, array] : json.items()) {
      if (!array.is_array() || kAliases.find(metric) != kAliases.end()) {
        continue;
      }
      Entry entry{found->second, case_idx, {}};
      const size_t count = array.size() == 1 ? 1 : num_tolerances;
      for (size_t i = 0; i < count; ++i) {
        const Json& value = array.at(i);
        entry.values.push_back(value.is_null() ? kNone : value.get<float>());
      }
      entries_[metric].push_back(std::move(entry));
    }
  }

  SettingGroup Finish(size_t num_cases) {
    group_.num_cases = num_cases;
    for (const auto& [metric, entries] : entries_) {
      MetricTable table;
      for (const Entry& entry : entries) {
        table.num_values = std::max(table.num_values, entry.values.size());
      }
      table.values.assign(group_.settings.size() * num_cases * table.num_values, kNone);
      for (const Entry& entry : entries) {
        std::copy(entry.values.begin(),
                  entry.values.end(),
                  table.values.begin() +
                      static_cast<std::ptrdiff_t>((entry.setting_idx * num_cases + entry.case_idx) *
                                                  table.num_values));
      }
      group_.metrics.emplace(metric, std::move(table));
    }
    return std::move(group_);
  }

 private:
  struct Entry {
    size_t setting_idx;
    size_t case_idx;
    std::vector<float> values;
  };
  bool is_triplets_;
  SettingGroup group_;
  std::unordered_map<std::string, size_t> index_;
  std::map<std::string, std::vector<Entry>> entries_;
};

/// What run.json tells, where there is one.
void ReadRun(const std::filesystem::path& folder, ResultsSource& source) {
  if (!std::filesystem::exists(folder / "run.json")) {
    return;
  }
  const Json run = ParseFile(folder / "run.json");
  source.command = run.value("command", "");
  source.finished = run.value("finished", "");
  source.wall_s = run.value("wall_s", 0.0);
  const std::filesystem::path sequence = folder / run.value("sequence", "");
  if (run.contains("sequence") && std::filesystem::exists(sequence)) {
    source.sequence_folder = sequence;
  }
}

ResultsSource SourceFrom(const std::filesystem::path& folder, const Json& json) {
  if (!json.value("format", "").starts_with(kFormat)) {
    throw InputError("{}: expected the format '{}...', got '{}'",
                     (folder / "results.json").string(),
                     kFormat,
                     json.value("format", ""));
  }
  ResultsSource source;
  const std::filesystem::path full = std::filesystem::weakly_canonical(folder);
  source.name = full.filename().string();
  source.sequence = json.value("sequence", "");
  source.variant = json.value("variant", "");
  source.judge = json.value("judge", "");
  source.seed = json.value("seed", uint64_t{0});
  source.program_version = json.value("program_version", "");
  source.opencv_version = json.value("opencv_version", "");
  ReadRun(folder, source);
  return source;
}

/// Tells apart what is not the same for all.
void LabelCases(ResultSet& results) {
  std::set<std::string> lenses;
  for (const ReportCase& one : results.cases) {
    lenses.insert(one.lens);
  }
  for (ReportCase& one : results.cases) {
    one.label = one.pair.find('-') == std::string::npos ? "pair " + one.pair : one.pair;
    if (lenses.size() > 1) {
      one.label += ", " + one.lens;
    }
    if (results.sources.size() > 1) {
      one.label = results.sources[one.source_idx].name + ": " + one.label;
    }
  }
}

}  // namespace

double SettingGroup::Value(std::string_view metric,
                           size_t setting_idx,
                           size_t case_idx,
                           size_t tolerance_idx) const {
  const auto found = metrics.find(metric);
  if (found == metrics.end() || found->second.num_values == 0) {
    return kNone;
  }
  const MetricTable& table = found->second;
  const size_t i = table.num_values == 1 ? 0 : tolerance_idx;
  return table.values[(setting_idx * num_cases + case_idx) * table.num_values + i];
}

std::optional<size_t> SettingGroup::Find(std::string_view name) const {
  const auto found =
      std::find_if(settings.begin(), settings.end(), [&](const ReportSetting& setting) {
        return setting.name == name;
      });
  return found == settings.end() ? std::nullopt : std::optional<size_t>(found - settings.begin());
}

std::optional<size_t> ResultSet::ToleranceIdx(double tolerance_m) const {
  const auto found = std::find(tolerances_m.begin(), tolerances_m.end(), tolerance_m);
  return found == tolerances_m.end() ? std::nullopt
                                     : std::optional<size_t>(found - tolerances_m.begin());
}

std::string SequenceCredits(const std::filesystem::path& sequence_folder) {
  const std::filesystem::path path = sequence_folder / kSequenceFile;
  if (sequence_folder.empty() || !std::filesystem::exists(path)) {
    return "";
  }
  constexpr std::string_view kComment = "# ";
  std::string credits;
  std::istringstream lines(ReadFile(path));
  for (std::string line; std::getline(lines, line);) {
    credits = line.starts_with(kComment) ? line.substr(kComment.size()) : "";
  }
  return credits;
}

ResultSet ReadResults(const std::vector<std::filesystem::path>& folders) {
  ResultSet results;
  GroupBuilder detectors(false), triplets(true);
  std::vector<std::vector<StageTimeRow>> times;
  std::vector<Json> files;
  for (const std::filesystem::path& folder : folders) {
    files.push_back(ParseFile(folder / "results.json"));
  }
  for (size_t i = 0; i < folders.size(); ++i) {
    const std::string where = (folders[i] / "results.json").string();
    try {
      const Json& json = files[i];
      results.sources.push_back(SourceFrom(folders[i], json));
      const auto tolerances_m = json.at("tolerances_m").get<std::vector<double>>();
      const auto angles_deg = json.at("tolerances_deg").get<std::vector<double>>();
      if (i == 0) {
        results.tolerances_m = tolerances_m;
        results.tolerances_deg = angles_deg;
      } else if (tolerances_m != results.tolerances_m) {
        throw InputError("{}: tolerances_m: expected those of {}", where, folders[0].string());
      } else if (angles_deg != results.tolerances_deg) {
        results.tolerances_deg.clear();
      }
    } catch (const Json::exception& error) {
      throw InputError("{}: {}", where, error.what());
    }
  }
  for (size_t i = 0; i < folders.size(); ++i) {
    const std::string where = (folders[i] / "results.json").string();
    try {
      const size_t first_case = results.cases.size();
      for (const Json& pair : files[i].value("pairs", Json::array())) {
        results.cases.push_back({i,
                                 pair.at("lens"),
                                 pair.at("pair"),
                                 ViewFrom(pair.at("first")),
                                 ViewFrom(pair.at("second")),
                                 ""});
      }
      for (const Json& setting : files[i].at("settings")) {
        const size_t pair_idx = setting.at("pair").get<size_t>();
        if (first_case + pair_idx >= results.cases.size()) {
          throw InputError("{}: pair {}: expected less than the number of pairs", where, pair_idx);
        }
        GroupBuilder& group = setting.contains("attempted") ? triplets : detectors;
        group.Add(setting.at("setup"), first_case + pair_idx, setting, results.NumTolerances());
      }
    } catch (const Json::exception& error) {
      throw InputError("{}: {}", where, error.what());
    }
    times.push_back(ReadStageTimes(folders[i] / "times.csv"));
    files[i] = Json();
  }
  results.detectors = detectors.Finish(results.cases.size());
  results.triplets = triplets.Finish(results.cases.size());
  LabelCases(results);
  AddStageTimes(times, results);
  return results;
}

}  // namespace pfseq
