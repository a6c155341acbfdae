// SPDX-License-Identifier: Apache-2.0
// The polar rectification of the report of 2014: azimuth to the right, incidence angle downwards,
// one angular step for both, nearest neighbour, the field taken as 180 degrees.
//
// width = round(2 pi s R), height = ceil(pi / 2 s R) + 1 and step = 1 / (s R), with R the radius in
// pixels at which the lens shows 90 degrees. s = 1 is one pixel a pixel at the rim; the report's
// example has 1.0239.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"
#include "renderer/lens/lens.h"

#include <cstdint>
#include <optional>

namespace pfseq {

/// Where the pixels of a polar image lie. Column x (a pixel's index) shows the azimuth 2 pi x /
/// width, from the image's x axis towards its y axis; row y the incidence angle y * step. Columns
/// repeat: a margin on each side shows what follows beyond the seam, so that features there are
/// seen whole.
class PolarMap {
 public:
  static constexpr int kSeamMarginPx = 128;

  /// InputError when the lens does not reach 90 degrees. The lens must outlive this.
  explicit PolarMap(const Lens& lens, double scale = 1.0);

  /// Without margins.
  int CoreWidthPx() const { return core_width_px_; }
  /// With margins.
  int WidthPx() const { return core_width_px_ + 2 * margin_px_; }
  int HeightPx() const { return height_px_; }

  /// Whether a column (pixel index with margins, any real number) lies between the margins: each
  /// azimuth does so once.
  bool IsInCore(double column) const;

  /// The direction that a place shows; column and row as pixel indices with margins.
  Vec3d DirectionCamera(double column, double row) const;

  /// The place in the fisheye image; nothing beyond the lens.
  std::optional<Vec2d> ToFisheye(double column, double row) const;

  /// The rectified image with margins; 0 where the fisheye image has no pixel.
  Image<uint8_t> Rectify(const Image<uint8_t>& fisheye) const;

 private:
  const Lens* lens_;
  int core_width_px_ = 0;
  int height_px_ = 0;
  int margin_px_ = 0;
  double row_step_rad_ = 0.0;
};

}  // namespace pfseq
