// SPDX-License-Identifier: Apache-2.0
// How long settings take, from the times of the stages that they share.
#pragma once

#include "validator/report/result_set.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

/// A line of times.csv.
struct StageTimeRow {
  std::string lens;
  std::string pair;
  std::string unit;
  std::string stage;
  double cpu_s = 0.0;
};

/// Empty when there is no such file. InputError when it is damaged.
std::vector<StageTimeRow> ReadStageTimes(const std::filesystem::path& path);

/// Adds the metric cpu_s: for a detector the detection in both views, for a triplet with
/// description and matching. Settings of a family (those that differ in thresholds) share these
/// stages, so the time is that of the family's key points: an upper bound. Where a stage was taken
/// from an earlier run, there is no time. `times` has one list for each source of the results.
void AddStageTimes(const std::vector<std::vector<StageTimeRow>>& times, ResultSet& results);

}  // namespace pfseq
