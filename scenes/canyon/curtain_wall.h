// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"

namespace pfseq {

/// The upper storeys of a glass facade, from `foot_m` to the eave: panes and spandrels that are
/// each a little out of true, mullions and transoms before their joints.
void BuildCurtainWall(const BuildContext& context,
                      const Building& building,
                      const SurfaceFrame& facade,
                      double width_m,
                      double foot_m,
                      Lod lod,
                      RandomStream& random);

}  // namespace pfseq
