// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/sky_map.h"

#include "renderer/core/check.h"
#include "renderer/core/error.h"
#include "renderer/sequence/image_io.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pfseq {
namespace {

/// Widest map that is kept: 0.088 degrees a pixel, finer than the sky's image.
constexpr int kMaxWidthPx = 4096;
constexpr int kMinWidthPx = 8;
constexpr int kMaxFilePx = 16384;
/// The ring around the sun from which its surroundings are taken.
constexpr double kRingRadiusRad = 0.14;

/// Means of squares of `factor` pixels; what does not fill a square at the end is left out.
Image<float> Coarser(const Image<float>& image, int factor) {
  if (factor <= 1) {
    return image;
  }
  Image<float> coarse(image.WidthPx() / factor, image.HeightPx() / factor, 3);
  for (int y = 0; y < coarse.HeightPx(); ++y) {
    for (int x = 0; x < coarse.WidthPx(); ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        double sum = 0.0;
        for (int i = 0; i < factor * factor; ++i) {
          sum += image.At(x * factor + i % factor, y * factor + i / factor, channel);
        }
        coarse.At(x, y, channel) = static_cast<float>(sum / (factor * factor));
      }
    }
  }
  return coarse;
}

Rgb PixelOf(const Image<float>& image, int x, int y) {
  return {image.At(x, y, 0), image.At(x, y, 1), image.At(x, y, 2)};
}

}  // namespace

SkyMap::SkyMap(const Image<float>& radiance, double rotation_rad)
    : radiance_(Coarser(radiance, (radiance.WidthPx() + kMaxWidthPx - 1) / kMaxWidthPx)),
      rotation_rad_(rotation_rad) {
  PFSEQ_CHECK(radiance.NumChannels() == 3 && radiance.WidthPx() == 2 * radiance.HeightPx(),
              "{} x {} x {}",
              radiance.WidthPx(),
              radiance.HeightPx(),
              radiance.NumChannels());
  TakeOutSun();
}

SkyMap SkyMap::Read(const std::filesystem::path& path, double rotation_rad) {
  Image<float> radiance = ReadHdrRgb(path);
  const int width_px = radiance.WidthPx();
  if (width_px != 2 * radiance.HeightPx() || width_px < kMinWidthPx || width_px > kMaxFilePx) {
    throw InputError(
        "{}: expected a latitude-longitude image, twice as wide as high, {} to {} px wide; it has "
        "{} x {} px",
        path.string(),
        kMinWidthPx,
        kMaxFilePx,
        width_px,
        radiance.HeightPx());
  }
  for (size_t i = 0; i < radiance.Values().size(); ++i) {
    float& value = radiance.Values()[i];
    if (!std::isfinite(value)) {
      const auto pixel = static_cast<int>(i / 3);
      throw InputError("{}: expected finite radiance, got {} at pixel {},{}",
                       path.string(),
                       value,
                       pixel % width_px,
                       pixel / width_px);
    }
    value = std::max(value, 0.0F);
  }
  return {radiance, rotation_rad};
}

Vec3d SkyMap::DirectionOf(int column, int row) const {
  const double azimuth_rad =
      std::numbers::pi * (1.0 - 2.0 * (column + 0.5) / radiance_.WidthPx()) + rotation_rad_;
  const double zenith_rad = std::numbers::pi * (row + 0.5) / radiance_.HeightPx();
  return {std::sin(zenith_rad) * std::cos(azimuth_rad),
          std::sin(zenith_rad) * std::sin(azimuth_rad),
          std::cos(zenith_rad)};
}

double SkyMap::PixelSolidAngle(int row) const {
  const double height_rad = std::numbers::pi / radiance_.HeightPx();
  return (std::cos(row * height_rad) - std::cos((row + 1) * height_rad)) * 2.0 * std::numbers::pi /
         radiance_.WidthPx();
}

