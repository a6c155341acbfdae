// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/balcony.h"

#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfseq {
namespace {

constexpr double kRailHeight_m = 1.0;
constexpr double kRail_m = 0.04;
constexpr double kBaluster_m = 0.018;
constexpr double kSlab_m = 0.15;

/// Upright bars between (u0, w0) and (u1, w1), the ends left out.
void BuildBalusters(const BuildContext& context,
                    int material_idx,
                    const SurfaceFrame& facade,
                    const Vec2d& from_m,
                    const Vec2d& to_m,
                    double low_m,
                    double high_m,
                    double spacing_m) {
  const int count = static_cast<int>(std::floor((to_m - from_m).norm() / spacing_m));
  constexpr unsigned kBarFaces = kFacesSides;
  for (int i = 1; i < count; ++i) {
    const Vec2d at_m = from_m + (to_m - from_m) * (static_cast<double>(i) / count);
    AddBox(context.builder,
           material_idx,
           facade,
           {at_m.x() - 0.5 * kBaluster_m, low_m, at_m.y() - 0.5 * kBaluster_m},
           {at_m.x() + 0.5 * kBaluster_m, high_m, at_m.y() + 0.5 * kBaluster_m},
           kBarFaces);
  }
}

}  // namespace

void BuildRailing(const BuildContext& context,
                  int material_idx,
                  const SurfaceFrame& facade,
                  double left_m,
                  double right_m,
                  double foot_m,
                  double depth_m,
                  Lod lod) {
  MeshBuilder& builder = context.builder;
  const double spacing_m =
      (lod == Lod::kFine ? 0.12 : 0.36) / std::max(0.5, 0.5 + 0.5 * context.detail);
  const double low_m = foot_m + 0.10;
  const double top_m = foot_m + kRailHeight_m;
  const double front_m = depth_m - 0.5 * kRail_m;
  const double half_m = 0.5 * kRail_m;
  // Upper and lower rail; the lower one thinner.
  for (const double rail_m : {low_m, top_m}) {
    const double thick_m = rail_m == top_m ? half_m : 0.6 * half_m;
    AddBox(builder,
           material_idx,
           facade,
           {left_m, rail_m - thick_m, front_m - thick_m},
           {right_m, rail_m + thick_m, front_m + thick_m},
           kFacesAll);
    if (depth_m > 0.2) {
      for (const double side_m : {left_m + half_m, right_m - half_m}) {
        AddBox(builder,
               material_idx,
               facade,
               {side_m - 0.8 * thick_m, rail_m - 0.8 * thick_m, 0.0},
               {side_m + 0.8 * thick_m, rail_m + 0.8 * thick_m, front_m},
               kFaceLeft | kFaceRight | kFaceTop | kFaceBottom);
      }
    } else {
      for (const double side_m : {left_m + 0.02, right_m - 0.02}) {
        AddBox(builder,
               material_idx,
               facade,
               {side_m - 0.01, rail_m - 0.01, 0.0},
               {side_m + 0.01, rail_m + 0.01, front_m},
               kFaceLeft | kFaceRight | kFaceTop | kFaceBottom);
      }
    }
  }
  const double post_top_m = top_m + 0.01;
  for (const double side_m : {left_m + half_m, right_m - half_m}) {
    AddBox(builder,
           material_idx,
           facade,
           {side_m - 0.025, depth_m > 0.2 ? foot_m : low_m - 0.03, front_m - 0.025},
           {side_m + 0.025, post_top_m + half_m, front_m + 0.025},
           kFacesAll);
  }
  BuildBalusters(context,
                 material_idx,
                 facade,
                 {left_m + half_m, front_m},
                 {right_m - half_m, front_m},
                 low_m,
                 top_m,
                 spacing_m);
  if (depth_m > 0.4) {
    for (const double side_m : {left_m + half_m, right_m - half_m}) {
      BuildBalusters(
          context, material_idx, facade, {side_m, 0.0}, {side_m, front_m}, low_m, top_m, spacing_m);
    }
  }
}

