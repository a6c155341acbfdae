// SPDX-License-Identifier: Apache-2.0
// Noise of several scales, stored as a tile that repeats over the plane.
#pragma once

#include "renderer/core/vector.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace pfseq {

/// One scale of a noise.
struct NoiseOctave {
  /// gradient: Perlin 2002, "Improving Noise". billow: cellular noise (Worley 1996, "A Cellular
  /// Texture Basis Function"), 1 at a feature point and 0 a cell away from all.
  enum class Kind { kGradient, kBillow };
  Kind kind = Kind::kGradient;
  /// Cells along the tile's side.
  int num_cells = 1;
  float weight = 1.0F;
};

/// Two independent values of mean 0 at each point of a plane.
class NoiseTile {
 public:
  static constexpr int kSizePx = 512;

  /// The tile's side is `size_m`. Another seed gives other noise.
  NoiseTile(double size_m, const std::vector<NoiseOctave>& octaves, uint64_t seed);

  /// Bilinear.
  Vec2f At(float x_m, float y_m) const {
    const float x = x_m * pixels_a_metre_;
    const float y = y_m * pixels_a_metre_;
    const float column = std::floor(x);
    const float row = std::floor(y);
    const Vec2f* upper = Row(static_cast<int>(row));
    const Vec2f* lower = Row(static_cast<int>(row) + 1);
    const int left = Wrap(static_cast<int>(column));
    const int right = Wrap(static_cast<int>(column) + 1);
    const float dx = x - column;
    const Vec2f above = upper[left] + dx * (upper[right] - upper[left]);
    const Vec2f below = lower[left] + dx * (lower[right] - lower[left]);
    return above + (y - row) * (below - above);
  }

  /// The value of a pixel; any whole numbers.
  const Vec2f& Pixel(int column, int row) const { return Row(row)[Wrap(column)]; }
  float PixelsAMetre() const { return pixels_a_metre_; }

 private:
  /// Two's complement makes this the periodic remainder for negative numbers too.
  static int Wrap(int index) { return index & (kSizePx - 1); }
  const Vec2f* Row(int row) const { return &values_[static_cast<size_t>(Wrap(row)) * kSizePx]; }

  float pixels_a_metre_;
  std::vector<Vec2f> values_;
};

}  // namespace pfseq
