// SPDX-License-Identifier: Apache-2.0
// Openings in walls, and what fills them.
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"
#include "scenes/canyon/canyon_textures.h"

#include <array>
#include <vector>

namespace pfseq {

/// A rectangle in a facade's (u, v).
struct Opening {
  Vec2d low_m = Vec2d::Zero();
  Vec2d high_m = Vec2d::Zero();

  double Width() const { return high_m.x() - low_m.x(); }
  double Height() const { return high_m.y() - low_m.y(); }
};

/// Openings above one another with the same sides, in ascending order; one may begin at the wall's
/// foot.
struct OpeningColumn {
  double left_m = 0.0;
  double right_m = 0.0;
  std::vector<std::array<double, 2>> spans_m;
};

/// The wall [low, high] in the plane out = 0, but for the openings of columns that go from left to
/// right.
void BuildWallWithOpenings(MeshBuilder& builder,
                           int material_idx,
                           const SurfaceFrame& facade,
                           const Vec2d& low_m,
                           const Vec2d& high_m,
                           const std::vector<OpeningColumn>& columns);

/// The four faces of an opening between the planes `front_w_m` and `back_w_m` (further in); without
/// its bottom when the opening stands on the ground.
void BuildReveal(MeshBuilder& builder,
                 int material_idx,
                 const SurfaceFrame& facade,
                 const Opening& opening,
                 double front_w_m,
                 double back_w_m,
                 bool has_bottom);

/// Bars and panes that fill an opening.
struct Glazing {
  int frame = 0;
  int glass = 0;
  int num_columns = 2;
  /// Height of the upper panes as a share of the whole; 0: no transom.
  double transom_share = 0.0;
  double rim_m = 0.055;
  double bar_m = 0.065;
  /// What shows behind the panes together.
  TextureWindow picture = {};
};

/// Fills an opening with its bars in the plane w and the panes behind them.
void BuildGlazing(MeshBuilder& builder,
                  const SurfaceFrame& facade,
                  const Opening& opening,
                  double w_m,
                  const Glazing& glazing);

/// A picture of an atlas of `cells` x `cells`, without its rim (where neighbours would bleed in).
TextureWindow AtlasCell(int cells, RandomStream& random);

/// A window in an opening of a wall: reveal, frame and glass, sill, lintel or surround, shutters,
/// blind.
void BuildWindow(const BuildContext& context,
                 const Building& building,
                 const SurfaceFrame& facade,
                 const Opening& opening,
                 int wall,
                 Lod lod,
                 RandomStream& random);

}  // namespace pfseq
