// SPDX-License-Identifier: Apache-2.0
// Noise for painting: computed once, looked up often.
#pragma once

#include <cstdint>
#include <vector>

namespace pfseq {

/// A square of fractal noise that repeats without a seam, of mean 0 and standard deviation 1. Its
/// finest grain is two texels, its coarsest a quarter of the square; an octave has 3/4 of the
/// amplitude of the next coarser one, about as brightness in photographs of walls.
class FractalTile {
 public:
  static constexpr int kSize_px = 512;

  explicit FractalTile(uint64_t seed);

  /// At a point of the plane, in texels; bilinear.
  float At(double x_px, double y_px) const;

  /// At (u, v) metres, one texel being `grain_m`; another `offset` gives an independent pattern.
  float At(double u_m, double v_m, double grain_m, uint64_t offset) const {
    return At(u_m / grain_m + static_cast<double>(offset * 167U % 509U),
              v_m / grain_m + static_cast<double>(offset * 89U % 503U));
  }

 private:
  std::vector<float> values_;
};

/// The tile that all painters share.
const FractalTile& SharedFractal();

}  // namespace pfseq
