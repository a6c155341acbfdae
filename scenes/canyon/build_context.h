// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenes/canyon/canyon_stats.h"
#include "scenes/canyon/facade_photos.h"
#include "scenes/canyon/mesh_builder.h"
#include "scenes/canyon/palette.h"
#include "scenes/canyon/wall_paintings.h"

namespace pfseq {

/// How finely a part is built, by its distance from the drive and whether the drive can see it.
enum class Lod {
  kFine = 0,    ///< frames, panes, balusters
  kMedium = 1,  ///< recesses with a picture of the window, few balusters
  kCoarse = 2,  ///< recesses alone
  kFlush = 3,   ///< windows in the plane of the wall: courtyards and backs
};

/// What all builders of parts need.
struct BuildContext {
  MeshBuilder& builder;
  const Palette& palette;
  /// CanyonSpec::detail.
  double detail = 1.0;
  CanyonStats& stats;
  /// Where fronts near the drive order textures of their own; null: they have the palette's.
  WallPaintings* paintings = nullptr;
  /// CanyonSpec::street_life.
  double street_life = 1.0;
  /// Photographs to take fronts from, or null; goes with `paintings`.
  const FacadePhotos* photos = nullptr;
  /// CanyonSpec::relief.
  double relief = 1.0;

  /// A share of what the default detail has, at most 1.
  double Share(double at_default) const {
    return at_default * detail < 1.0 ? at_default * detail : 1.0;
  }
};

}  // namespace pfseq
