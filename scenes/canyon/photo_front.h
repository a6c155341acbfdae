// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"

namespace pfseq {

/// A whole street front, pavement to eave, that shows the house's photograph at `sight_m`, with its
/// windows set back where the photograph's description gives them.
void BuildPhotoFront(const BuildContext& context,
                     const Building& building,
                     const SurfaceFrame& facade,
                     double width_m,
                     double sight_m);

}  // namespace pfseq
