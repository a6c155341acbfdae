// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/random.h"
#include "scenes/canyon/fractal_tile.h"
#include "scenes/canyon/wall_painting.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

constexpr double kArchHeight_m = 0.25;
constexpr double kVoussoir_m = 0.077;
/// Voussoirs lean outwards by this much of their distance from the middle, each metre up.
constexpr double kLean = 0.45;
constexpr double kQuoinHeight_m = 0.34;

/// Bricks on end above an opening, fanning out.
void PaintFlatArch(const WallPainting& painting, const WallRect& opening, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const WallLook& look = painting.look;
  const Vec2d head_m(0.5 * (opening.low_m.x() + opening.high_m.x()), opening.high_m.y());
  const double half_m = 0.5 * (opening.high_m.x() - opening.low_m.x()) + 0.06;
  const double reach_m = half_m * (1.0 + kLean * kArchHeight_m);
  const Rgb mortar = MixColor(look.color, Rgb(0.93F, 0.90F, 0.84F), 0.55) * 0.72F;
  const double soft_m = std::max(0.003, 0.5 * canvas.TexelM());
  canvas.ForEach(head_m - Vec2d(reach_m, 0.0),
                 head_m + Vec2d(reach_m, kArchHeight_m),
                 [&](WallTexel& texel, const Vec2d& point_m) {
                   const double up_m = point_m.y() - head_m.y();
                   const double across_m = (point_m.x() - head_m.x()) / (1.0 + kLean * up_m);
                   if (std::abs(across_m) > half_m) {
                     return;
                   }
                   const double along = across_m / kVoussoir_m + 0.5;
                   const double column = std::floor(along);
                   const uint64_t key = HashKey({look.seed,
                                                 70,
                                                 static_cast<uint64_t>(static_cast<int64_t>(
                                                     column + 1000.0 * head_m.x()))});
                   const double in_m = (along - column) * kVoussoir_m;
                   const double rim_m = std::min(std::min(in_m, kVoussoir_m - in_m),
                                                 std::min(up_m, kArchHeight_m - up_m));
                   const double fine = fractal.At(
                       point_m.x(), point_m.y(), std::min(canvas.TexelM(), 0.012), look.seed % 89);
                   const double tone = 0.86 + 0.3 * UniformFromHash(key) + 0.05 * fine;
                   const double face = Ramp(0.0045 - soft_m, 0.0045 + soft_m, rim_m + 0.001 * fine);
                   texel.color = MixColor(mortar, look.color * static_cast<float>(tone), face);
                   texel.height_m = static_cast<float>(0.007 * face + 0.0012 * fine * face);
                 });
}

/// Long and short stones in turn up one end of the wall; `inward` is +1 at its left end, -1 at its
/// right one.
void PaintQuoins(const WallPainting& painting, double end_m, double inward, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const uint64_t seed = HashKey({painting.look.seed, 71});
  const bool is_brick = painting.look.surface == WallSurface::kBrick;
  const Rgb stone = is_brick ? Rgb(0.80F, 0.76F, 0.68F)
                             : MixColor(painting.look.color, Rgb(0.88F, 0.85F, 0.78F), 0.6) * 0.92F;
  const double reach_m = 0.5;
  const double low_u_m = inward > 0.0 ? end_m : end_m - reach_m;
  canvas.ForEach(
      {low_u_m, canvas.LowM().y()},
      {low_u_m + reach_m, canvas.HighM().y()},
      [&](WallTexel& texel, const Vec2d& point_m) {
        const double from_end_m = (point_m.x() - end_m) * inward;
        const double course = std::floor(point_m.y() / kQuoinHeight_m);
        const auto row = static_cast<uint64_t>(static_cast<int64_t>(course));
        const double length_m = (row & 1U) != 0 ? 0.46 : 0.30;
        const double up_m = point_m.y() - course * kQuoinHeight_m;
        const double rim_m =
            std::min(length_m - from_end_m, std::min(up_m, kQuoinHeight_m - up_m));
        if (rim_m < 0.0) {
          return;
        }
        const double fine =
            fractal.At(point_m.x(), point_m.y(), std::max(0.008, canvas.TexelM()), seed % 89);
        const double broad = fractal.At(point_m.x(), point_m.y(), 0.04, seed % 97);
        const double face = Ramp(0.004, 0.016, rim_m + 0.003 * fine);
        const double tone = (0.9 + 0.16 * UniformFromHash(HashKey({seed, row}))) *
                            (0.62 + 0.38 * face) * (1.0 + 0.05 * broad + 0.04 * fine);
        texel.color = stone * static_cast<float>(tone);
        texel.height_m = static_cast<float>(0.02 * face + 0.0015 * fine);
      });
}

}  // namespace

void PaintDressings(const WallPainting& painting, WallCanvas& canvas) {
  if (painting.has_flat_arches) {
    for (const WallRect& opening : painting.openings) {
      PaintFlatArch(painting, opening, canvas);
    }
  }
  if (painting.has_quoins) {
    PaintQuoins(painting, painting.area.low_m.x(), 1.0, canvas);
    PaintQuoins(painting, painting.area.high_m.x(), -1.0, canvas);
  }
}

}  // namespace pfseq
