// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_surface.h"

#include "renderer/core/random.h"
#include "scenes/canyon/fractal_tile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfseq {
namespace {

Rgb Scaled(const Rgb& color, double factor) { return color * static_cast<float>(factor); }

/// Warmer for positive amounts, cooler for negative ones.
Rgb Warmed(const Rgb& color, double amount) {
  const auto a = static_cast<float>(amount);
  return color * Rgb(1.0F + a, 1.0F, 1.0F - 1.3F * a);
}

double Draw(uint64_t key, uint64_t which) { return UniformFromHash(HashKey({key, which})); }

/// The unit of masonry that a point lies in.
struct Unit {
  uint64_t key = 0;
  /// Distance to the nearest edge.
  double rim_m = 0.0;
  /// Position in the unit, 0 to 1, up.
  double up = 0.0;
};

Unit UnitAt(double u_m, double v_m, double length_m, double height_m, double shift, uint64_t seed) {
  const double course = std::floor(v_m / height_m);
  const double along = u_m / length_m + shift;
  const double column = std::floor(along);
  Unit unit;
  unit.key = HashKey({seed,
                      static_cast<uint64_t>(static_cast<int64_t>(course)),
                      static_cast<uint64_t>(static_cast<int64_t>(column))});
  const double across_m = (along - column) * length_m;
  unit.up = v_m / height_m - course;
  const double rise_m = unit.up * height_m;
  unit.rim_m =
      std::min(std::min(across_m, length_m - across_m), std::min(rise_m, height_m - rise_m));
  return unit;
}

constexpr double kBrickLength_m = 0.24;
constexpr double kCourse_m = 0.077;

/// Stretcher, header courses every sixth, English cross or Flemish bond.
Unit BrickAt(const Brickwork& work, double u_m, double v_m) {
  const auto course = static_cast<int64_t>(std::floor(v_m / kCourse_m));
  const bool is_odd = (course & 1) != 0;
  const uint64_t seed = work.seed;
  switch (work.bond) {
    case 0:
      return UnitAt(u_m, v_m, kBrickLength_m, kCourse_m, is_odd ? 0.5 : 0.0, seed);
    case 1:
      return course % 6 == 0
                 ? UnitAt(u_m, v_m, 0.5 * kBrickLength_m, kCourse_m, 0.25, seed)
                 : UnitAt(u_m, v_m, kBrickLength_m, kCourse_m, is_odd ? 0.5 : 0.0, seed);
    case 2:
      return is_odd
                 ? UnitAt(u_m, v_m, 0.5 * kBrickLength_m, kCourse_m, 0.5, seed)
                 : UnitAt(u_m, v_m, kBrickLength_m, kCourse_m, (course & 2) != 0 ? 0.5 : 0.0, seed);
    default: {
      // Flemish: stretcher and header in turn, a period of one and a half bricks.
      const double period_m = 1.5 * kBrickLength_m;
      Unit unit = UnitAt(u_m, v_m, period_m, kCourse_m, is_odd ? 0.5 : 0.0, seed);
      const double along = u_m / period_m + (is_odd ? 0.5 : 0.0);
      const double in_m = (along - std::floor(along)) * period_m;
      const bool is_header = in_m > kBrickLength_m;
      unit.key = HashKey({unit.key, is_header ? 1U : 0U});
      unit.rim_m = std::min(unit.rim_m, std::abs(in_m - kBrickLength_m));
      return unit;
    }
  }
}

void PaintPlaster(const WallLook& look, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const double trowel = 0.4 + Draw(look.seed, 10);
  const double unevenness = 0.022 + 0.05 * look.age * Draw(look.seed, 11);
  const bool is_coarse = Draw(look.seed, 12) < 0.4;
  canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& point_m) {
    const double u = point_m.x();
    const double v = point_m.y();
    const double broad = fractal.At(u, v, 0.045, look.seed % 97);
    const double fine = fractal.At(u, v, canvas.TexelM() * 0.9, look.seed % 89 + 100);
    // Lifts of plaster, one day's work each, differ a little.
    const double lift = fractal.At(0.15 * u, v + 0.2 * broad, 0.02, look.seed % 83 + 30);
    const double tone = 1.0 + unevenness * broad + (is_coarse ? 0.12 : 0.09) * fine + 0.014 * lift;
    texel.color = Warmed(Scaled(look.color, tone), 0.012 * broad);
    texel.height_m =
        static_cast<float>((is_coarse ? 0.0026 : 0.0011) * fine + 0.0015 * trowel * broad);
  });
}

