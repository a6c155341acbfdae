// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/facade.h"

#include "scenes/canyon/balcony.h"
#include "scenes/canyon/curtain_wall.h"
#include "scenes/canyon/facade_clutter.h"
#include "scenes/canyon/ground_floor.h"
#include "scenes/canyon/moulding.h"
#include "scenes/canyon/painted_front.h"
#include "scenes/canyon/photo_front.h"
#include "scenes/canyon/window.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfseq {
namespace {

constexpr double kMargin_m = 0.35;
constexpr double kFoot_m = kKerbHeight_m - 0.02;

/// A front while it is being built.
struct Front {
  SurfaceFrame frame;
  double width_m = 0.0;
  BayGrid grid;
  Lod lod = Lod::kCoarse;
  double sight_m = 0.0;
};

Opening WindowOpening(const Building& building, const Front& front, int bay, double floor_m) {
  const WindowDesign& design = building.window;
  const double half_m = 0.5 * std::min(design.width_m, front.grid.bay_m - 0.4);
  const double center_m = front.grid.Center(bay);
  const double sill_m = floor_m + design.sill_m;
  return {{center_m - half_m, sill_m}, {center_m + half_m, sill_m + design.height_m}};
}

void BuildBalconyAt(const BuildContext& context,
                    const Building& building,
                    const Front& front,
                    const Opening& opening,
                    int floor,
                    int bay,
                    double floor_m) {
  const double center_m = 0.5 * (opening.low_m.x() + opening.high_m.x());
  const bool is_main_floor = floor == 0 || floor + 1 == building.num_upper_floors;
  switch (building.balcony) {
    case BalconyPattern::kNone:
      break;
    case BalconyPattern::kFrench:
      BuildFrenchBalcony(context, front.frame, opening, front.lod);
      break;
    case BalconyPattern::kSingle:
      if ((bay + static_cast<int>(building.seed % 2)) % 2 == 0) {
        const double half_m = 0.5 * std::min(front.grid.bay_m - 0.3, opening.Width() + 1.0);
        BuildBalcony(context,
                     building,
                     front.frame,
                     center_m - half_m,
                     center_m + half_m,
                     floor_m + 0.05,
                     0.95,
                     front.lod);
      } else {
        BuildFrenchBalcony(context, front.frame, opening, front.lod);
      }
      break;
    case BalconyPattern::kContinuous:
      if (!is_main_floor) {
        BuildFrenchBalcony(context, front.frame, opening, front.lod);
      } else if (bay == 0) {
        BuildBalcony(context,
                     building,
                     front.frame,
                     0.25,
                     front.width_m - 0.25,
                     floor_m + 0.05,
                     0.8,
                     front.lod);
      }
      break;
    case BalconyPattern::kPlate:
      if ((bay + static_cast<int>(building.seed % 2)) % 2 == 0) {
        const double half_m = 0.5 * (front.grid.bay_m - 0.1);
        BuildPlateBalcony(
            context, building, front.frame, center_m - half_m, center_m + half_m, floor_m + 0.05);
      }
      break;
  }
}

/// Upper storeys: one column of windows a bay, one wall around them all.
void BuildUpperFloors(const BuildContext& context,
                      const Building& building,
                      const Front& front,
                      double foot_m,
                      RandomStream& random) {
  std::vector<OpeningColumn> columns;
  Building fitted = building;
  for (int bay = 0; bay < front.grid.num_bays; ++bay) {
    const Opening first = WindowOpening(building, front, bay, foot_m);
    // Two open leaves beside each window take as much room again as the window.
    fitted.window.has_shutters =
        building.window.has_shutters && front.grid.bay_m > 2.0 * first.Width() + 0.1;
    OpeningColumn column{first.low_m.x(), first.high_m.x(), {}};
    for (int floor = 0; floor < building.num_upper_floors; ++floor) {
      const double floor_m = foot_m + floor * building.floor_height_m;
      const Opening opening = WindowOpening(building, front, bay, floor_m);
      column.spans_m.push_back({opening.low_m.y(), opening.high_m.y()});
      BuildWindow(context, fitted, front.frame, opening, building.wall, front.lod, random);
      if (front.lod <= Lod::kMedium && context.detail > 0.0) {
        BuildBalconyAt(context, building, front, opening, floor, bay, floor_m);
        if (front.lod == Lod::kFine) {
          RandomStream clutter(
              {building.seed, 41, static_cast<uint64_t>(bay), static_cast<uint64_t>(floor)});
          const bool has_balcony = building.balcony != BalconyPattern::kNone;
          BuildWindowClutter(context, front.frame, opening, has_balcony, clutter);
        }
      }
    }
    columns.push_back(column);
  }
  const WallRect area{{0.0, foot_m}, {front.width_m, building.eave_m}};
  const int wall = OrderWall(
      context, building, front.frame, building.wall, area, columns, front.sight_m, front.lod);
  BuildWallWithOpenings(context.builder, wall, front.frame, area.low_m, area.high_m, columns);
}

/// Backs: the same grid of windows on all floors, in one wall.
void BuildCourtFront(const BuildContext& context,
                     const Building& building,
                     const Front& front,
                     RandomStream& random) {
  std::vector<OpeningColumn> columns;
  Building plain = building;
  plain.window.height_m = std::min(1.6, building.floor_height_m - 1.4);
  plain.window.sill_m = 0.9;
  plain.window.width_m = std::min(1.3, front.grid.bay_m - 0.6);
  for (int bay = 0; bay < front.grid.num_bays; ++bay) {
    const Opening first = WindowOpening(plain, front, bay, 0.0);
    OpeningColumn column{first.low_m.x(), first.high_m.x(), {}};
    for (int floor = -1; floor < building.num_upper_floors; ++floor) {
      const double floor_m =
          floor < 0 ? kKerbHeight_m
                    : kKerbHeight_m + building.ground_floor_m + floor * building.floor_height_m;
      const Opening opening = WindowOpening(plain, front, bay, floor_m);
      if (opening.high_m.y() > building.eave_m - 0.3) {
        continue;
      }
      column.spans_m.push_back({opening.low_m.y(), opening.high_m.y()});
      BuildWindow(context, plain, front.frame, opening, building.blank_wall, front.lod, random);
    }
    columns.push_back(column);
  }
  BuildWallWithOpenings(context.builder,
                        building.blank_wall,
                        front.frame,
                        {0.0, kFoot_m},
                        {front.width_m, building.eave_m},
                        columns);
}

void BuildStreetFront(const BuildContext& context,
                      const Building& building,
                      const Front& front,
                      bool has_door,
                      RandomStream& random) {
  if (building.photo && front.lod <= Lod::kMedium) {
    BuildPhotoFront(context, building, front.frame, front.width_m, front.sight_m);
    return;
  }
  const double head_m = kKerbHeight_m + building.ground_floor_m;
  BuildGroundFloor(context,
                   building,
                   front.frame,
                   front.width_m,
                   head_m,
                   has_door,
                   front.sight_m,
                   front.lod,
                   random);
  if (building.style == FacadeStyle::kGlass && building.num_upper_floors > 0) {
    BuildCurtainWall(context, building, front.frame, front.width_m, head_m, front.lod, random);
    return;
  }
  BuildUpperFloors(context, building, front, head_m, random);
}

size_t LongestStreetEdge(const Building& building) {
  size_t longest = 0;
  double length_m = -1.0;
  for (size_t i = 0; i < building.lot.edges.size(); ++i) {
    if (building.lot.edges[i] == EdgeKind::kStreet && EdgeLength(building, i) > length_m) {
      longest = i;
      length_m = EdgeLength(building, i);
    }
  }
  return longest;
}

}  // namespace

