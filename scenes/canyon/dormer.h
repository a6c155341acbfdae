// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"

namespace pfseq {

/// A roof plane that rises from an eave.
struct RoofSlope {
  /// Height over horizontal depth.
  double rise_per_m = 1.0;
  double rise_m = 3.0;
};

/// Dormers over every `every`-th bay of an edge, each with the given chance.
void BuildDormers(const BuildContext& context,
                  const Building& building,
                  size_t edge,
                  const RoofSlope& slope,
                  int every,
                  double chance,
                  Lod lod,
                  RandomStream& random);

}  // namespace pfseq
