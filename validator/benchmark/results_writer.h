// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/benchmark/benchmark.h"

#include <filesystem>

namespace pfseq {

/// Writes into `folder` (made when missing; files of an earlier run are replaced):
///
///   results.csv     lens,pair,metric,setup,tolerance_m,value,low,high,tolerance_deg: one row for
///                   each setting, pair, tolerance and metric (see judge.h), in the form of the
///                   2014 tables. Angular tolerances stand in the last column, and what has no
///                   tolerance in neither; low and high are a 95 % confidence interval. An empty
///                   value: degenerate
///   results.json    the same as arrays over the tolerances, with program version, sequence, seed
///   times.csv       lens,pair,unit,stage,cpu_s: differs from run to run
///
/// SystemError when the folder cannot be written.
void WriteResults(const BenchmarkResults& results, const std::filesystem::path& folder);

/// How a run went.
struct RunRecord {
  std::string command;
  /// What was measured: a sequence's folder or a dataset's description.
  std::filesystem::path sequence;
  double wall_s = 0.0;
};

/// Writes run.json: command, sequence (relative to `folder`), wall_s, and finished, the time now in
/// UTC. Like times.csv it differs from run to run.
void WriteRun(const RunRecord& run, const std::filesystem::path& folder);

}  // namespace pfseq
