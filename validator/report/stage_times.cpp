// SPDX-License-Identifier: Apache-2.0
#include "validator/report/stage_times.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parse_number.h"
#include "validator/features/detect.h"
#include "validator/grid/setting.h"
#include "validator/report/csv_line.h"

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

namespace pfseq {
namespace {

/// Nothing for features from elsewhere.
std::optional<ParsedName> Parsed(const std::string& name) {
  try {
    return ParseName(name);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// "SIFT nopol 0.02 5.0 1.0 and 8 more": the first member's name.
std::string FirstOfUnit(const std::string& unit) { return unit.substr(0, unit.find(" and ")); }

/// Stages of the units of one case.
class CaseTimes {
 public:
  CaseTimes(const std::vector<StageTimeRow>& rows, const ReportCase& one) {
    for (const StageTimeRow& row : rows) {
      if (row.lens == one.lens && row.pair == one.pair) {
        units_[FirstOfUnit(row.unit)][row.stage] = row.cpu_s;
      }
    }
    for (const auto& [name, stages] : units_) {
      if (const std::optional<ParsedName> parsed = Parsed(name)) {
        detectors_.emplace_back(name, parsed->detector);
      }
    }
  }

  float CpuS(const ParsedName& name) const {
    const auto unit = std::find_if(detectors_.begin(), detectors_.end(), [&](const auto& known) {
      return known.second == name.detector ||
             (known.second.is_polar == name.detector.is_polar &&
              SameFamily(known.second.setting, name.detector.setting));
    });
    if (unit == detectors_.end()) {
      return kNone;
    }
    float cpu_s = Stage(unit->first, "detect");
    if (name.descriptor && name.matcher) {
      const std::string descriptor = DescriptorName(*name.descriptor);
      cpu_s += Stage(unit->first, "describe " + descriptor);
      cpu_s += Stage(unit->first, (name.matcher->Is("FLANN") ? "FLANN " : "match ") + descriptor);
    }
    return cpu_s;
  }

 private:
  static constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

  float Stage(const std::string& unit, const std::string& stage) const {
    const auto& stages = units_.at(unit);
    const auto found = stages.find(stage);
    return found == stages.end() ? kNone : static_cast<float>(found->second);
  }

  std::map<std::string, std::map<std::string, double>> units_;
  std::vector<std::pair<std::string, DetectorSetting>> detectors_;
};

void AddTo(SettingGroup& group, const std::vector<CaseTimes>& cases) {
  MetricTable table{1, {}};
  for (const ReportSetting& setting : group.settings) {
    const std::optional<ParsedName> parsed = Parsed(setting.name);
    for (const CaseTimes& times : cases) {
      table.values.push_back(parsed ? times.CpuS(*parsed)
                                    : std::numeric_limits<float>::quiet_NaN());
    }
  }
  group.metrics.emplace("cpu_s", std::move(table));
}

}  // namespace

std::vector<StageTimeRow> ReadStageTimes(const std::filesystem::path& path) {
  std::vector<StageTimeRow> rows;
  if (!std::filesystem::exists(path)) {
    return rows;
  }
  std::istringstream lines(ReadFile(path));
  std::string line;
  std::getline(lines, line);
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> columns = SplitCsvLine(line);
    const std::optional<double> cpu_s =
        columns.size() == 5 ? ParseNumber<double>(columns[4]) : std::nullopt;
    if (!cpu_s) {
      throw InputError("{}:{}: expected lens,pair,unit,stage,cpu_s", path.string(), number);
    }
    rows.push_back({columns[0], columns[1], columns[2], columns[3], *cpu_s});
  }
  return rows;
}

void AddStageTimes(const std::vector<std::vector<StageTimeRow>>& times, ResultSet& results) {
  if (std::all_of(times.begin(), times.end(), [](const auto& rows) { return rows.empty(); })) {
    return;
  }
  std::vector<CaseTimes> cases;
  for (const ReportCase& one : results.cases) {
    cases.emplace_back(times[one.source_idx], one);
  }
  AddTo(results.detectors, cases);
  AddTo(results.triplets, cases);
}

}  // namespace pfseq
