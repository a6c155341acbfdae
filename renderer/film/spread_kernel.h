// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/vector.h"
#include "renderer/film/cell_film.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pfseq {

/// How much of the light of the cells about a pixel each channel of the pixel takes, a sum of
/// Gaussians. A cell counts as evenly lit; a Gaussian's weights are the exact integral over cell
/// and pixel.
class SpreadKernel {
 public:
  /// Gaussians are cut off at so many standard deviations: 6e-5 of their light is beyond.
  static constexpr double kCutoffSigmas = 4.0;

  /// Over the pixels up to reach_px from the middle one.
  explicit SpreadKernel(int reach_px);

  /// Light from `offset_px` from the pixel's centre; what is outside the reach is lost.
  void AddGaussian(const Vec2d& offset_px, double sigma_px, const Vec3d& weights);

  /// Without the outer pixels that hardly count, 0.2 % of a channel's light at most; each channel's
  /// weights add up to 1.
  SpreadKernel Trimmed() const;

  int ReachPx() const { return reach_px_; }
  /// Cells along a side; the first one is at the left or upper edge of the pixel ReachPx() away.
  int Side() const { return side_; }
  float At(size_t channel, int x, int y) const {
    return weights_[channel][static_cast<size_t>(y * side_ + x)];
  }

 private:
  float& At(size_t channel, int x, int y) {
    return weights_[channel][static_cast<size_t>(y * side_ + x)];
  }

  int reach_px_;
  int side_;
  std::array<std::vector<float>, 3> weights_;
};

}  // namespace pfseq
