// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/roof_props.h"

#include "scenes/canyon/facade.h"
#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfseq {
namespace {

/// Things on roofs begin this far below the roof's surface.
constexpr double kSunk_m = 0.03;

/// A dish that looks up and to the street: a shallow cone of sheet on an arm of this length, both
/// sides built.
void BuildDish(const BuildContext& context,
               const SurfaceFrame& frame,
               double arm_m,
               double radius_m) {
  MeshBuilder& builder = context.builder;
  const int metal = context.palette.pale_metal;
  AddBox(builder, metal, frame, {-0.02, -arm_m, -0.02}, {0.02, 0.02, 0.02}, kFacesSides | kFaceTop);
  const Vec3d axis = (frame.out + 0.7 * frame.up + 0.5 * frame.right).normalized();
  const Vec3d side = axis.cross(Vec3d::UnitZ()).normalized();
  const Vec3d up = side.cross(axis);
  constexpr int kSides = 9;
  const Vec3d hub_m = frame.At(0, 0.03, 0);
  const auto rim = [&](int i) {
    const double angle_rad = 2.0 * 3.14159265358979 * i / kSides;
    return Vec3d(hub_m + 0.3 * radius_m * axis +
                 radius_m * (std::cos(angle_rad) * side + std::sin(angle_rad) * up));
  };
  const Vec3d behind_m = hub_m - 0.015 * axis;
  for (int i = 0; i < kSides; ++i) {
    // (side, up, -axis) is right-handed: the hollow side shows the rim clockwise.
    builder.Polygon(metal, std::array<Vec3d, 3>{hub_m, rim(i + 1), rim(i)});
    builder.Polygon(metal, std::array<Vec3d, 3>{behind_m, rim(i), rim(i + 1)});
  }
}

/// Rails on posts along the parapet, seen against the sky.
void BuildParapetRail(const BuildContext& context, const SurfaceFrame& front, double width_m) {
  MeshBuilder& builder = context.builder;
  const int metal = context.palette.railing;
  constexpr double kBehind_m = -0.14;
  for (const double level_m : {0.5, 0.95}) {
    AddBox(builder,
           metal,
           front,
           {0.3, level_m - 0.018, kBehind_m - 0.018},
           {width_m - 0.3, level_m + 0.018, kBehind_m + 0.018},
           kFacesAll);
  }
  const int count = std::max(2, static_cast<int>(width_m / 1.6));
  for (int i = 0; i <= count; ++i) {
    const double u = 0.3 + (width_m - 0.6) * i / count;
    AddBox(builder,
           metal,
           front,
           {u - 0.02, -kSunk_m, kBehind_m - 0.022},
           {u + 0.02, 1.0, kBehind_m + 0.022},
           kFacesSides | kFaceTop);
  }
}

/// Urns or balls on blocks over the cornice.
void BuildFinials(const BuildContext& context,
                  int trim,
                  const SurfaceFrame& front,
                  double width_m,
                  double spacing_m,
                  RandomStream& random) {
  const bool is_urn = random.Chance(0.5);
  const int count = std::max(2, static_cast<int>(std::lround(width_m / spacing_m)));
  for (int i = 0; i < count; ++i) {
    const double u = width_m * (i + 0.5) / count;
    const SurfaceFrame at = front.MovedTo(u, 0.0, -0.13);
    AddBox(context.builder,
           trim,
           at,
           {-0.2, -kSunk_m, -0.11},
           {0.2, 0.42, 0.1},
           kFacesSides | kFaceTop);
    AddPillar(context.builder, trim, at.At(0, 0.4, 0), 0.07, 0.16, 6);
    // Wider than its foot: seen from the street, its bottom shows.
    AddPillar(context.builder,
              trim,
              at.At(0, 0.55, 0),
              is_urn ? 0.15 : 0.12,
              is_urn ? 0.3 : 0.2,
              8,
              true);
    AddPillar(context.builder, trim, at.At(0, 0.74, 0), 0.06, is_urn ? 0.3 : 0.1, 6);
  }
}

}  // namespace

/// The upright frame with the world's axes at a point: right is +X, out is -Y.
SurfaceFrame WorldFrame(const Vec3d& origin_m) {
  SurfaceFrame frame;
  frame.origin_m = origin_m;
  return frame;
}

/// A box over a rectangle of the plane, [low, high] in z.
void AddBlock(MeshBuilder& builder,
              int material_idx,
              const Vec2d& center_m,
              const Vec2d& size_m,
              double low_m,
              double high_m) {
  AddBox(builder,
         material_idx,
         WorldFrame(Lift(center_m, 0.0)),
         {-0.5 * size_m.x(), low_m, -0.5 * size_m.y()},
         {0.5 * size_m.x(), high_m, 0.5 * size_m.y()},
         kFacesSides | kFaceTop);
}

void BuildChimney(const BuildContext& context,
                  int wall,
                  const Vec2d& center_m,
                  const Vec2d& size_m,
                  double foot_m,
                  double top_m,
                  RandomStream& random) {
  MeshBuilder& builder = context.builder;
  ++context.stats.num_chimneys;
  AddBlock(builder, wall, center_m, size_m, foot_m, top_m);
  AddBox(builder,
         context.palette.coping,
         WorldFrame(Lift(center_m, 0.0)),
         {-0.5 * size_m.x() - 0.06, top_m - 0.04, -0.5 * size_m.y() - 0.06},
         {0.5 * size_m.x() + 0.06, top_m + 0.07, 0.5 * size_m.y() + 0.06},
         kFacesAll);
  const bool along_x = size_m.x() > size_m.y();
  const double length_m = along_x ? size_m.x() : size_m.y();
  const int num_pots = std::max(1, static_cast<int>(std::floor(length_m / 0.38)));
  for (int i = 0; i < num_pots; ++i) {
    const double along_m = (i - 0.5 * (num_pots - 1)) * 0.36;
    const Vec2d at_m = center_m + (along_x ? Vec2d(along_m, 0.0) : Vec2d(0.0, along_m));
    AddPillar(builder,
              context.palette.chimney_pot,
              Lift(at_m, top_m + 0.05),
              0.11,
              random.Uniform(0.35, 0.6),
              8);
  }
}

