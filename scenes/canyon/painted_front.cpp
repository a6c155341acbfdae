// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/painted_front.h"

#include <algorithm>
#include <utility>

namespace pfseq {
namespace {

/// Texels above the ground floor are larger by this: nobody comes nearer than a few metres.
constexpr double kUpperTexel = 1.7;
/// Where a front is seen from further away than this, texels grow with the distance.
constexpr double kNear_m = 6.5;

/// Sills, string courses and slabs, as the builders of windows, mouldings and balconies set them.
std::vector<Ledge> LedgesOf(const Building& building,
                            const WallRect& area,
                            const std::vector<OpeningColumn>& columns) {
  std::vector<Ledge> ledges;
  for (const OpeningColumn& column : columns) {
    for (const auto& [low_m, high_m] : column.spans_m) {
      ledges.push_back({column.left_m - 0.06, column.right_m + 0.06, low_m - 0.07});
    }
  }
  const double head_m = kKerbHeight_m + building.ground_floor_m;
  const bool is_upper = area.low_m.y() >= head_m - 0.01;
  for (int floor = 1; is_upper && floor < building.num_upper_floors; ++floor) {
    const double floor_m = head_m + floor * building.floor_height_m;
    if (building.has_string_courses) {
      ledges.push_back({area.low_m.x(), area.high_m.x(), floor_m - 0.16});
    }
  }
  if (!is_upper) {
    ledges.push_back({area.low_m.x(), area.high_m.x(), head_m - 0.17});
  }
  return ledges;
}

}  // namespace

int OrderWall(const BuildContext& context,
              const Building& building,
              const SurfaceFrame& facade,
              int wall,
              const WallRect& area,
              const std::vector<OpeningColumn>& columns,
              double sight_m,
              Lod lod) {
  const Vec2d size_m = area.high_m - area.low_m;
  if (context.paintings == nullptr || lod > Lod::kMedium || size_m.minCoeff() < 0.2) {
    return wall;
  }
  const bool is_ground = area.low_m.y() < kKerbHeight_m + 0.5;
  WallPainting painting;
  painting.look = context.paintings->LookOf(wall, building.seed, building.age);
  if (building.is_rubble) {
    painting.look.surface = WallSurface::kRubble;
  }
  painting.area = area;
  painting.texel_m = context.paintings->TexelM() * (is_ground ? 1.0 : kUpperTexel) *
                     std::clamp(sight_m / kNear_m, 1.0, 12.0);
  painting.normal_step = is_ground ? 1 : 2;
  painting.pavement_m = kKerbHeight_m;
  painting.eave_m = building.eave_m;
  painting.marks = is_ground && lod == Lod::kFine ? context.Share(1.0) : 0.0;
  for (const OpeningColumn& column : columns) {
    for (const auto& [low_m, high_m] : column.spans_m) {
      painting.openings.push_back({{column.left_m, low_m}, {column.right_m, high_m}});
    }
  }
  const WindowDesign& window = building.window;
  painting.has_flat_arches = painting.look.surface == WallSurface::kBrick && !is_ground &&
                             !window.has_lintel && !window.has_surround;
  painting.has_quoins = building.has_quoins;
  ++context.stats.num_painted_walls;
  painting.ledges = LedgesOf(building, area, columns);
  return context.paintings->Add(context.builder, facade, wall, std::move(painting));
}

}  // namespace pfseq
