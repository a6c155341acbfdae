// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/city.h"

#include "renderer/core/check.h"
#include "scenes/canyon/block_subdivision.h"
#include "scenes/canyon/building.h"
#include "scenes/canyon/facade.h"
#include "scenes/canyon/party_wall.h"
#include "scenes/canyon/roof.h"
#include "scenes/canyon/street_life.h"
#include "scenes/canyon/street_plan.h"
#include "scenes/canyon/street_surface.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// A front in sight of the drive is fine up to the first, medium up to the second distance.
constexpr double kFineReach_m = 28.0;
constexpr double kMediumReach_m = 85.0;
/// Blocks further than this from the drive share their meshes.
constexpr double kOwnMeshesReach_m = 45.0;
/// A front is in sight only from points this far before it.
constexpr double kLeastBefore_m = 0.5;

/// The least distance of an edge's ends and middle from those points of the drive that lie before
/// it.
double SightDistance(const SurfaceFrame& facade, double width_m, const std::vector<Vec2d>& path_m) {
  double least_m = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < path_m.size(); i += 4) {
    const Vec3d from_origin_m = Lift(path_m[i], 0.0) - facade.origin_m;
    if (from_origin_m.dot(facade.out) < kLeastBefore_m) {
      continue;
    }
    const double along_m = std::clamp(from_origin_m.dot(facade.right), 0.0, width_m);
    least_m = std::min(least_m, (from_origin_m - along_m * facade.right).norm());
  }
  return least_m;
}

void SetSightDistances(const StreetPlan& plan, Building& building) {
  for (size_t edge = 0; edge < building.lot.edges.size(); ++edge) {
    building.sight_m.push_back(
        SightDistance(FrameOfEdge(building, edge), EdgeLength(building, edge), plan.drive_path_m));
  }
}

std::vector<Lod> LodsOf(const Building& building) {
  std::vector<Lod> lods;
  for (size_t edge = 0; edge < building.lot.edges.size(); ++edge) {
    if (building.lot.edges[edge] != EdgeKind::kStreet) {
      lods.push_back(Lod::kFlush);
      continue;
    }
    const double distance_m = building.sight_m[edge];
    lods.push_back(distance_m < kFineReach_m     ? Lod::kFine
                   : distance_m < kMediumReach_m ? Lod::kMedium
                                                 : Lod::kCoarse);
  }
  return lods;
}

void CountBuilding(const Building& building, CanyonStats& stats) {
  stats.least_height_m =
      stats.num_buildings == 0 ? building.eave_m : std::min(stats.least_height_m, building.eave_m);
  stats.greatest_height_m = std::max(stats.greatest_height_m, building.eave_m);
  ++stats.num_buildings;
  ++stats.buildings_by_style[building.photo ? "photo" : std::string(NameOf(building.style))];
  ++stats.buildings_by_roof[std::string(NameOf(building.roof))];
  stats.num_floors += building.num_upper_floors + 1;
}

/// Gives a house a photograph that fits its height, and takes away what would hide it.
void UsePhoto(const FacadePhotos& photos, Building& building) {
  building.photo = ChoosePhoto(photos, building.eave_m, building.seed);
  if (building.photo) {
    building.balcony = BalconyPattern::kNone;
    building.has_string_courses = false;
    building.cornice_m = building.style == FacadeStyle::kGlass ? 0.0 : 0.2;
  }
}

std::vector<Building> DesignBlock(const Block& block,
                                  const FacadePhotos* photos,
                                  const CanyonSpec& canyon,
                                  const StreetPlan& plan,
                                  const Palette& palette,
                                  uint64_t seed) {
  RandomStream random({seed, 1});
  BlockCharacter character;
  character.modernity = random.Chance(0.12) ? random.Uniform(0.5, 0.9) : random.Uniform(0.05, 0.25);
  character.height_share = random.Uniform(0.2, 1.0);
  const std::vector<Lot> lots = SubdivideBlock(block, plan.drive_path_m, RandomStream({seed, 2}));
  std::vector<Building> houses;
  for (size_t i = 0; i < lots.size(); ++i) {
    houses.push_back(DesignBuilding(lots[i], canyon, character, palette, HashKey({seed, 3, i})));
    if (photos != nullptr) {
      UsePhoto(*photos, houses.back());
    }
  }
  return houses;
}

void BuildBlock(const BuildContext& context,
                const Block& block,
                const CanyonSpec& canyon,
                const StreetPlan& plan,
                size_t block_idx) {
  const bool has_own_meshes =
      DistanceToPath(ChamferedRect(block.island, {}), plan.drive_path_m) < kOwnMeshesReach_m;
  context.builder.BeginGroup(has_own_meshes ? fmt::format("block_{}", block_idx)
                             : block.is_rim ? "rim"
                                            : fmt::format("district_{}", block_idx % 4));
  context.builder.SetTextureOffset(Vec2d::Zero());
  BuildPavement(context, block);
  FurnishBlock(context, block, plan, HashKey({canyon.seed, 5, block_idx}));
  std::vector<Building> houses = DesignBlock(
      block, context.photos, canyon, plan, context.palette, HashKey({canyon.seed, 4, block_idx}));
  for (size_t i = 0; i < houses.size(); ++i) {
    RandomStream random({houses[i].seed, 40});
    context.builder.SetTextureOffset({random.Uniform(0.0, 8.0), random.Uniform(0.0, 8.0)});
    CountBuilding(houses[i], context.stats);
    SetSightDistances(plan, houses[i]);
    const std::vector<Lod> lods = LodsOf(houses[i]);
    BuildFacades(context, houses[i], lods);
    BuildBlankWalls(houses, i, context.builder);
    BuildRoof(context, houses[i], lods);
  }
}

}  // namespace

void BuildCity(const BuildContext& context, const CanyonSpec& canyon, const DriveSpec& drive) {
  const StreetPlan plan = PlanStreets(canyon, drive);
  context.builder.BeginGroup("streets");
  BuildCarriageways(context, plan);
  for (size_t i = 0; i < plan.blocks.size(); ++i) {
    BuildBlock(context, plan.blocks[i], canyon, plan, i);
  }
  context.builder.BeginGroup("wires");
  HangWires(context, plan, HashKey({canyon.seed, 6}));
  context.stats.num_blocks = static_cast<int>(plan.blocks.size());
}

}  // namespace pfseq
