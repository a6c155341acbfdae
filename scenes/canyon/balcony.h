// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"
#include "scenes/canyon/window.h"

namespace pfseq {

/// A railing of the given height whose front runs from left to right at `depth_m` before the wall;
/// its sides lead back to the wall. `foot_m` is the level that it stands on.
void BuildRailing(const BuildContext& context,
                  int material_idx,
                  const SurfaceFrame& facade,
                  double left_m,
                  double right_m,
                  double foot_m,
                  double depth_m,
                  Lod lod);

/// The low railing before a window that reaches down to the floor.
void BuildFrenchBalcony(const BuildContext& context,
                        const SurfaceFrame& facade,
                        const Opening& opening,
                        Lod lod);

/// A slab on brackets with a railing, its upper side at `floor_m`.
void BuildBalcony(const BuildContext& context,
                  const Building& building,
                  const SurfaceFrame& facade,
                  double left_m,
                  double right_m,
                  double floor_m,
                  double depth_m,
                  Lod lod);

/// A slab with closed parapets of sheet: the balcony of the 1960s.
void BuildPlateBalcony(const BuildContext& context,
                       const Building& building,
                       const SurfaceFrame& facade,
                       double left_m,
                       double right_m,
                       double floor_m);

}  // namespace pfseq