SurfaceFrame FrameOfEdge(const Building& building, size_t edge) {
  const std::vector<Vec2d>& points_m = building.lot.footprint_m;
  const Vec2d& a_m = points_m[edge];
  const Vec2d along = (points_m[(edge + 1) % points_m.size()] - a_m).normalized();
  return {Lift(a_m, 0.0), Lift(along, 0.0), Vec3d::UnitZ(), Lift(RightOf(along), 0.0)};
}

double EdgeLength(const Building& building, size_t edge) {
  const std::vector<Vec2d>& points_m = building.lot.footprint_m;
  return (points_m[(edge + 1) % points_m.size()] - points_m[edge]).norm();
}

BayGrid GridOf(const Building& building, double width_m) {
  BayGrid grid;
  const double free_m = width_m - 2.0 * kMargin_m;
  grid.num_bays = std::max(0, static_cast<int>(std::lround(free_m / building.bay_width_m)));
  if (grid.num_bays == 0 && free_m > 1.3) {
    grid.num_bays = 1;
  }
  grid.first_m = kMargin_m;
  grid.bay_m = grid.num_bays > 0 ? free_m / grid.num_bays : 0.0;
  return grid;
}

void BuildFacades(const BuildContext& context,
                  const Building& building,
                  const std::vector<Lod>& lods) {
  const size_t door_edge = LongestStreetEdge(building);
  for (size_t edge = 0; edge < building.lot.edges.size(); ++edge) {
    const EdgeKind kind = building.lot.edges[edge];
    if (kind == EdgeKind::kParty) {
      continue;
    }
    RandomStream random({building.seed, 10, edge});
    Front front;
    front.frame = FrameOfEdge(building, edge);
    front.width_m = EdgeLength(building, edge);
    front.grid = GridOf(building, front.width_m);
    front.lod = lods[edge];
    front.sight_m = building.sight_m.empty() ? 0.0 : building.sight_m[edge];
    front.frame.out *= context.relief;
    if (kind == EdgeKind::kCourt) {
      BuildCourtFront(context, building, front, random);
    } else {
      BuildStreetFront(context, building, front, edge == door_edge, random);
    }
  }
  BuildMouldings(context, building, lods);
}

}  // namespace pfseq