void PaintAshlar(const WallLook& look, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const double height_m = 0.34 + 0.14 * Draw(look.seed, 20);
  const double length_m = height_m * (1.7 + 0.8 * Draw(look.seed, 21));
  const bool is_rusticated = Draw(look.seed, 22) < 0.35;
  const double joint_m = is_rusticated ? 0.022 : 0.008;
  canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& point_m) {
    const double u = point_m.x();
    const double v = point_m.y();
    const auto course = static_cast<int64_t>(std::floor(v / height_m));
    // Courses have stones of different lengths.
    const double stretch = 0.8 + 0.45 * Draw(look.seed, 500 + static_cast<uint64_t>(course & 255));
    const Unit stone =
        UnitAt(u, v, length_m * stretch, height_m, (course & 1) != 0 ? 0.5 : 0.08, look.seed);
    const double broad = fractal.At(u, v, 0.04, look.seed % 97);
    const double fine = fractal.At(u, v, canvas.TexelM(), look.seed % 89 + 100);
    const double vein = fractal.At(0.35 * u + 40.0 * Draw(stone.key, 3), 1.6 * v, 0.008, 61);
    const double tone = 0.87 + 0.26 * Draw(stone.key, 1) + 0.05 * broad + 0.1 * fine + 0.03 * vein;
    const double soft_m = std::max(0.004, 0.6 * canvas.TexelM());
    const double ragged_m = stone.rim_m + 0.002 * fine;
    const double face = Ramp(0.5 * joint_m - 0.5 * soft_m, 0.5 * joint_m + soft_m, ragged_m);
    const Rgb stone_color =
        Warmed(Scaled(look.color, tone), 0.05 * (Draw(stone.key, 2) - 0.5) + 0.01 * broad);
    const Rgb joint = Scaled(look.color, is_rusticated ? 0.55 : 0.72);
    texel.color = MixColor(joint, stone_color, face);
    // Where a corner has been knocked off.
    if (Draw(stone.key, 4) < 0.12 && stone.rim_m < 0.03 + 0.012 * fine) {
      texel.color = Scaled(texel.color, 0.86);
      texel.height_m -= 0.004F;
    }
    texel.height_m += static_cast<float>((is_rusticated ? 0.02 : 0.006) * face + 0.0012 * fine +
                                         0.002 * (Draw(stone.key, 5) - 0.5));
  });
}

void PaintConcrete(const WallLook& look, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const double panel_m = 2.4 + 1.6 * Draw(look.seed, 30);
  const double rise_m = 2.9 + 0.5 * Draw(look.seed, 31);
  const bool has_boards = Draw(look.seed, 32) < 0.45;
  const bool is_washed = !has_boards && Draw(look.seed, 33) < 0.5;
  canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& point_m) {
    const double u = point_m.x();
    const double v = point_m.y();
    const Unit panel = UnitAt(u, v, panel_m, rise_m, 0.0, look.seed);
    const double broad = fractal.At(u, v, 0.03, look.seed % 97);
    const double fine = fractal.At(u, v, canvas.TexelM() * 0.8, look.seed % 89 + 100);
    double tone =
        0.93 + 0.11 * Draw(panel.key, 1) + 0.055 * broad + (is_washed ? 0.12 : 0.08) * fine;
    double height_m = (is_washed ? 0.003 : 0.0008) * fine;
    if (has_boards) {
      const Unit board = UnitAt(v, u, 40.0, 0.14, 0.0, HashKey({look.seed, 7}));
      tone += 0.06 * (Draw(board.key, 1) - 0.5);
      const double edge = 1.0 - Ramp(0.002, std::max(0.006, canvas.TexelM()), board.rim_m);
      tone -= 0.08 * edge;
      height_m += 0.003 * (Draw(board.key, 2) - 0.5) - 0.002 * edge;
    }
    // Holes of the formwork's ties.
    const double tie_u = u - 1.2 * std::round(u / 1.2);
    const double tie_v = v - 1.4 * std::round(v / 1.4);
    const double tie_m = std::sqrt(tie_u * tie_u + tie_v * tie_v);
    const double hole = is_washed ? 0.0 : 1.0 - Ramp(0.016, 0.016 + canvas.TexelM(), tie_m);
    const double joint = 1.0 - Ramp(0.006, 0.006 + canvas.TexelM(), panel.rim_m);
    texel.color = Scaled(Warmed(Scaled(look.color, tone), 0.012 * broad),
                         (1.0 - 0.55 * joint) * (1.0 - 0.5 * hole));
    texel.height_m = static_cast<float>(height_m - 0.015 * joint - 0.01 * hole);
  });
}

/// The field stone that a point lies in: a cell of Worley's noise (Worley 1996, "A cellular texture
/// basis function"), of which larger stones take more; its position in the stone is left out.
Unit RubbleAt(double u_m, double v_m, uint64_t seed) {
  constexpr double kStone_m = 0.4;
  const double u = u_m / kStone_m;
  const double v = v_m / kStone_m;
  const auto column = static_cast<int64_t>(std::floor(u));
  const auto row = static_cast<int64_t>(std::floor(v));
  double nearest = std::numeric_limits<double>::max();
  double second = nearest;
  Unit unit;
  for (int64_t j = row - 1; j <= row + 1; ++j) {
    for (int64_t i = column - 1; i <= column + 1; ++i) {
      const uint64_t key = HashKey({seed, static_cast<uint64_t>(i), static_cast<uint64_t>(j)});
      const Vec2d from(u - (static_cast<double>(i) + 0.3 + 0.4 * Draw(key, 1)),
                       v - (static_cast<double>(j) + 0.3 + 0.4 * Draw(key, 2)));
      const double distance = from.norm() - 0.1 * Draw(key, 3);
      if (distance < nearest) {
        second = nearest;
        nearest = distance;
        unit.key = key;
      } else if (distance < second) {
        second = distance;
      }
    }
  }
  unit.rim_m = 0.5 * (second - nearest) * kStone_m;
  return unit;
}

