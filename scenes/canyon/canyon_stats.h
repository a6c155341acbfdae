// SPDX-License-Identifier: Apache-2.0
// What a generated city consists of, in numbers.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/scene.h"

#include <map>
#include <string>

namespace pfseq {

struct CanyonStats {
  int num_blocks = 0;
  int num_buildings = 0;
  std::map<std::string, int> buildings_by_style;
  std::map<std::string, int> buildings_by_roof;
  /// Storeys above the street, over all buildings.
  int num_floors = 0;
  int num_windows = 0;
  int num_balconies = 0;
  int num_shops = 0;
  int num_dormers = 0;
  int num_chimneys = 0;
  int num_vehicles = 0;
  int num_trees = 0;
  int num_people = 0;
  int num_lamps = 0;
  /// Signals, plates, columns and shelters.
  int num_signs = 0;
  int num_wires = 0;
  int num_painted_walls = 0;
  /// Greatest and least height of an eave or parapet above the carriageway.
  double least_height_m = 0.0;
  double greatest_height_m = 0.0;
};

/// Several lines of text: the counts above, triangles by material, textures and extents of the
/// scene.
std::string DescribeCanyon(const CanyonStats& stats, const Scene& scene);

}  // namespace pfseq
