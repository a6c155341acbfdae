// SPDX-License-Identifier: Apache-2.0
// The fronts of a house: walls with their openings, balconies and mouldings.
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"
#include "scenes/canyon/shapes.h"

#include <vector>

namespace pfseq {

/// The frame of a footprint's edge: origin at its left end seen from outside, at z = 0.
SurfaceFrame FrameOfEdge(const Building& building, size_t edge);

double EdgeLength(const Building& building, size_t edge);

/// Bay centres and width of the windows' grid on an edge; roofs set their dormers by it.
struct BayGrid {
  int num_bays = 0;
  double first_m = 0.0;
  double bay_m = 0.0;

  double Center(int bay) const { return first_m + (bay + 0.5) * bay_m; }
};
BayGrid GridOf(const Building& building, double width_m);

/// All street and court fronts from the pavement to the eave; `lods` has one entry for each edge.
void BuildFacades(const BuildContext& context,
                  const Building& building,
                  const std::vector<Lod>& lods);

}  // namespace pfseq
