// SPDX-License-Identifier: Apache-2.0
// The metrics, from key points with their places in the world.
//
//   matches                   pairs of detections that show the same place, one-to-one, closest
//   first repeatability             matches / the fewer of both views' detections (Mikolajczyk
//   2005) repeatability_reference   matches / detections of the first view (Gauglitz 2011, Li 2013)
//   nonredundant_repeatability   the same with overlapping detections counted once (Rey-Otero
//   2014):
//                             matches' and detections' volumes in the view where that is smaller
//   matches_best_N, repeatability_best_N   of the N strongest key points of each view
//   spread_cells, spread_deviation, spread_distance, spread_coverage   spread.h, of the matches'
//   (or
//                             correct matches') points in the first view
//   detections_first, detections_second, uniformity   without tolerance; Li's uniformity of the
//   first
// and of a triplet
//   correct_matches           attempted matches that show the same place
//   matching_score            correct matches / the fewer of both views' detections
//   precision, one_minus_precision   correct / attempted matches
//   recall                    correct matches / matches: the report's matching score over
//   repeatability score_over_repeatability  the same under the report's name attempted,
//   survival_rate  without tolerance; attempted matches / detections of the first view (Li)
//
// Sky points are detections that never match. RatioTest and FLANN may match several points with
// one, so that their matching score can exceed the repeatability.
#pragma once

#include "validator/benchmark/benchmark.h"
#include "validator/metrics/bootstrap.h"
#include "validator/metrics/scene_points.h"

#include <string>
#include <utility>
#include <vector>

namespace pfseq {

/// Key points of one view that count.
struct JudgedView {
  std::vector<Vec2d> pixels_px;
  /// Pixels relative to the principal point, over the circle's radius.
  std::vector<Vec2d> in_disc;
  std::vector<double> sizes_px;
  std::vector<double> responses;
  int width_px = 0;
  int height_px = 0;
};

/// Both views of a pair; indices of views and points agree.
struct JudgedPair {
  JudgedView first;
  JudgedView second;
  PointsOfPair points;
};

/// What metrics are asked for.
struct JudgeSetting {
  Tolerances tolerances;
  std::vector<int> best;
};

/// The detector's metrics, and how many matches there are at each tolerance.
struct DetectionJudgement {
  std::vector<int> matches;
  SettingResult result;
};

DetectionJudgement JudgeDetections(const JudgedPair& pair,
                                   const JudgeSetting& setting,
                                   const BootstrapDraws& draws);

/// The triplet's metrics.
SettingResult JudgeMatches(const JudgedPair& pair,
                           const std::vector<std::pair<int, int>>& attempted,
                           const DetectionJudgement& detections,
                           const JudgeSetting& setting,
                           const BootstrapDraws& draws);

}  // namespace pfseq
