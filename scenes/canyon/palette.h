// SPDX-License-Identifier: Apache-2.0
// The materials of the city, under the names that its builders know them by.
#pragma once

#include "renderer/core/random.h"
#include "renderer/trace/scene.h"
#include "scenes/canyon/wall_surface.h"

#include <map>
#include <vector>

namespace pfseq {

/// Members are indices of materials; vectors are choices of one kind.
struct Palette {
  std::vector<Material> materials;
  std::vector<Texture> textures;
  /// The square that one repetition of each material's textures covers.
  std::vector<double> texture_size_m;
  /// What the walls among the materials are made of.
  std::map<int, WallSurface> wall_surface;

  std::vector<int> plaster;
  std::vector<int> brick;
  std::vector<int> ashlar;
  std::vector<int> concrete;
  std::vector<int> blank_wall;
  std::vector<int> trim;
  std::vector<int> window_frame;
  std::vector<int> door;
  std::vector<int> shutter;
  std::vector<int> awning;
  std::vector<int> shop_front;
  std::vector<int> spandrel;
  std::vector<int> roof_tile;
  std::vector<int> slate;
  int roof_metal = 0;
  int roof_gravel = 0;
  int coping = 0;
  int chimney_pot = 0;
  int railing = 0;
  int pale_metal = 0;
  int gutter = 0;
  int roller_blind = 0;
  int window_glass = 0;
  int window_framed = 0;
  int shop_glass = 0;
  int sign = 0;
  int facade_glass = 0;
  int curtain_wall = 0;
  int asphalt = 0;
  int pavement = 0;
  int kerb = 0;
  int marking = 0;
  int manhole = 0;

  std::vector<int> car_paint;
  std::vector<int> cloth;
  std::vector<int> leaf;
  /// Blossoms, sheets like leaves.
  std::vector<int> bloom;
  int car_glass = 0;
  int tyre = 0;
  int tail_lamp = 0;
  int head_lamp = 0;
  int signal_green = 0;
  int skin = 0;
  int bark = 0;
  int wire = 0;
  int street_picture = 0;
};

/// The same on every call.
Palette MakePalette();

/// One of several choices.
int Pick(const std::vector<int>& choices, RandomStream& random);

}  // namespace pfseq
