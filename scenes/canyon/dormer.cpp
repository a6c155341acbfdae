// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/dormer.h"

#include "scenes/canyon/facade.h"
#include "scenes/canyon/shapes.h"
#include "scenes/canyon/window.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfseq {
namespace {

/// The front stands this far behind the facade; parts reach this far under the roof.
constexpr double kSetBack_m = 0.3;
constexpr double kSunk_m = 0.05;
constexpr double kRoof_m = 0.09;

void BuildDormer(const BuildContext& context,
                 const Building& building,
                 const SurfaceFrame& facade,
                 double center_m,
                 double width_m,
                 const RoofSlope& slope,
                 Lod lod,
                 RandomStream& random) {
  MeshBuilder& builder = context.builder;
  ++context.stats.num_dormers;
  const double eave_m = building.eave_m;
  const double foot_m = eave_m + slope.rise_per_m * kSetBack_m - kSunk_m;
  const double head_m =
      eave_m + std::min(slope.rise_per_m * kSetBack_m + 1.75, slope.rise_m - 0.35);
  const double left_m = center_m - 0.5 * width_m;
  const double right_m = center_m + 0.5 * width_m;
  const SurfaceFrame front = facade.MovedTo(0.0, 0.0, -kSetBack_m);

  Building plain = building;
  plain.window.has_surround = false;
  plain.window.has_lintel = false;
  plain.window.has_shutters = false;
  plain.window.reveal_m = 0.1;
  plain.window.num_columns = 2;
  const Opening opening{{left_m + 0.14, foot_m + 0.35}, {right_m - 0.14, head_m - 0.15}};
  BuildWallWithOpenings(
      builder,
      building.trim,
      front,
      {left_m, foot_m},
      {right_m, head_m},
      {{opening.low_m.x(), opening.high_m.x(), {{opening.low_m.y(), opening.high_m.y()}}}});
  BuildWindow(context, plain, front, opening, building.trim, lod, random);

  // Cheeks: triangles between front, top and a line just under the slope.
  const double cheek_end_m = -(head_m + kSunk_m - eave_m) / slope.rise_per_m;
  const std::array<Vec3d, 3> left = {facade.At(left_m, foot_m, -kSetBack_m),
                                     facade.At(left_m, head_m, -kSetBack_m),
                                     facade.At(left_m, head_m, cheek_end_m)};
  const std::array<Vec3d, 3> right = {facade.At(right_m, foot_m, -kSetBack_m),
                                      facade.At(right_m, head_m, cheek_end_m),
                                      facade.At(right_m, head_m, -kSetBack_m)};
  builder.Polygon(building.roof_material, left);
  builder.Polygon(building.roof_material, right);
  const double roof_end_m = -(head_m + kRoof_m + kSunk_m - eave_m) / slope.rise_per_m;
  AddBox(builder,
         context.palette.roof_metal,
         facade,
         {left_m - 0.1, head_m, roof_end_m},
         {right_m + 0.1, head_m + kRoof_m, -kSetBack_m + 0.14},
         kFacesAll & ~kFaceBack);
}

}  // namespace

void BuildDormers(const BuildContext& context,
                  const Building& building,
                  size_t edge,
                  const RoofSlope& slope,
                  int every,
                  double chance,
                  Lod lod,
                  RandomStream& random) {
  constexpr double kLeastRise_m = 2.2;
  const double edge_m = EdgeLength(building, edge);
  const BayGrid grid = GridOf(building, edge_m);
  const double width_m = std::min(1.45, grid.bay_m - 0.4);
  if (context.detail <= 0.0 || slope.rise_m < kLeastRise_m || width_m < 0.8) {
    return;
  }
  // Hips at corners leave less room than the front below.
  const double margin_m =
      1.0 + slope.rise_m / slope.rise_per_m * (slope.rise_per_m > 1.5 ? 1.0 : 0.0);
  for (int bay = every / 2; bay < grid.num_bays; bay += every) {
    const bool is_built = random.Chance(chance);
    const double center_m = grid.Center(bay);
    const bool has_room = center_m - 0.5 * width_m > margin_m - 0.5 &&
                          center_m + 0.5 * width_m < edge_m - margin_m + 0.5;
    if (is_built && has_room) {
      BuildDormer(
          context, building, FrameOfEdge(building, edge), center_m, width_m, slope, lod, random);
    }
  }
}

}  // namespace pfseq
