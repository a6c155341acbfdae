// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/glare.h"

#include "renderer/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pfseq {
namespace {

constexpr std::array<double, 3> kWidths = {0.5, 1.0, 2.0};
/// Half of the light of the three Gaussians of unit mean width falls within this radius: the root
/// of the mean of 1 - exp(-r^2 / 2 w^2) over the widths = 1/2.
constexpr double kHalfLightRadius = 1.0956;
/// Gaussians are convolved on a raster whose pixels are at most this share of their width.
constexpr double kPixelShare = 0.35;
constexpr double kCutoffSigmas = 4.0;

/// Sums of factor x factor pixels.
Image<float> Reduced(const Image<float>& image, int factor, int num_threads) {
  const int width = (image.WidthPx() + factor - 1) / factor;
  const int height = (image.HeightPx() + factor - 1) / factor;
  Image<float> reduced(width, height, 3);
  ParallelFor(static_cast<size_t>(height), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int j = y * factor; j < std::min((y + 1) * factor, image.HeightPx()); ++j) {
      for (int i = 0; i < image.WidthPx(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
          reduced.At(i / factor, y, channel) += image.At(i, j, channel);
        }
      }
    }
  });
  return reduced;
}

/// Convolution along one axis with a Gaussian, in pixels; nothing comes from beyond the edges.
Image<float> Convolved(const Image<float>& image, double sigma, bool along_x, int num_threads) {
  const int reach = static_cast<int>(std::ceil(kCutoffSigmas * sigma));
  std::vector<float> weights;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))));
    sum += weights.back();
  }
  for (float& weight : weights) {
    weight = static_cast<float>(weight / sum);
  }
  Image<float> result(image.WidthPx(), image.HeightPx(), 3);
  const int length = along_x ? image.WidthPx() : image.HeightPx();
  ParallelFor(static_cast<size_t>(image.HeightPx()), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < image.WidthPx(); ++x) {
      const int place = along_x ? x : y;
      Rgb value = Rgb::Zero();
      for (int i = std::max(-reach, -place); i <= std::min(reach, length - 1 - place); ++i) {
        const float weight = weights[static_cast<size_t>(i + reach)];
        const int from_x = along_x ? x + i : x;
        const int from_y = along_x ? y : y + i;
        for (int channel = 0; channel < 3; ++channel) {
          value[channel] += weight * image.At(from_x, from_y, channel);
        }
      }
      for (int channel = 0; channel < 3; ++channel) {
        result.At(x, y, channel) = value[channel];
      }
    }
  });
  return result;
}

/// Adds `share` of the reduced image's light, linear between its pixels.
void AddEnlarged(
    const Image<float>& reduced, int factor, float share, Image<float>& image, int num_threads) {
  const float scale = share / static_cast<float>(factor * factor);
  ParallelFor(static_cast<size_t>(image.HeightPx()), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(factor) - 0.5F;
    const int y0 = static_cast<int>(std::floor(v));
    for (int x = 0; x < image.WidthPx(); ++x) {
      const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(factor) - 0.5F;
      const int x0 = static_cast<int>(std::floor(u));
      for (int corner = 0; corner < 4; ++corner) {
        const int cx = x0 + corner % 2;
        const int cy = y0 + corner / 2;
        const float weight = scale * (1.0F - std::abs(u - static_cast<float>(cx))) *
                             (1.0F - std::abs(v - static_cast<float>(cy)));
        const int from_x = std::clamp(cx, 0, reduced.WidthPx() - 1);
        const int from_y = std::clamp(cy, 0, reduced.HeightPx() - 1);
        for (int channel = 0; channel < 3; ++channel) {
          image.At(x, y, channel) += weight * reduced.At(from_x, from_y, channel);
        }
      }
    }
  });
}

}  // namespace

Glare::Glare(const GlareSpec& spec, const Lens& lens)
    : spec_(spec),
      principal_point_px_(lens.PrincipalPointPx()),
      circle_radius_px_(0.5 * lens.CirclePx()) {}

void Glare::Apply(Image<float>& radiance, int num_threads) const {
  const Image<float> source = radiance;
  const auto kept = static_cast<float>(1.0 - spec_.bloom - spec_.veil);
  for (float& value : radiance.Values()) {
    value *= kept;
  }
  if (spec_.bloom > 0.0) {
    for (const double width : kWidths) {
      const double sigma_px = width * spec_.bloom_radius_px / kHalfLightRadius;
      const int factor = std::max(1, static_cast<int>(kPixelShare * sigma_px));
      // Summing and enlarging widen the halo by 1/12 + 1/6 of a pixel's square.
      const double widened = factor > 1 ? 0.25 : 0.0;
      const double sigma = std::sqrt(sigma_px * sigma_px / (factor * factor) - widened);
      const Image<float> reduced = Reduced(source, factor, num_threads);
      const Image<float> halo =
          Convolved(Convolved(reduced, sigma, true, num_threads), sigma, false, num_threads);
      AddEnlarged(
          halo, factor, static_cast<float>(spec_.bloom / kWidths.size()), radiance, num_threads);
    }
  }
  if (spec_.veil > 0.0) {
    Eigen::Array3d light = Eigen::Array3d::Zero();
    double num_pixels = 0.0;
    const auto is_inside = [&](int x, int y) {
      return (Vec2d(x + 0.5, y + 0.5) - principal_point_px_).norm() <= circle_radius_px_;
    };
    for (int y = 0; y < source.HeightPx(); ++y) {
      for (int x = 0; x < source.WidthPx(); ++x) {
        num_pixels += is_inside(x, y) ? 1.0 : 0.0;
        for (int channel = 0; channel < 3; ++channel) {
          light[channel] += source.At(x, y, channel);
        }
      }
    }
    const Rgb veil = (spec_.veil * light / std::max(1.0, num_pixels)).cast<float>();
    for (int y = 0; y < source.HeightPx(); ++y) {
      for (int x = 0; x < source.WidthPx(); ++x) {
        for (int channel = 0; channel < 3 && is_inside(x, y); ++channel) {
          radiance.At(x, y, channel) += veil[channel];
        }
      }
    }
  }
}

}  // namespace pfseq
