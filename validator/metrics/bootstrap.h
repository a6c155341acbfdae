// SPDX-License-Identifier: Apache-2.0
// Confidence intervals of shares by block bootstrap (Efron 1979; Kuensch 1989): neighbouring key
// points are not independent, so the cells of the image circle are drawn, not the points.
#pragma once

#include "renderer/core/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfseq {

inline constexpr int kNumBootstrapCells = 64;
inline constexpr int kNumBootstrapDraws = 200;

/// The cell of a point in the unit disc: one of 8 rings of equal area times 8 sectors.
int BootstrapCell(const Vec2d& point_in_disc);

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// How often each cell is drawn, draw by draw; from a seed alone.
class BootstrapDraws {
 public:
  explicit BootstrapDraws(uint64_t seed);

  /// The 2.5 and 97.5 percent quantiles of sum(part) / sum(whole) over the draws. NaN when the
  /// whole is empty.
  Interval IntervalOf(const std::array<int, kNumBootstrapCells>& part,
                      const std::array<int, kNumBootstrapCells>& whole) const;

 private:
  std::vector<std::array<uint8_t, kNumBootstrapCells>> draws_;
};

}  // namespace pfseq
