// SPDX-License-Identifier: Apache-2.0
#include "validator/features/polar_image.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {

PolarMap::PolarMap(const Lens& lens, double scale) : lens_(&lens) {
  const std::optional<Vec2d> rim_px = lens.Project(Vec3d::UnitX());
  if (!rim_px) {
    throw InputError("polar rectification: expected a lens of at least 180 degrees, got {:g}",
                     2.0 * DegFromRad(lens.MaxAngleRad()));
  }
  const double radius_px = scale * (rim_px->x() - lens.PrincipalPointPx().x());
  core_width_px_ = std::max(1, static_cast<int>(std::lround(2.0 * std::numbers::pi * radius_px)));
  height_px_ = static_cast<int>(std::ceil(0.5 * std::numbers::pi * radius_px)) + 1;
  margin_px_ = std::min(kSeamMarginPx, core_width_px_);
  row_step_rad_ = 1.0 / radius_px;
}

bool PolarMap::IsInCore(double column) const {
  return column >= margin_px_ && column < margin_px_ + core_width_px_;
}

Vec3d PolarMap::DirectionCamera(double column, double row) const {
  const double azimuth_rad = 2.0 * std::numbers::pi * (column - margin_px_) / core_width_px_;
  const double incidence_rad = row * row_step_rad_;
  return {std::sin(incidence_rad) * std::cos(azimuth_rad),
          std::sin(incidence_rad) * std::sin(azimuth_rad),
          std::cos(incidence_rad)};
}

std::optional<Vec2d> PolarMap::ToFisheye(double column, double row) const {
  return lens_->Project(DirectionCamera(column, row));
}

Image<uint8_t> PolarMap::Rectify(const Image<uint8_t>& fisheye) const {
  Image<uint8_t> polar(WidthPx(), height_px_, fisheye.NumChannels());
  for (int y = 0; y < polar.HeightPx(); ++y) {
    // Columns of the margins are copies, to the bit.
    for (int i = 0; i < core_width_px_; ++i) {
      const int x = margin_px_ + i;
      const std::optional<Vec2d> pixel_px = ToFisheye(x, y);
      if (!pixel_px) {
        continue;
      }
      const double from_x = std::floor(pixel_px->x());
      const double from_y = std::floor(pixel_px->y());
      if (from_x >= 0.0 && from_x < fisheye.WidthPx() && from_y >= 0.0 &&
          from_y < fisheye.HeightPx()) {
        for (int channel = 0; channel < fisheye.NumChannels(); ++channel) {
          polar.At(x, y, channel) =
              fisheye.At(static_cast<int>(from_x), static_cast<int>(from_y), channel);
        }
      }
    }
    for (int x = 0; x < margin_px_; ++x) {
      for (int channel = 0; channel < fisheye.NumChannels(); ++channel) {
        polar.At(x, y, channel) = polar.At(x + core_width_px_, y, channel);
        polar.At(x + margin_px_ + core_width_px_, y, channel) =
            polar.At(x + margin_px_, y, channel);
      }
    }
  }
  return polar;
}

}  // namespace pfseq
