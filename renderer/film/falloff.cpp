// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/falloff.h"

#include "renderer/core/parallel.h"

#include <algorithm>

namespace pfseq {
namespace {

double Smoothstep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

Falloff::Falloff(const OpticsSpec& spec, const Lens& lens)
    : vignetting_(spec.vignetting),
      rim_(spec.rim),
      principal_point_px_(lens.PrincipalPointPx()),
      circle_radius_px_(0.5 * lens.CirclePx()) {}

Rgb Falloff::At(double height_px) const {
  const double rho = height_px / circle_radius_px_;
  const double start = vignetting_.mechanical_start;
  const double common = std::max(0.0, 1.0 - vignetting_.natural * rho * rho) *
                        (1.0 - vignetting_.mechanical * Smoothstep((rho - start) / (1.0 - start)));
  Rgb share = Rgb::Constant(static_cast<float>(common));
  if (rim_.width_px > 0.0) {
    for (int channel = 0; channel < 3; ++channel) {
      const double width_px = rim_.reach[static_cast<size_t>(channel)] * rim_.width_px;
      const double left_px = circle_radius_px_ - rim_.width_px + width_px - height_px;
      share[channel] *= width_px > 0.0 ? static_cast<float>(Smoothstep(left_px / width_px))
                                       : (left_px > 0.0 ? 1.0F : 0.0F);
    }
  }
  return share;
}

void Falloff::Apply(Image<float>& radiance, int num_threads) const {
  ParallelFor(static_cast<size_t>(radiance.HeightPx()), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < radiance.WidthPx(); ++x) {
      const Rgb share = At((Vec2d(x + 0.5, y + 0.5) - principal_point_px_).norm());
      for (int channel = 0; channel < 3; ++channel) {
        radiance.At(x, y, channel) *= share[channel];
      }
    }
  });
}

}  // namespace pfseq
