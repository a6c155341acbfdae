// SPDX-License-Identifier: Apache-2.0
// Shops, house doors and the windows between them.
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"
#include "scenes/canyon/window.h"

namespace pfseq {

/// The street side of a ground floor, `width_m` wide, from the pavement to `head_m`.
void BuildGroundFloor(const BuildContext& context,
                      const Building& building,
                      const SurfaceFrame& facade,
                      double width_m,
                      double head_m,
                      bool has_door,
                      double sight_m,
                      Lod lod,
                      RandomStream& random);

}  // namespace pfseq
