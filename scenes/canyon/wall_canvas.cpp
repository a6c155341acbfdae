// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_canvas.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

/// What a fully soiled place keeps of its colour: soot is a little warmer than black.
const Rgb kSoiled(0.38F, 0.378F, 0.372F);

uint8_t ByteOf(double value) {
  return static_cast<uint8_t>(std::clamp(value, 0.0, 1.0) * 255.0 + 0.5);
}

void SetTexel(const Rgb& color, int x, int y, Image<uint8_t>& texels) {
  for (int channel = 0; channel < 3; ++channel) {
    texels.At(x, y, channel) = ByteOf(color[channel]);
  }
  texels.At(x, y, 3) = 255;
}

}  // namespace

WallCanvas::WallCanvas(const Vec2d& low_m, const Vec2d& high_m, double texel_m)
    : low_m_(low_m), high_m_(high_m), texel_m_(texel_m) {
  const Vec2d texels = SizeTexels(low_m, high_m, texel_m);
  width_px_ = static_cast<int>(texels.x());
  height_px_ = static_cast<int>(texels.y());
  step_m_ = (high_m - low_m).cwiseQuotient(texels);
  texels_.resize(static_cast<size_t>(width_px_) * static_cast<size_t>(height_px_));
}

Vec2d WallCanvas::SizeTexels(const Vec2d& low_m, const Vec2d& high_m, double texel_m) {
  const Vec2d size_m = high_m - low_m;
  return {std::max(2.0, std::ceil(size_m.x() / texel_m)),
          std::max(2.0, std::ceil(size_m.y() / texel_m))};
}

int WallCanvas::ColumnOf(double u_m) const {
  const double column = std::round((u_m - low_m_.x()) / step_m_.x());
  return static_cast<int>(std::clamp(column, 0.0, static_cast<double>(width_px_)));
}

int WallCanvas::RowOf(double v_m) const {
  const double row = std::round((high_m_.y() - v_m) / step_m_.y());
  return static_cast<int>(std::clamp(row, 0.0, static_cast<double>(height_px_)));
}

void WallCanvas::Rect(
    const Vec2d& low_m, const Vec2d& high_m, const Rgb& color, double alpha, double lift_m) {
  ForEach(low_m, high_m, [&](WallTexel& texel, const Vec2d& /*point_m*/) {
    texel.color = MixColor(texel.color, color, alpha);
    texel.height_m += static_cast<float>(lift_m);
  });
}

void WallCanvas::Line(const Vec2d& from_m,
                      const Vec2d& to_m,
                      double width_m,
                      const Rgb& color,
                      double alpha,
                      double lift_m) {
  const double shown_m = std::max(width_m, texel_m_);
  const double strength = alpha * std::min(1.0, width_m / shown_m);
  const Vec2d reach_m = Vec2d::Constant(0.5 * shown_m + texel_m_);
  const Vec2d along_m = to_m - from_m;
  const double length2 = along_m.squaredNorm();
  ForEach(from_m.cwiseMin(to_m) - reach_m,
          from_m.cwiseMax(to_m) + reach_m,
          [&](WallTexel& texel, const Vec2d& point_m) {
            const Vec2d from_start_m = point_m - from_m;
            const double t =
                length2 > 0.0 ? std::clamp(from_start_m.dot(along_m) / length2, 0.0, 1.0) : 0.0;
            const double distance_m = (from_start_m - t * along_m).norm();
            const double cover =
                std::clamp(0.5 + (0.5 * shown_m - distance_m) / texel_m_, 0.0, 1.0);
            texel.color = MixColor(texel.color, color, strength * cover);
            texel.height_m += static_cast<float>(lift_m * cover);
          });
}

PaintedWall WallCanvas::Finish(const std::string& name, int normal_step) const {
  const auto texel = [&](int x, int y) -> const WallTexel& {
    return texels_[static_cast<size_t>(std::clamp(y, 0, height_px_ - 1)) *
                       static_cast<size_t>(width_px_) +
                   static_cast<size_t>(std::clamp(x, 0, width_px_ - 1))];
  };
  PaintedWall wall;
  wall.color = {name, Image<uint8_t>(width_px_, height_px_, 4), true};
  for (int y = 0; y < height_px_; ++y) {
    for (int x = 0; x < width_px_; ++x) {
      const WallTexel& from = texel(x, y);
      const Rgb kept = 1.0F - (1.0F - kSoiled) * std::clamp(from.dirt, 0.0F, 1.0F);
      SetTexel(from.color * kept, x, y, wall.color.texels);
    }
  }
  const int columns = std::max(1, width_px_ / normal_step);
  const int rows = std::max(1, height_px_ / normal_step);
  wall.normal = {name + "_normal", Image<uint8_t>(columns, rows, 4), false};
  const double spacing_m = 2.0 * normal_step * texel_m_;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const int column = x * width_px_ / columns + normal_step / 2;
      const int row = y * height_px_ / rows + normal_step / 2;
      const auto slope = [&](int dx, int dy) {
        return (texel(column + dx, row + dy).height_m - texel(column - dx, row - dy).height_m) /
               spacing_m;
      };
      // Rows run down, the bitangent up: the slope along it has the opposite sign.
      const Vec2f& tilt = texel(column, row).tilt;
      const Vec3d normal =
          Vec3d(tilt.x() - slope(normal_step, 0), tilt.y() + slope(0, normal_step), 1.0)
              .normalized();
      SetTexel(
          (0.5 * normal + Vec3d::Constant(0.5)).cast<float>().array(), x, y, wall.normal.texels);
    }
  }
  constexpr int kRoughnessStep = 4;
  const int rough_columns = std::max(1, width_px_ / kRoughnessStep);
  const int rough_rows = std::max(1, height_px_ / kRoughnessStep);
  wall.roughness = {name + "_roughness", Image<uint8_t>(rough_columns, rough_rows, 4), false};
  for (int y = 0; y < rough_rows; ++y) {
    for (int x = 0; x < rough_columns; ++x) {
      const WallTexel& from =
          texel(x * width_px_ / rough_columns + 2, y * height_px_ / rough_rows + 2);
      SetTexel(Rgb(0.0F, from.roughness, 0.0F), x, y, wall.roughness.texels);
    }
  }
  return wall;
}

}  // namespace pfseq
