// SPDX-License-Identifier: Apache-2.0
// How points spread over the image circle: the four scores that the report of 2014 drafts, and Li's
// uniformity. Points are given in the unit disc: (pixel - principal point) / circle radius.
//
// Cells of equal area are rings and sectors in (r^2, azimuth). The fourth score is ours: the mean,
// over grids of 2 x 2, 4 x 4, ... 64 x 64 such cells, of the share of cells that hold a point. A
// further point never lowers it, so it is monotonic, and a single point far off adds no more than
// any other; of all sets of n points those have most that fall into different cells at each
// fineness, which is even spacing over the full disc. Coarse grids measure coverage, fine ones
// spacing. One point scores 1/18, 4096 perfectly spaced ones 1.
#pragma once

#include "renderer/core/vector.h"

#include <array>
#include <vector>

namespace pfseq {

struct SpreadScores {
  /// Share of 8 x 16 cells (rings x sectors) with at least 2 points, as Li counts.
  double cells = 0.0;
  /// Standard deviation of both coordinates together, over that of a uniform disc (sqrt(1/2)).
  double deviation = 0.0;
  /// Mean distance of all pairs, each point moved to the centre of its cell (8 x 16), over that in
  /// a uniform disc (128 / (45 pi)).
  double distance = 0.0;
  /// Ours.
  double coverage = 0.0;
};

/// Takes points one after the other; scores of those so far.
class SpreadCounter {
 public:
  SpreadCounter();
  void Add(const Vec2d& point_in_disc);
  SpreadScores Scores() const;

 private:
  int num_points_ = 0;
  Vec2d sum_ = Vec2d::Zero();
  double sum_of_squares_ = 0.0;
  std::vector<int> counts_;
  std::array<std::vector<bool>, 6> occupied_;
  std::array<int, 6> num_occupied_ = {};
};

/// Li's uniformity: the share of cells of 80 x 80 pixels with at least 2 points. Cells at the right
/// and lower rim may be smaller.
double Uniformity(const std::vector<Vec2d>& pixels_px, int width_px, int height_px);

}  // namespace pfseq
