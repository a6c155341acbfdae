// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/random.h"
#include "scenes/canyon/fractal_tile.h"
#include "scenes/canyon/wall_painting.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

/// Soot in broad clouds, under the eave and where the street splashes.
void PaintSoot(const WallPainting& painting, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const uint64_t seed = painting.look.seed;
  const double age = painting.look.age;
  RandomStream random({seed, 50});
  const double cloud = age * random.Uniform(0.06, 0.2);
  const double eave = age * random.Uniform(0.15, 0.5);
  const double splash = random.Uniform(0.25, 0.6);
  const double damp_m = random.Chance(0.4) ? random.Uniform(0.4, 1.1) : 0.0;
  canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& point_m) {
    const double u = point_m.x();
    const double v = point_m.y();
    const double broad = fractal.At(u, v, 0.035, seed % 79 + 200);
    const double upright = fractal.At(u, 0.12 * v, 0.02, seed % 73 + 300);
    const double rise_m = v - painting.pavement_m;
    const double drop_m = painting.eave_m - v;
    double dirt = cloud * std::max(0.0, 0.5 + broad) + 0.25 * cloud * std::max(0.0, upright);
    if (drop_m < 5.0) {
      dirt += eave * std::exp(-drop_m / (0.5 + 0.25 * std::abs(upright))) * (0.8 + 0.3 * broad);
    }
    if (rise_m < 2.0) {
      dirt += splash * std::exp(-rise_m / 0.28) * (0.9 + 0.35 * broad);
      // Rising damp ends in a ragged line.
      const double edge_m = damp_m * (1.0 + 0.35 * broad);
      dirt += damp_m > 0.0 ? 0.22 * Ramp(0.06, -0.02, rise_m - edge_m) : 0.0;
    }
    texel.dirt += static_cast<float>(dirt);
  });
}

/// Rain runs down from a ledge, most at its ends, and leaves what it carries.
void PaintStreaks(const Ledge& ledge, double strength, uint64_t seed, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  RandomStream random(seed);
  const double length_m = random.Uniform(0.35, 1.5);
  const double ends = random.Uniform(0.4, 1.2);
  const uint64_t offset = seed % 401;
  const Vec2d low_m(ledge.left_m - 0.02, ledge.level_m - 3.2 * length_m);
  canvas.ForEach(
      low_m, {ledge.right_m + 0.02, ledge.level_m}, [&](WallTexel& texel, const Vec2d& point_m) {
        const double u = point_m.x();
        const double drop_m = ledge.level_m - point_m.y();
        const double run = fractal.At(u, 0.02 * drop_m, 0.013, offset);
        const double end_m = std::min(std::abs(u - ledge.left_m), std::abs(u - ledge.right_m));
        const double wet = std::max(0.0, 0.25 + 0.45 * run) + ends * std::exp(-end_m / 0.05);
        const double reach_m = length_m * (0.55 + 0.4 * std::max(0.0, run + 0.5));
        const double fade = std::exp(-drop_m / reach_m) * Ramp(0.0, 0.02, drop_m);
        texel.dirt += static_cast<float>(strength * wet * fade);
      });
}

/// A crack that wanders from a point; hair-fine, with a lighter lower edge.
void PaintCrack(
    const Vec2d& from_m, double heading_rad, double length_m, uint64_t seed, WallCanvas& canvas) {
  RandomStream random(seed);
  Vec2d at_m = from_m;
  double left_m = length_m;
  const double start_rad = heading_rad;
  while (left_m > 0.0) {
    heading_rad = start_rad + 0.6 * (heading_rad - start_rad) + random.Uniform(-0.7, 0.7);
    const double step_m = random.Uniform(0.02, 0.09);
    const Vec2d next_m = at_m + step_m * Vec2d(std::cos(heading_rad), std::sin(heading_rad));
    const double width_m = 0.004 * std::sqrt(left_m / length_m);
    canvas.Line(at_m, next_m, width_m, Rgb(0.10F, 0.09F, 0.08F), 0.9, -0.002);
    at_m = next_m;
    left_m -= step_m;
  }
}

/// A patch of newer or other plaster with uneven edges; a shallow step all around.
void PaintRepair(
    const Vec2d& center_m, const Vec2d& half_m, double tone, uint64_t seed, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const uint64_t offset = seed % 379;
  const Vec2d reach_m = half_m + Vec2d::Constant(0.15);
  canvas.ForEach(
      center_m - reach_m, center_m + reach_m, [&](WallTexel& texel, const Vec2d& point_m) {
        const Vec2d from_m = (point_m - center_m).cwiseAbs();
        const double ragged = 0.045 * fractal.At(point_m.x(), point_m.y(), 0.02, offset);
        const double inside_m = std::min(half_m.x() - from_m.x(), half_m.y() - from_m.y()) + ragged;
        const double cover = Ramp(-0.004, 0.008, inside_m);
        const double grain =
            1.0 + 0.03 * fractal.At(point_m.x(), point_m.y(), canvas.TexelM(), offset + 1);
        const float level = texel.color.mean();
        const Rgb patch =
            MixColor(texel.color, Rgb::Constant(level), 0.5) * static_cast<float>(tone * grain);
        texel.color = MixColor(texel.color, patch, cover);
        texel.dirt *= static_cast<float>(1.0 - 0.6 * cover);
        texel.height_m += static_cast<float>(0.003 * cover);
      });
}

