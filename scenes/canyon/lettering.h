// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenes/canyon/wall_canvas.h"

#include <string_view>

namespace pfseq {

/// Writes a line of capitals and figures into the box of this size from its lower left corner, as
/// large as fits, in the middle; `weight` is the pen's width over the letters' height.
void DrawText(std::string_view text,
              const Vec2d& low_m,
              const Vec2d& size_m,
              double weight,
              const Rgb& color,
              WallCanvas& canvas);

}  // namespace pfseq