void BuildFrenchBalcony(const BuildContext& context,
                        const SurfaceFrame& facade,
                        const Opening& opening,
                        Lod lod) {
  BuildRailing(context,
               context.palette.railing,
               facade,
               opening.low_m.x() - 0.04,
               opening.high_m.x() + 0.04,
               opening.low_m.y() - 0.02,
               0.12,
               lod);
}

void BuildBalcony(const BuildContext& context,
                  const Building& building,
                  const SurfaceFrame& facade,
                  double left_m,
                  double right_m,
                  double floor_m,
                  double depth_m,
                  Lod lod) {
  ++context.stats.num_balconies;
  MeshBuilder& builder = context.builder;
  AddBox(builder,
         building.trim,
         facade,
         {left_m, floor_m - kSlab_m, 0.0},
         {right_m, floor_m, depth_m},
         kFacesOnWall);
  // Brackets of two steps under the slab.
  const int num_brackets = std::max(2, static_cast<int>(std::lround((right_m - left_m) / 1.4)) + 1);
  for (int i = 0; lod == Lod::kFine && i < num_brackets; ++i) {
    const double u_m = left_m + 0.18 + (right_m - left_m - 0.36) * i / (num_brackets - 1);
    const double head_m = floor_m - kSlab_m;
    AddBox(builder,
           building.trim,
           facade,
           {u_m - 0.07, head_m - 0.16, 0.0},
           {u_m + 0.07, head_m, 0.75 * depth_m},
           kFacesSides | kFaceBottom);
    AddBox(builder,
           building.trim,
           facade,
           {u_m - 0.06, head_m - 0.34, 0.0},
           {u_m + 0.06, head_m - 0.16, 0.4 * depth_m},
           kFacesSides | kFaceBottom);
  }
  BuildRailing(context,
               context.palette.railing,
               facade,
               left_m + 0.03,
               right_m - 0.03,
               floor_m,
               depth_m - 0.03,
               lod);
}

void BuildPlateBalcony(const BuildContext& context,
                       const Building& building,
                       const SurfaceFrame& facade,
                       double left_m,
                       double right_m,
                       double floor_m) {
  ++context.stats.num_balconies;
  constexpr double kDepth_m = 1.05;
  constexpr double kPlate_m = 0.04;
  MeshBuilder& builder = context.builder;
  AddBox(builder,
         building.wall,
         facade,
         {left_m, floor_m - kSlab_m, 0.0},
         {right_m, floor_m, kDepth_m},
         kFacesOnWall);
  const double low_m = floor_m - 0.06;
  const double high_m = floor_m + 0.92;
  // The sides end at the front plate, which covers their ends.
  AddBox(builder,
         building.spandrel,
         facade,
         {left_m - 0.02, low_m, kDepth_m + 0.01},
         {right_m + 0.02, high_m, kDepth_m + 0.01 + kPlate_m},
         kFacesAll);
  for (const double side_m : {left_m + 0.03, right_m - 0.03 - kPlate_m}) {
    AddBox(builder,
           building.spandrel,
           facade,
           {side_m, floor_m, 0.0},
           {side_m + kPlate_m, high_m - 0.01, kDepth_m + 0.01},
           kFaceLeft | kFaceRight | kFaceTop);
  }
  AddBox(builder,
         context.palette.pale_metal,
         facade,
         {left_m - 0.03, high_m + 0.06, kDepth_m},
         {right_m + 0.03, high_m + 0.10, kDepth_m + 0.06},
         kFacesAll);
  for (const double share : {0.06, 0.94}) {
    const double u_m = left_m + share * (right_m - left_m);
    AddBox(builder,
           context.palette.pale_metal,
           facade,
           {u_m - 0.015, high_m, kDepth_m + 0.015},
           {u_m + 0.015, high_m + 0.06, kDepth_m + 0.045},
           kFacesSides);
  }
}

}  // namespace pfseq
