// SPDX-License-Identifier: Apache-2.0
// How good are features on a sequence? Detects, describes and matches on pairs of views and judges
// in 3D.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/sequence/sequence_reader.h"
#include "validator/features/sift.h"
#include "validator/metrics/feature_metrics.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

struct BenchmarkOptions {
  /// Empty: all frames for which both cameras have a clean image and a distance map.
  std::vector<int> frames;
  /// Empty: all lenses.
  std::vector<std::string> lenses;
  /// The pair; empty names: the first two cameras of the rig.
  std::array<std::string, 2> cameras;
  SiftSetting sift;
  int num_threads = 1;
  /// No progress line.
  bool quiet = false;
};

/// An attempted match in the two images.
struct JudgedMatch {
  std::array<Vec2d, 2> pixels_px;
  /// Between the two points in the world; +inf when one of them has no place there.
  double distance_m = 0.0;
};

/// One frame seen by both cameras through one lens.
struct PairResult {
  std::string lens;
  int frame = 0;
  FeatureMetrics metrics;
  std::vector<JudgedMatch> attempted;
  /// Wall time of detection and description of both images, of matching, and of judging.
  double detect_s = 0.0;
  double match_s = 0.0;
  double judge_s = 0.0;
};

struct BenchmarkResults {
  /// Name of the sequence's folder.
  std::string sequence;
  std::array<std::string, 2> cameras;
  std::vector<std::string> lenses;
  std::vector<int> frames;
  SiftSetting sift;
  /// Lens by lens, frames ascending.
  std::vector<PairResult> pairs;

  /// The detector's setting, the subject of matches and repeatability.
  std::string DetectorName() const { return sift.Name(); }
  /// Detector, descriptor and matcher, the subject of correct matches and matching score.
  std::string TripletName() const { return sift.Name() + " SIFT BruteForce"; }
};

/// Runs SIFT with cross-checked brute force on the clean images. The results, but for the times, do
/// not depend on the number of threads. InputError when a camera, lens or frame asked for is not
/// there, or there is nothing to do.
BenchmarkResults RunBenchmark(const SequenceReader& reader, const BenchmarkOptions& options);

/// A table for standard output: per pair detections, attempted matches and the measures at three
/// tolerances.
std::string BenchmarkTable(const BenchmarkResults& results);

}  // namespace pfseq
