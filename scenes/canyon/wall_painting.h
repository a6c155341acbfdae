// SPDX-License-Identifier: Apache-2.0
// The textures of one part of one front: what it is made of, how rain, soot and people have left
// it. Each is painted for its own place, so that streaks run down from sills and no two fronts are
// alike.
#pragma once

#include "renderer/core/image.h"
#include "scenes/canyon/wall_canvas.h"
#include "scenes/canyon/wall_surface.h"

#include <memory>
#include <string>
#include <vector>

namespace pfseq {

/// An upright rectangle on a facade: (metres along the wall, metres above the carriageway).
struct WallRect {
  Vec2d low_m = Vec2d::Zero();
  Vec2d high_m = Vec2d::Zero();
};

/// Something that sheds water: a sill, a string course, a slab.
struct Ledge {
  double left_m = 0.0;
  double right_m = 0.0;
  double level_m = 0.0;
};

/// A photograph that is laid over the wall instead of a painted surface.
struct WallPhoto {
  std::shared_ptr<const Image<uint8_t>> image;
  /// Of the image's size, or null: a normal map with green up, and roughness in green.
  std::shared_ptr<const Image<uint8_t>> normal;
  std::shared_ptr<const Image<uint8_t>> roughness;
  /// Where its left and lower edge lie, and how large it is, on the facade; it repeats sideways.
  Vec2d low_m = Vec2d::Zero();
  Vec2d size_m = Vec2d::Ones();
  bool is_mirrored = false;
};

struct WallPainting {
  std::string name;
  WallLook look;
  WallPhoto photo;
  /// What the canvas covers.
  WallRect area;
  double texel_m = 0.012;
  /// Texels of colour to one of the normal map.
  int normal_step = 1;
  /// Levels of the pavement and of the eave above the carriageway.
  double pavement_m = 0.0;
  double eave_m = 10.0;
  std::vector<WallRect> openings;
  /// Whether openings have flat arches of bricks on end, and the wall's ends dressed stones.
  bool has_flat_arches = false;
  bool has_quoins = false;
  std::vector<Ledge> ledges;
  /// Posters, graffiti and plates: 0 none, 1 as in an ordinary street.
  double marks = 0.0;
};

/// Paints it; the same for the same description.
PaintedWall Paint(const WallPainting& painting);

/// Flat arches and quoins.
void PaintDressings(const WallPainting& painting, WallCanvas& canvas);

/// Soot, splashes, streaks, cracks, repairs.
void PaintWeather(const WallPainting& painting, WallCanvas& canvas);

/// Pits, chips, stains and lichen, a few centimetres wide.
void PaintSpots(const WallPainting& painting, WallCanvas& canvas);

/// Cables, vents and anchors, and at street level posters, graffiti and number plates.
void PaintMarks(const WallPainting& painting, WallCanvas& canvas);

/// Lays the photograph over the canvas with grain finer than its own.
void PaintPhoto(const WallPainting& painting, WallCanvas& canvas);

}  // namespace pfseq