/// Plaster that has come off and shows the bricks.
void PaintSpall(const WallLook& bricks,
                const Vec2d& center_m,
                double radius_m,
                WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const Vec2d reach_m = Vec2d::Constant(1.8 * radius_m);
  const Brickwork work(bricks);
  canvas.ForEach(
      center_m - reach_m, center_m + reach_m, [&](WallTexel& texel, const Vec2d& point_m) {
        const double ragged =
            0.35 * radius_m * fractal.At(point_m.x(), point_m.y(), 0.025, bricks.seed % 367);
        const double inside_m =
            radius_m - (point_m - center_m).cwiseProduct(Vec2d(0.8, 1.2)).norm() + ragged;
        if (inside_m <= 0.0) {
          return;
        }
        if (inside_m < 0.022) {
          // The broken edge: fresh plaster, pale.
          texel.color = MixColor(texel.color, Rgb(0.86F, 0.84F, 0.80F), 0.7);
          texel.height_m -= 0.008F;
          return;
        }
        WallTexel brick = texel;
        work.Paint(brick, point_m, canvas.TexelM());
        texel.color = brick.color;
        texel.height_m = brick.height_m - 0.018F;
        // The edge throws a little shade on what lies deeper.
        texel.dirt += static_cast<float>(0.4 * (1.0 - Ramp(0.022, 0.06, inside_m)));
      });
}

/// Pale salts on brick, bleached runs on concrete and stone.
void PaintBloom(const Vec2d& center_m, double radius_m, uint64_t seed, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const Vec2d reach_m(radius_m, 1.6 * radius_m);
  canvas.ForEach(
      center_m - reach_m, center_m + reach_m, [&](WallTexel& texel, const Vec2d& point_m) {
        const double noise = fractal.At(point_m.x(), 0.4 * point_m.y(), 0.015, seed % 353);
        const Vec2d from = (point_m - center_m).cwiseQuotient(reach_m);
        const double cover = 0.4 * Ramp(0.0, 1.0, 1.0 - from.norm() + 0.35 * noise);
        texel.color =
            MixColor(texel.color, Rgb(0.88F, 0.87F, 0.84F), cover * Ramp(-0.5, 1.0, noise));
      });
}

void PaintDamage(const WallPainting& painting, WallCanvas& canvas) {
  const WallLook& look = painting.look;
  RandomStream random({look.seed, 51});
  const Vec2d low_m = canvas.LowM();
  const Vec2d size_m = canvas.HighM() - low_m;
  const double area_m2 = size_m.x() * size_m.y();
  const auto place = [&] {
    const double u = random.Uniform();
    return Vec2d(low_m + Vec2d(u * size_m.x(), random.Uniform() * size_m.y()));
  };
  const auto count = [&](double per_100_m2) {
    return static_cast<int>(0.01 * area_m2 * per_100_m2 * look.age * random.Uniform(0.3, 1.7) +
                            random.Uniform());
  };
  const bool is_plaster = look.surface == WallSurface::kPlaster;
  const bool is_brick = look.surface == WallSurface::kBrick;
  for (int i = count(is_plaster ? 7.0 : is_brick ? 3.0 : 5.0); i > 0; --i) {
    const Vec2d center_m = place();
    const Vec2d half_m(random.Uniform(0.12, 0.8), random.Uniform(0.08, 0.5));
    PaintRepair(center_m, half_m, random.Uniform(0.82, 1.16), random.Bits(), canvas);
  }
  for (int i = is_plaster ? count(5.0) : 0; i > 0; --i) {
    WallLook bricks = look;
    bricks.surface = WallSurface::kBrick;
    bricks.color = Rgb(0.60F, 0.40F, 0.32F);
    PaintSpall(bricks, place(), random.Uniform(0.06, 0.28), canvas);
  }
  for (int i = is_plaster ? 0 : count(6.0); i > 0; --i) {
    const Vec2d center_m = place();
    PaintBloom(center_m, random.Uniform(0.2, 0.9), random.Bits(), canvas);
  }
  for (int i = is_brick ? count(1.0) : count(6.0); i > 0; --i) {
    const Vec2d from_m = place();
    const double heading_rad = random.Chance(0.6) ? -1.57 : random.Uniform(-3.0, 0.2);
    PaintCrack(from_m, heading_rad, random.Uniform(0.3, 2.2), random.Bits(), canvas);
  }
  // Corners of openings are where walls crack first.
  for (const WallRect& opening : painting.openings) {
    if (!is_brick && random.Chance(0.3 * look.age)) {
      const bool is_left = random.Chance(0.5);
      PaintCrack({is_left ? opening.low_m.x() : opening.high_m.x(), opening.low_m.y()},
                 is_left ? -2.2 : -0.9,
                 random.Uniform(0.2, 0.9),
                 random.Bits(),
                 canvas);
    }
  }
}

}  // namespace

void PaintWeather(const WallPainting& painting, WallCanvas& canvas) {
  PaintDamage(painting, canvas);
  PaintSoot(painting, canvas);
  const uint64_t seed = painting.look.seed;
  RandomStream random({seed, 52});
  const double strength = (0.1 + 0.5 * painting.look.age) * random.Uniform(0.4, 1.1);
  for (size_t i = 0; i < painting.ledges.size(); ++i) {
    // Few ledges leak much, many hardly at all.
    const double leak = random.Uniform();
    PaintStreaks(
        painting.ledges[i], strength * (0.15 + 2.2 * leak * leak), HashKey({seed, 53, i}), canvas);
  }
}

}  // namespace pfseq
