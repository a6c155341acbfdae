// SPDX-License-Identifier: Apache-2.0
// How good are features on a sequence? Detects, describes and matches on pairs of views, with every
// setting of a grid, and judges in 3D.
#pragma once

#include "validator/benchmark/view_source.h"
#include "validator/grid/grid.h"
#include "validator/match_picture.h"
#include "validator/metrics/scene_points.h"
#include "validator/metrics/tolerances.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pfseq {

/// Where a key point's place in the world comes from.
enum class Judge {
  kRay,  ///< its exact ray, cast at the sequence's scene
  kMap,  ///< its pixel in the distance map
};

/// Two views through one lens.
struct PairOfViews {
  std::string lens;
  ViewName first;
  ViewName second;
  /// "24" for the two cameras of a frame, as in the report; else "front:0-front:1".
  std::string label;
};

/// What a triplet did on a pair, match by match.
struct TripletMatches {
  std::string setup;
  PairOfViews pair;
  /// All detections, and their places in the world.
  std::array<std::vector<Vec2d>, 2> detections_px;
  PointsOfPair points;
  /// Attempted matches by index of detections.
  std::vector<std::pair<int, int>> attempted;

  /// The same with pixels and distances.
  std::vector<JudgedMatch> Judged() const;
};

struct BenchmarkOptions {
  /// "0", "0:64:8" (frames of the two cameras), "front:0-front:5" (any two views), separated by
  /// commas. Empty: all frames that both cameras have.
  std::string pairs;
  /// Instead: each frame of each camera with the one this many later. 0: not.
  int successive = 0;
  /// Empty: all lenses.
  std::vector<std::string> lenses;
  /// The pair of cameras; empty names: the first two.
  std::array<std::string, 2> cameras;
  /// Empty: realistic where there are such images, else clean.
  std::string variant;
  Judge judge = Judge::kRay;
  /// Of the bootstrap.
  uint64_t seed = 1;
  int num_threads = 1;
  /// Folder of finished stages; empty: none are kept.
  std::filesystem::path stages;
  /// Takes stages that are there; else the folder is emptied first.
  bool resume = false;
  /// Only units of work i with i % num_shards == shard; their stages are what counts.
  int shard = 0;
  int num_shards = 1;
  /// Folder for a picture of each triplet's matches on each pair; empty: none.
  std::filesystem::path pictures;
  /// Is told of each triplet on each pair, by several threads at once; may be empty.
  std::function<void(const TripletMatches&)> observer;
  bool quiet = false;
};

/// A metric at each tolerance (see Tolerances), or one value without tolerance.
struct Metric {
  std::string name;
  /// NaN: there is no value (degenerate cases).
  std::vector<double> values;
  /// 95 % confidence interval of each value; empty where none is computed.
  std::vector<double> low;
  std::vector<double> high;
};

/// All metrics of a detector's setting, or of a triplet, on a pair.
struct SettingResult {
  std::string setup;
  size_t pair_idx = 0;
  /// Fewer than two detections in one of the views: shares have no value.
  bool is_degenerate = false;
  std::vector<Metric> metrics;
};

/// CPU seconds of a stage.
struct StageTime {
  size_t pair_idx = 0;
  /// Of the unit of work: the detectors that share it.
  std::string unit;
  /// detect, describe NAME, match NAME, judge.
  std::string stage;
  double cpu_s = 0.0;
};

struct BenchmarkResults {
  std::string sequence;
  std::string variant;
  Judge judge = Judge::kRay;
  uint64_t seed = 0;
  std::vector<PairOfViews> pairs;
  Tolerances tolerances;
  /// In the order of the grid, pair by pair: detectors, then triplets.
  std::vector<SettingResult> settings;
  std::vector<StageTime> times;

  /// The metric of a setup on a pair; null when there is none.
  const Metric* Find(const std::string& setup, size_t pair_idx, const std::string& metric) const;
};

/// Runs all settings on all pairs. Everything but times is the same for any number of threads, any
/// split into shards and any interruption. InputError when something asked for is not there.
///
/// The work is one unit for each pair and family of detectors (settings that share key points):
/// detection of both views, then for each descriptor description, one pass over all distances,
/// matches of all members and matchers, and their judgement. Units run on their own threads; the
/// largest of them (90000 key points a view) holds some 100 MB, and no more than num_threads run at
/// once, besides the scene and the images of eight views.
BenchmarkResults RunBenchmark(const ViewSource& source,
                              const Grid& grid,
                              const BenchmarkOptions& options);

/// Roughly how long a pair takes on one core, for forecasts: the number of key points is only known
/// when they are found.
double ForecastCpuSeconds(const Grid& grid, int image_width_px);

/// A table for standard output: per setting and pair detections, matches and the measures at three
/// tolerances; at most `max_lines` lines.
std::string BenchmarkTable(const BenchmarkResults& results, size_t max_lines);

}  // namespace pfseq
