// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/roof.h"

#include "scenes/canyon/dormer.h"
#include "scenes/canyon/facade.h"
#include "scenes/canyon/roof_props.h"
#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfseq {
namespace {

constexpr double kParapet_m = 0.25;
/// Things on roofs begin this far below the roof's surface.
constexpr double kSunk_m = 0.03;

void BuildLiftHouse(const BuildContext& context,
                    const Building& building,
                    const Vec2d& center_m,
                    double roof_m,
                    RandomStream& random) {
  const Vec2d size_m(random.Uniform(2.4, 3.2), random.Uniform(2.4, 3.2));
  const double top_m = roof_m + random.Uniform(2.4, 3.0);
  AddBlock(context.builder, building.blank_wall, center_m, size_m, roof_m - kSunk_m, top_m);
  AddBox(context.builder,
         context.palette.coping,
         WorldFrame(Lift(center_m, 0.0)),
         {-0.5 * size_m.x() - 0.1, top_m - 0.05, -0.5 * size_m.y() - 0.1},
         {0.5 * size_m.x() + 0.1, top_m + 0.08, 0.5 * size_m.y() + 0.1},
         kFacesAll);
  AddBox(context.builder,
         context.palette.pale_metal,
         WorldFrame(Lift(center_m, 0.0)),
         {-0.45, roof_m - kSunk_m, 0.5 * size_m.y()},
         {0.45, roof_m + 2.05, 0.5 * size_m.y() + 0.03},
         kFacesOnWall);
}

void BuildVents(const BuildContext& context,
                const Vec2d& center_m,
                double roof_m,
                RandomStream& random) {
  const int material = context.palette.pale_metal;
  if (random.Chance(0.5)) {
    // An air handler on its plinth.
    const Vec2d size_m(random.Uniform(1.0, 2.2), random.Uniform(0.8, 1.4));
    AddBlock(
        context.builder, context.palette.coping, center_m, size_m, roof_m - kSunk_m, roof_m + 0.15);
    AddBlock(context.builder,
             material,
             center_m,
             size_m - Vec2d(0.1, 0.1),
             roof_m + 0.14,
             roof_m + random.Uniform(0.9, 1.5));
    return;
  }
  for (int i = 0; i < 3; ++i) {
    const Vec2d at_m = center_m + Vec2d(0.5 * (i - 1), random.Uniform(-0.4, 0.4));
    AddPillar(
        context.builder, material, Lift(at_m, roof_m - kSunk_m), 0.09, random.Uniform(0.4, 0.9), 8);
  }
}

/// Whether the square that the largest thing on a roof takes lies over the house.
bool HasRoomAround(const Building& building, const Vec2d& center_m) {
  constexpr double kHalf_m = 1.75;
  for (const Vec2d& corner : {Vec2d(-kHalf_m, -kHalf_m),
                              Vec2d(kHalf_m, -kHalf_m),
                              Vec2d(kHalf_m, kHalf_m),
                              Vec2d(-kHalf_m, kHalf_m)}) {
    if (DistanceToPath(building.lot.footprint_m, {center_m + corner}) > 0.0) {
      return false;
    }
  }
  return true;
}

/// What stands on a level roof, one thing to each place along its longer side.
void FurnishLevelRoof(const BuildContext& context,
                      const Building& building,
                      double roof_m,
                      const PlanRect& area,
                      RandomStream& random) {
  const Vec2d size_m = area.Size();
  const int axis = size_m.x() >= size_m.y() ? 0 : 1;
  const int num_places = static_cast<int>(std::floor(size_m[axis] / 3.8));
  if (size_m.minCoeff() < 4.0) {
    return;
  }
  const int lift_at =
      building.num_upper_floors >= 4 ? random.Integer(0, std::max(0, num_places - 1)) : -1;
  for (int i = 0; i < num_places; ++i) {
    Vec2d center_m = area.Center();
    center_m[axis] = area.low_m[axis] + size_m[axis] * (i + 0.5) / num_places;
    const double draw = random.Uniform();
    if (!HasRoomAround(building, center_m)) {
      continue;
    }
    if (i == lift_at) {
      BuildLiftHouse(context, building, center_m, roof_m, random);
    } else if (draw < context.Share(0.4)) {
      BuildVents(context, center_m, roof_m, random);
    } else if (draw > 1.0 - context.Share(0.35)) {
      const double top_m = roof_m + random.Uniform(1.2, 2.0);
      BuildChimney(context,
                   context.palette.brick[0],
                   center_m,
                   {0.55, random.Uniform(0.8, 1.6)},
                   roof_m - kSunk_m,
                   top_m,
                   random);
      BuildAntenna(context, Lift(center_m + Vec2d(1.1, 0.0), roof_m - kSunk_m), random);
    }
  }
}

PlanRect Shrunk(const PlanRect& rect, double by_m) {
  return {rect.low_m + Vec2d::Constant(by_m), rect.high_m - Vec2d::Constant(by_m)};
}

void BuildFlatRoof(const BuildContext& context, const Building& building, RandomStream& random) {
  MeshBuilder& builder = context.builder;
  const std::vector<Vec2d>& outer_m = building.lot.footprint_m;
  const std::vector<double> thickness_m(outer_m.size(), kParapet_m);
  const std::vector<Vec2d> inner_m = InsetPolygon(outer_m, thickness_m);
  const double top_m = building.eave_m;
  const double roof_m = top_m - building.roof_rise_m;
  for (size_t i = 0; i < outer_m.size(); ++i) {
    const size_t next = (i + 1) % outer_m.size();
    builder.Quad(context.palette.coping,
                 Lift(outer_m[i], top_m),
                 Lift(outer_m[next], top_m),
                 Lift(inner_m[next], top_m),
                 Lift(inner_m[i], top_m));
    builder.Quad(building.blank_wall,
                 Lift(inner_m[next], roof_m),
                 Lift(inner_m[i], roof_m),
                 Lift(inner_m[i], top_m),
                 Lift(inner_m[next], top_m));
  }
  AddLevelPolygon(builder, building.roof_material, inner_m, roof_m);
  if (context.detail > 0.0) {
    FurnishLevelRoof(context, building, roof_m, Shrunk(BoundsOf(building), 1.6), random);
  }
}

void BuildMansardRoof(const BuildContext& context,
                      const Building& building,
                      const std::vector<Lod>& lods,
                      RandomStream& random) {
  MeshBuilder& builder = context.builder;
  const std::vector<Vec2d>& outer_m = building.lot.footprint_m;
  const std::vector<Vec2d> inner_m = MansardTop(building);
  const double eave_m = building.eave_m;
  const double top_m = eave_m + building.roof_rise_m;
  for (size_t i = 0; i < outer_m.size(); ++i) {
    if (building.lot.edges[i] != EdgeKind::kStreet) {
      continue;
    }
    const size_t next = (i + 1) % outer_m.size();
    builder.Quad(building.roof_material,
                 Lift(outer_m[i], eave_m),
                 Lift(outer_m[next], eave_m),
                 Lift(inner_m[next], top_m),
                 Lift(inner_m[i], top_m));
    if (EdgeLength(building, i) > 4.5) {
      const RoofSlope slope{building.roof_rise_m / building.mansard_inset_m, building.roof_rise_m};
      BuildDormers(context, building, i, slope, 1, 1.0, lods[i], random);
    }
  }
  AddLevelPolygon(builder, context.palette.roof_metal, inner_m, top_m);
  if (context.detail > 0.0) {
    FurnishLevelRoof(context,
                     building,
                     top_m,
                     Shrunk(BoundsOf(building), building.mansard_inset_m + 0.9),
                     random);
  }
}

void BuildGableChimneys(const BuildContext& context,
                        const Building& building,
                        RandomStream& random) {
  const PlanRect bounds = BoundsOf(building);
  const bool along_x = building.lot.street_along_x;
  const int axis = along_x ? 0 : 1;
  const double half_m = 0.5 * bounds.Size()[1 - axis];
  const double slope = building.roof_rise_m / half_m;
  for (const double from_end_m : {0.75, bounds.Size()[axis] - 0.75}) {
    if (!random.Chance(0.75) || bounds.Size()[axis] < 5.0) {
      continue;
    }
    const double across_m = random.Uniform(-0.45, 0.45) * half_m;
    const double length_m = random.Uniform(0.7, 1.6);
    Vec2d center_m = bounds.Center();
    center_m[axis] = bounds.low_m[axis] + from_end_m;
    center_m[1 - axis] += across_m;
    const double ridge_m = building.eave_m + building.roof_rise_m;
    const double foot_m = ridge_m - slope * (std::abs(across_m) + 0.5 * length_m) - 0.15;
    BuildChimney(context,
                 context.palette.brick[building.seed % 3],
                 center_m,
                 along_x ? Vec2d(0.55, length_m) : Vec2d(length_m, 0.55),
                 foot_m,
                 ridge_m + random.Uniform(0.5, 1.1),
                 random);
  }
}

void BuildGableRoof(const BuildContext& context,
                    const Building& building,
                    const std::vector<Lod>& lods,
                    RandomStream& random) {
  MeshBuilder& builder = context.builder;
  const PlanRect bounds = BoundsOf(building);
  const double eave_m = building.eave_m;
  const double ridge_m = eave_m + building.roof_rise_m;
  const Vec2d middle_m = bounds.Center();
  const auto [x0, y0] = std::array{bounds.low_m.x(), bounds.low_m.y()};
  const auto [x1, y1] = std::array{bounds.high_m.x(), bounds.high_m.y()};
  const int material = building.roof_material;
  if (building.lot.street_along_x) {
    const double y = middle_m.y();
    builder.Quad(material, {x0, y0, eave_m}, {x1, y0, eave_m}, {x1, y, ridge_m}, {x0, y, ridge_m});
    builder.Quad(material, {x1, y1, eave_m}, {x0, y1, eave_m}, {x0, y, ridge_m}, {x1, y, ridge_m});
  } else {
    const double x = middle_m.x();
    builder.Quad(material, {x1, y0, eave_m}, {x1, y1, eave_m}, {x, y1, ridge_m}, {x, y0, ridge_m});
    builder.Quad(material, {x0, y1, eave_m}, {x0, y0, eave_m}, {x, y0, ridge_m}, {x, y1, ridge_m});
  }
  if (context.detail <= 0.0) {
    return;
  }
  const double half_depth_m =
      0.5 * (building.lot.street_along_x ? bounds.Size().y() : bounds.Size().x());
  const RoofSlope slope{building.roof_rise_m / half_depth_m, building.roof_rise_m};
  const bool has_dormers = random.Chance(context.Share(0.75));
  for (size_t i = 0; i < lods.size(); ++i) {
    if (has_dormers && building.lot.edges[i] != EdgeKind::kParty && lods[i] != Lod::kFlush) {
      BuildDormers(context, building, i, slope, 2, 0.8, lods[i], random);
    }
  }
  BuildGableChimneys(context, building, random);
}

}  // namespace

void BuildRoof(const BuildContext& context,
               const Building& building,
               const std::vector<Lod>& lods) {
  RandomStream random({building.seed, 30});
  switch (building.roof) {
    case RoofKind::kFlat:
      BuildFlatRoof(context, building, random);
      break;
    case RoofKind::kMansard:
      BuildMansardRoof(context, building, lods, random);
      break;
    case RoofKind::kGable:
      BuildGableRoof(context, building, lods, random);
      break;
  }
  if (context.detail > 0.0) {
    BuildRoofline(context, building, lods);
  }
}

}  // namespace pfseq
