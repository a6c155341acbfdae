// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"
#include "scenes/canyon/window.h"

#include <vector>

namespace pfseq {

/// The material for a part of a front: near the drive a painting of its own that knows the openings
/// and what sheds water, else the palette's `wall`. `sight_m` is the distance that it is seen from.
int OrderWall(const BuildContext& context,
              const Building& building,
              const SurfaceFrame& facade,
              int wall,
              const WallRect& area,
              const std::vector<OpeningColumn>& columns,
              double sight_m,
              Lod lod);

}  // namespace pfseq