/// Brightness of a field stone: most come from one quarry, one in ten from elsewhere.
double RubbleTone(uint64_t stone_key) {
  const double origin = Draw(stone_key, 6);
  const double rock = origin < 0.06 ? 0.15 : origin > 0.96 ? 1.6 : 1.0;
  return rock * (0.9 + 0.2 * Draw(stone_key, 4));
}

/// Field stones in pale mortar; the odd black or pale one makes each place unlike the others.
void PaintRubble(const WallLook& look, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const double half_joint_m = 0.01;
  const double soft_m = std::max(0.004, 0.6 * canvas.TexelM());
  const Rgb mortar = Scaled(look.color, 1.05);
  canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& point_m) {
    const double u = point_m.x();
    const double v = point_m.y();
    const Unit stone = RubbleAt(u, v, look.seed);
    const double fine = fractal.At(u, v, canvas.TexelM(), look.seed % 89 + 100);
    const double face =
        Ramp(half_joint_m - 0.5 * soft_m, half_joint_m + soft_m, stone.rim_m + 0.003 * fine);
    const double tone = RubbleTone(stone.key) + 0.08 * fine;
    const Rgb color = Warmed(Scaled(look.color, tone), 0.1 * (Draw(stone.key, 5) - 0.5));
    texel.color = MixColor(mortar, color, face);
    texel.height_m = static_cast<float>(0.006 * face + 0.0012 * fine);
  });
}

}  // namespace

Brickwork::Brickwork(const WallLook& look)
    : color(look.color),
      seed(HashKey({look.seed, 2})),
      bond(static_cast<int>(4.0 * Draw(look.seed, 1))),
      spread(0.26 + 0.30 * Draw(look.seed, 3)),
      mortar_tone(0.55 + 0.25 * Draw(look.seed, 4)) {}

void Brickwork::Paint(WallTexel& texel, const Vec2d& point_m, double texel_m) const {
  const FractalTile& fractal = SharedFractal();
  const double u = point_m.x();
  const double v = point_m.y();
  const double fine = fractal.At(u, v, std::min(texel_m, 0.012), seed % 89 + 100);
  const double broad = fractal.At(u, v, 0.05, seed % 97);
  const Unit brick = BrickAt(*this, u + 0.002 * fine, v + 0.001 * fine);
  double tone = 1.0 + spread * (Draw(brick.key, 1) - 0.5) + 0.09 * fine + 0.04 * broad;
  double warm = 0.16 * (Draw(brick.key, 2) - 0.45);
  const double odd = Draw(brick.key, 3);
  if (odd < 0.05) {
    tone *= 0.62;  // burnt
    warm -= 0.06;
  } else if (odd > 0.965) {
    tone *= 1.22;  // replaced, or pale from salts
  }
  const Rgb face_color = Warmed(Scaled(color, tone), warm);
  const Rgb mortar = MixColor(Scaled(color, 0.9), Rgb(0.93F, 0.90F, 0.84F), 0.75) *
                     static_cast<float>(mortar_tone + 0.07 * fine + 0.03 * broad);
  const double half_joint_m = 0.0055;
  const double soft_m = std::max(0.0035, 0.55 * texel_m);
  const double face =
      Ramp(half_joint_m - 0.6 * soft_m, half_joint_m + 0.6 * soft_m, brick.rim_m + 0.0012 * fine);
  texel.color = MixColor(mortar, face_color, face);
  texel.height_m = static_cast<float>(0.007 * face + 0.0012 * fine * face +
                                      0.0025 * (Draw(brick.key, 5) - 0.5) * face);
  texel.roughness = 0.92F;
}

void PaintSurface(const WallLook& look, WallCanvas& canvas) {
  const Brickwork bricks(look);
  switch (look.surface) {
    case WallSurface::kPlaster:
      PaintPlaster(look, canvas);
      break;
    case WallSurface::kBrick:
      canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& point_m) {
        bricks.Paint(texel, point_m, canvas.TexelM());
      });
      break;
    case WallSurface::kAshlar:
      PaintAshlar(look, canvas);
      break;
    case WallSurface::kConcrete:
      PaintConcrete(look, canvas);
      break;
    case WallSurface::kRubble:
      PaintRubble(look, canvas);
      break;
  }
}

}  // namespace pfseq