Rgb SkyMap::Radiance(const Vec3d& direction) const {
  const int width_px = radiance_.WidthPx();
  const int height_px = radiance_.HeightPx();
  const double azimuth_rad = std::atan2(direction.y(), direction.x()) - rotation_rad_;
  double turn = 0.5 - 0.5 * std::numbers::inv_pi * azimuth_rad;
  turn -= std::floor(turn);
  const double horizontal = std::hypot(direction.x(), direction.y());
  const double zenith_rad = std::atan2(horizontal, direction.z());
  // Pixel centres are at .5; rows end at the poles, columns go around.
  const double x = turn * width_px - 0.5;
  const double y = std::clamp(
      zenith_rad * std::numbers::inv_pi * height_px - 0.5, 0.0, static_cast<double>(height_px - 1));
  const auto column = static_cast<int>(std::floor(x));
  const int left = (column + width_px) % width_px;
  const int right = (column + 1) % width_px;
  const auto top = static_cast<int>(y);
  const int bottom = std::min(top + 1, height_px - 1);
  const auto dx = static_cast<float>(x - column);
  const auto dy = static_cast<float>(y - top);
  const Rgb above =
      (1.0F - dx) * PixelOf(radiance_, left, top) + dx * PixelOf(radiance_, right, top);
  const Rgb below =
      (1.0F - dx) * PixelOf(radiance_, left, bottom) + dx * PixelOf(radiance_, right, bottom);
  return (1.0F - dy) * above + dy * below;
}

void SkyMap::TakeOutSun() {
  const int width_px = radiance_.WidthPx();
  const int num_rows = radiance_.HeightPx() / 2;
  std::vector<float> luminances;
  int peak_x = 0;
  int peak_y = 0;
  float peak = -1.0F;
  for (int y = 0; y < num_rows; ++y) {
    for (int x = 0; x < width_px; ++x) {
      luminances.push_back(Luminance(PixelOf(radiance_, x, y)));
      if (luminances.back() > peak) {
        peak = luminances.back();
        peak_x = x;
        peak_y = y;
      }
    }
  }
  if (luminances.empty()) {
    return;
  }
  const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  if (peak <= kSunContrast * *middle) {
    return;
  }

  // Of each pixel near the peak, by its angle to it; the ring's mean weighs by solid angle.
  const Vec3d toward_peak = DirectionOf(peak_x, peak_y);
  Eigen::Array3d ring_sum = Eigen::Array3d::Zero();
  double ring_solid_angle = 0.0;
  for (int y = 0; y < num_rows; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const double cos_angle = DirectionOf(x, y).dot(toward_peak);
      if (cos_angle > std::cos(kRingRadiusRad) && cos_angle < std::cos(kSunRadiusRad)) {
        ring_sum += PixelSolidAngle(y) * PixelOf(radiance_, x, y).cast<double>();
        ring_solid_angle += PixelSolidAngle(y);
      }
    }
  }
  if (ring_solid_angle <= 0.0) {
    return;
  }
  const Rgb ring = (ring_sum / ring_solid_angle).cast<float>();
  const float least = kGlowContrast * Luminance(ring);

  Eigen::Array3d irradiance = Eigen::Array3d::Zero();
  Vec3d centre = Vec3d::Zero();
  std::vector<std::pair<int, int>> open = {{peak_x, peak_y}};
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    const Rgb pixel = PixelOf(radiance_, x, y);
    const Vec3d direction = DirectionOf(x, y);
    if (Luminance(pixel) <= least || direction.dot(toward_peak) < std::cos(kSunRadiusRad)) {
      continue;
    }
    const Rgb excess = (pixel - ring).max(0.0F);
    irradiance += PixelSolidAngle(y) * excess.cast<double>();
    centre += PixelSolidAngle(y) * Luminance(excess) * direction;
    for (int channel = 0; channel < 3; ++channel) {
      radiance_.At(x, y, channel) = ring[channel];
    }
    for (int i = 0; i < 9; ++i) {
      const int next_y = y + i / 3 - 1;
      if (next_y >= 0 && next_y < num_rows) {
        open.emplace_back((x + i % 3 - 1 + width_px) % width_px, next_y);
      }
    }
  }
  if (irradiance.maxCoeff() > 0.0 && centre.norm() > 0.0) {
    sun_ = MapSun{centre.normalized(), irradiance.cast<float>()};
  }
}

}  // namespace pfseq