void BuildAntenna(const BuildContext& context, const Vec3d& foot_m, RandomStream& random) {
  const double height_m = random.Uniform(1.8, 3.6);
  const int material = context.palette.pale_metal;
  AddPillar(context.builder, material, foot_m, 0.024, height_m, 5);
  for (int aerial = random.Integer(1, 2); aerial > 0; --aerial) {
    SurfaceFrame frame = WorldFrame(foot_m + Vec3d(0, 0, height_m - 0.12 - 0.55 * (aerial - 1)));
    const double turn_rad = random.Uniform(0.0, 6.28);
    frame.right = Vec3d(std::cos(turn_rad), std::sin(turn_rad), 0.0);
    frame.out = frame.right.cross(frame.up);
    // A boom with elements that grow shorter to the front.
    AddBox(
        context.builder, material, frame, {-0.45, -0.012, -0.012}, {0.75, 0.012, 0.012}, kFacesAll);
    const int num_elements = random.Integer(5, 8);
    for (int i = 0; i < num_elements; ++i) {
      const double u = -0.42 + 1.12 * i / (num_elements - 1);
      const double half_m = 0.42 - 0.03 * i;
      AddBox(context.builder,
             material,
             frame,
             {u - 0.008, -0.008, -half_m},
             {u + 0.008, 0.008, half_m},
             kFacesAll);
    }
  }
}

void BuildRoofline(const BuildContext& context,
                   const Building& building,
                   const std::vector<Lod>& lods) {
  RandomStream random({building.seed, 31});
  const size_t count = building.lot.edges.size();
  const bool is_gable = building.roof == RoofKind::kGable;
  const bool is_flat = building.roof == RoofKind::kFlat;
  const bool is_old =
      building.style != FacadeStyle::kGlass && building.style != FacadeStyle::kConcrete;
  const bool has_rail = is_flat && random.Chance(context.Share(is_old ? 0.2 : 0.5));
  const bool has_finials = is_flat && is_old && !has_rail && random.Chance(context.Share(0.4));
  const double stack_share = context.Share(is_old ? 0.8 : 0.25);
  for (size_t edge = 0; edge < count; ++edge) {
    const double width_m = EdgeLength(building, edge);
    RandomStream own({building.seed, 32, edge});
    if (building.lot.edges[edge] != EdgeKind::kStreet || lods[edge] > Lod::kMedium ||
        width_m < 4.0 || is_gable) {
      continue;
    }
    const SurfaceFrame front = FrameOfEdge(building, edge).MovedTo(0.0, building.eave_m, 0.0);
    if (has_rail) {
      BuildParapetRail(context, front, width_m);
    }
    if (has_finials) {
      BuildFinials(context, building.trim, front, width_m, building.bay_width_m * 1.5, own);
    }
    const double foot_m =
        is_flat ? building.eave_m - building.roof_rise_m - kSunk_m : building.eave_m - 0.1;
    const double top_m = is_flat ? building.eave_m + own.Uniform(0.9, 2.2)
                                 : building.eave_m + building.roof_rise_m + own.Uniform(0.5, 1.4);
    for (const bool is_right : {false, true}) {
      const EdgeKind beside = building.lot.edges[(edge + (is_right ? 1 : count - 1)) % count];
      const double length_m = own.Uniform(0.9, 2.4);
      const double back_m = own.Uniform(is_flat ? 0.7 : 0.45, is_flat ? 1.6 : 0.8) + 0.5 * length_m;
      RandomStream stack(own.Bits());
      if (beside != EdgeKind::kParty || !stack.Chance(stack_share)) {
        continue;
      }
      const double u = is_right ? width_m - 0.36 : 0.36;
      const Vec2d center_m = front.At(u, 0.0, -back_m).head<2>();
      const bool along_x = std::abs(front.right.x()) > 0.5;
      BuildChimney(context,
                   is_old ? context.palette.brick[building.seed % context.palette.brick.size()]
                          : building.blank_wall,
                   center_m,
                   along_x ? Vec2d(0.58, length_m) : Vec2d(length_m, 0.58),
                   foot_m,
                   top_m,
                   stack);
      if (stack.Chance(0.5)) {
        BuildAntenna(context, Lift(center_m, top_m + 0.05), stack);
      }
    }
    for (int i = own.Integer(0, 2); is_flat && i > 0; --i) {
      const double u = own.Uniform(1.2, std::max(1.3, width_m - 1.2));
      constexpr double kAboveParapet_m = 0.45;
      const SurfaceFrame at = front.MovedTo(u, kAboveParapet_m, own.Uniform(-0.9, -0.5));
      BuildDish(
          context, at, kAboveParapet_m + building.roof_rise_m + kSunk_m, own.Uniform(0.28, 0.45));
      BuildAntenna(context,
                   front.At(own.Uniform(1.0, width_m - 1.0),
                            -building.roof_rise_m - kSunk_m,
                            -own.Uniform(1.0, 2.2)),
                   own);
    }
  }
}

}  // namespace pfseq
