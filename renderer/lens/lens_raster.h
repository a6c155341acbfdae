// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/vector.h"
#include "renderer/lens/lens.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace pfseq {

/// The directions of a lens's pixels, worked out once for all frames and cameras that use it.
/// Camera frame, unit vectors.
class LensRaster {
 public:
  /// The lens must outlive this.
  LensRaster(const Lens& lens, int width_px, int height_px, int num_threads);

  /// Direction of the pixel's centre, as Lens::Unproject gives it.
  std::optional<Vec3d> CentreDirection(int x, int y) const;

  /// Whether the field of view reaches over the whole pixel.
  bool IsInside(int x, int y) const { return state_[Index(x, y)] == kInside; }

  /// Whether the field of view reaches no part of the pixel.
  bool IsOutside(int x, int y) const { return state_[Index(x, y)] == kOutside; }

  /// Directions of the corners of a pixel that IsInside: upper left, upper right, lower left, lower
  /// right. Between them the lens is as good as bilinear: (pixel angle)^2 / 8 off at most.
  std::array<Vec3f, 4> CornerDirections(int x, int y) const;

  const Lens& OwnLens() const { return *lens_; }
  int WidthPx() const { return width_px_; }
  int HeightPx() const { return height_px_; }
  int64_t MemoryBytes() const;

 private:
  static constexpr uint8_t kOutside = 0;
  static constexpr uint8_t kRim = 1;
  static constexpr uint8_t kInside = 2;

  size_t Index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_px_) + static_cast<size_t>(x);
  }

  const Lens* lens_;
  int width_px_;
  int height_px_;
  /// NaN outside the field of view.
  std::vector<Vec3d> centres_;
  std::vector<Vec3f> corners_;
  std::vector<uint8_t> state_;
};

}  // namespace pfseq
