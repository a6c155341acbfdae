// SPDX-License-Identifier: Apache-2.0
// A block cut into lots: a ring of houses around a courtyard where there is room, else one or two
// rows.
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/street_plan.h"

#include <vector>

namespace pfseq {

/// What a side of a house looks at.
enum class EdgeKind {
  kStreet,
  kCourt,
  kParty,  ///< A blank wall: a neighbour, or what shows above and behind him.
};

/// The footprint of one house: a rectangle, its street corners perhaps cut.
struct Lot {
  /// Counter-clockwise.
  std::vector<Vec2d> footprint_m;
  /// Of edge i, from point i to point i + 1.
  std::vector<EdgeKind> edges;
  /// True when the streets it looks at run along X only, or along Y only (so that a ridge can
  /// follow them).
  bool has_one_street_axis = true;
  /// With one street axis: true when it is X.
  bool street_along_x = true;
};

/// Lots in a fixed order; none in a block without room. Each keeps clear of the drive.
std::vector<Lot> SubdivideBlock(const Block& block,
                                const std::vector<Vec2d>& drive_path_m,
                                RandomStream random);

}  // namespace pfseq
