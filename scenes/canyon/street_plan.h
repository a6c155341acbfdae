// SPDX-License-Identifier: Apache-2.0
// The city seen from above: streets on a grid that holds the U of the drive, and the blocks between
// them.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/sequence/sequence_spec.h"

#include <array>
#include <vector>

namespace pfseq {

/// Top of the pavements above the carriageway.
inline constexpr double kKerbHeight_m = 0.12;

/// Corners and edges of a block go counter-clockwise from the south-west: edge 0 is the south one.
enum BlockEdge { kSouth = 0, kEast = 1, kNorth = 2, kWest = 3 };

/// An axis-aligned rectangle in the plane.
struct PlanRect {
  Vec2d low_m = Vec2d::Zero();
  Vec2d high_m = Vec2d::Zero();

  Vec2d Size() const { return high_m - low_m; }
  Vec2d Center() const { return 0.5 * (low_m + high_m); }
  std::array<Vec2d, 4> Corners() const {
    return {low_m, Vec2d(high_m.x(), low_m.y()), high_m, Vec2d(low_m.x(), high_m.y())};
  }
};

/// A street along a line of the grid.
struct Street {
  /// y of a street along X, x of a street along Y.
  double center_m = 0.0;
  /// Between the facades.
  double width_m = 15.0;
  double pavement_m = 2.5;

  double LowFacade() const { return center_m - 0.5 * width_m; }
  double HighFacade() const { return center_m + 0.5 * width_m; }
};

/// What lies between streets: a pavement island with a rectangle of lots on it.
struct Block {
  /// The building lines.
  PlanRect lots;
  /// The kerbs.
  PlanRect island;
  /// Length that is cut off along both edges at each corner (45 degrees), of the lots and of the
  /// island.
  std::array<double, 4> lots_chamfer_m = {};
  std::array<double, 4> island_chamfer_m = {};
  /// Whether each edge lies on a street; the city's rim has its back to nothing.
  std::array<bool, 4> is_street = {true, true, true, true};
  bool is_rim = false;
};

struct StreetPlan {
  /// Ascending; along X (by y) and along Y (by x).
  std::vector<Street> streets_along_x;
  std::vector<Street> streets_along_y;
  std::vector<Block> blocks;
  /// Samples of the drive at most half a metre apart.
  std::vector<Vec2d> drive_path_m;
  /// All that is built.
  PlanRect extent;
};

/// Points of the U at most `spacing_m` apart, from the origin along +X.
std::vector<Vec2d> SampleDrivePath(const DriveSpec& drive, double spacing_m);

/// Throws InputError when a figure of the canyon is out of its range.
StreetPlan PlanStreets(const CanyonSpec& canyon, const DriveSpec& drive);

/// The least distance between a path and a polygon (counter-clockwise); 0 where the path runs
/// inside.
double DistanceToPath(const std::vector<Vec2d>& polygon_m, const std::vector<Vec2d>& path_m);

/// A rectangle with its corners cut off, counter-clockwise.
std::vector<Vec2d> ChamferedRect(const PlanRect& rect, const std::array<double, 4>& chamfer_m);

}  // namespace pfseq
