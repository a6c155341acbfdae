// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/random.h"
#include "scenes/canyon/fractal_tile.h"
#include "scenes/canyon/wall_painting.h"

#include <cmath>

namespace pfseq {
namespace {

constexpr double kSpotsPerM2 = 25.0;
constexpr double kLeastRadius_m = 0.012;
constexpr double kMostRadius_m = 0.05;

/// One spot: an ellipse with a ragged, soft edge. Negative tones darken, positive ones bleach.
void PaintSpot(
    const Vec2d& center_m, const Vec2d& half_m, double tone, uint64_t offset, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const Vec2d reach_m = 1.6 * half_m;
  canvas.ForEach(
      center_m - reach_m, center_m + reach_m, [&](WallTexel& texel, const Vec2d& point_m) {
        const double ragged = 0.25 * fractal.At(point_m.x(), point_m.y(), 0.008, offset);
        const double from = (point_m - center_m).cwiseQuotient(half_m).norm() + ragged;
        const double cover = Ramp(1.2, 0.6, from);
        if (tone < 0.0) {
          texel.color *= static_cast<float>(1.0 + tone * cover);
          texel.height_m -= static_cast<float>(0.002 * cover);
        } else {
          texel.color = MixColor(texel.color, Rgb(0.90F, 0.88F, 0.84F), tone * cover);
        }
      });
}

}  // namespace

void PaintSpots(const WallPainting& painting, WallCanvas& canvas) {
  RandomStream random({painting.look.seed, 54});
  const Vec2d low_m = canvas.LowM();
  const Vec2d size_m = canvas.HighM() - low_m;
  const double density = kSpotsPerM2 * random.Uniform(0.5, 1.5);
  const auto count = static_cast<int>(density * size_m.x() * size_m.y());
  for (int i = 0; i < count; ++i) {
    const double u = random.Uniform();
    const Vec2d center_m = low_m + Vec2d(u * size_m.x(), random.Uniform() * size_m.y());
    // Most are small and faint.
    const double share = random.Uniform();
    const double radius_m = kLeastRadius_m + (kMostRadius_m - kLeastRadius_m) * share * share;
    const double aspect = random.Uniform(0.7, 1.4);
    const double faint = random.Uniform();
    const double strength = 0.06 + 0.4 * faint * faint;
    const double tone = random.Chance(0.7) ? -strength : 0.8 * strength;
    PaintSpot(center_m, {radius_m * aspect, radius_m / aspect}, tone, random.Bits() % 347, canvas);
  }
}

}  // namespace pfseq
