// SPDX-License-Identifier: Apache-2.0
// What walls are made of, unweathered: brick bonds, ashlar, rubble, plaster, concrete, by the
// metre.
#pragma once

#include "renderer/core/vector.h"
#include "scenes/canyon/wall_canvas.h"

#include <cstdint>

namespace pfseq {

enum class WallSurface { kPlaster, kBrick, kAshlar, kConcrete, kRubble };

/// The look of one house's wall.
struct WallLook {
  WallSurface surface = WallSurface::kPlaster;
  /// Mean colour, sRGB-encoded.
  Rgb color = Rgb::Constant(0.7F);
  /// Another seed varies bond, sizes and shades.
  uint64_t seed = 0;
  /// 0 new, 1 neglected.
  double age = 0.5;
};

/// Lays one kind of wall over a whole canvas.
void PaintSurface(const WallLook& look, WallCanvas& canvas);

/// Brickwork, for walls of brick and where plaster has come off.
struct Brickwork {
  explicit Brickwork(const WallLook& look);

  void Paint(WallTexel& texel, const Vec2d& point_m, double texel_m) const;

  Rgb color;
  uint64_t seed;
  /// 0 stretchers, 1 headers every sixth course, 2 English cross, 3 Flemish.
  int bond;
  /// Of the bricks' brightness, relative.
  double spread;
  double mortar_tone;
};

}  // namespace pfseq
