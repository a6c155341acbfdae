// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_life.h"

#include "scenes/canyon/shapes.h"
#include "scenes/canyon/street_props.h"
#include "scenes/canyon/tree.h"
#include "scenes/canyon/vehicle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pfseq {
namespace {

/// Things stand within this distance of the drive; people and trees are full of detail up to the
/// second one.
constexpr double kReach_m = 120.0;
constexpr double kFineReach_m = 40.0;
/// Of anything from the middle of the drive.
constexpr double kClear_m = 1.5;
constexpr double kFromKerb_m = 0.5;
/// Free kerb at crossings.
constexpr double kCornerRoom_m = 9.0;

/// One side of a block along a street.
struct Kerb {
  SurfaceFrame frame;  ///< origin at its left end on the pavement, `out` to the street
  double length_m = 0.0;
  double pavement_m = 0.0;
};

Kerb KerbOf(const Block& block, size_t edge) {
  const std::array<Vec2d, 4> corners_m = block.island.Corners();
  const Vec2d from_m = corners_m[edge];
  const Vec2d along_m = corners_m[(edge + 1) % 4] - from_m;
  Kerb kerb;
  kerb.length_m = along_m.norm();
  kerb.frame.origin_m = Lift(from_m, kKerbHeight_m);
  kerb.frame.right = Lift(along_m.normalized(), 0.0);
  kerb.frame.out = Lift(RightOf(along_m.normalized()), 0.0);
  const Vec2d low_gap_m = block.lots.low_m - block.island.low_m;
  const Vec2d high_gap_m = block.island.high_m - block.lots.high_m;
  kerb.pavement_m = edge == kSouth   ? low_gap_m.y()
                    : edge == kEast  ? high_gap_m.x()
                    : edge == kNorth ? high_gap_m.y()
                                     : low_gap_m.x();
  return kerb;
}

double DistanceToDrive(const StreetPlan& plan, const Vec2d& at_m) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Vec2d& point_m : plan.drive_path_m) {
    least_m = std::min(least_m, (point_m - at_m).norm());
  }
  return least_m;
}

/// Whether a rectangle beside the kerb lies on the carriageway, clear of the drive and of all
/// islands.
bool IsFreeRoad(const StreetPlan& plan, const SurfaceFrame& frame, const Vec2d& size_m) {
  std::vector<Vec2d> corners_m;
  for (const auto& [u, w] : {std::array{-0.5, -0.5},
                             std::array{0.5, -0.5},
                             std::array{0.5, 0.5},
                             std::array{-0.5, 0.5}}) {
    corners_m.emplace_back(frame.At(u * size_m.x(), 0.0, w * size_m.y()).head<2>());
  }
  // The frame's (right, out) turn clockwise seen from above.
  std::reverse(corners_m.begin(), corners_m.end());
  if (DistanceToPath(corners_m, plan.drive_path_m) < kClear_m) {
    return false;
  }
  corners_m.emplace_back(frame.origin_m.head<2>());
  return std::all_of(plan.blocks.begin(), plan.blocks.end(), [&](const Block& block) {
    return DistanceToPath(ChamferedRect(block.island, block.island_chamfer_m), corners_m) > 0.1;
  });
}

void ParkVehicles(const BuildContext& context,
                  const Kerb& kerb,
                  const StreetPlan& plan,
                  RandomStream& random) {
  constexpr double kGap_m = 0.12;
  constexpr double kLane_m = 2.6;
  const double occupancy = std::min(0.95, 0.6 * context.street_life);
  double at_m = kCornerRoom_m;
  while (at_m < kerb.length_m - kCornerRoom_m) {
    const double draw = random.Uniform();
    const VehicleKind kind = draw < 0.34   ? VehicleKind::kHatchback
                             : draw < 0.56 ? VehicleKind::kSaloon
                             : draw < 0.76 ? VehicleKind::kOffRoader
                             : draw < 0.95 ? VehicleKind::kVan
                                           : VehicleKind::kLorry;
    const Vec2d size_m = VehicleSize(kind);
    const bool is_there = random.Chance(occupancy);
    SurfaceFrame frame = kerb.frame.MovedTo(at_m + 0.5 * size_m.x(),
                                            -kKerbHeight_m,
                                            kGap_m + random.Uniform(0.0, 0.2) + 0.5 * size_m.y());
    at_m += size_m.x() + random.Uniform(0.5, 1.4);
    RandomStream own(random.Bits());
    // A lane stays free beside it.
    const SurfaceFrame with_lane = frame.MovedTo(0.0, 0.0, 0.5 * kLane_m);
    if (!is_there || at_m > kerb.length_m - kCornerRoom_m ||
        !IsFreeRoad(plan, with_lane, {size_m.x(), size_m.y() + kLane_m})) {
      continue;
    }
    if (own.Chance(0.15)) {
      frame.right = -frame.right;
      frame.out = -frame.out;
    }
    BuildVehicle(context, kind, frame, own);
  }
}

/// What a street's kerb is lined with.
struct KerbPlan {
  bool has_trees = false;
  bool has_bollards = false;
  bool has_lamps = false;
  double tree_height_m = 9.0;
  int leaf = 0;
};

void PlantTree(const BuildContext& context,
               const KerbPlan& kerb_plan,
               const Kerb& kerb,
               const Vec3d& foot_m,
               double distance_m,
               RandomStream& random) {
  TreeDesign design;
  design.height_m = kerb_plan.tree_height_m * random.Uniform(0.8, 1.15);
  // The crown ends before the front behind it.
  design.crown_radius_m = std::min(0.26 * design.height_m, kerb.pavement_m - kFromKerb_m - 0.35);
  design.clear_m = random.Uniform(2.6, 3.4);
  design.leaf = kerb_plan.leaf;
  const double fineness = distance_m < kFineReach_m ? 1.0 : 0.35;
  design.num_leaves = static_cast<int>(fineness * 300.0 * design.crown_radius_m *
                                       (design.height_m - design.clear_m));
  BuildTree(context, design, foot_m, random);
}

/// One thing at a place along the kerb.
void PlaceThing(const BuildContext& context,
                const KerbPlan& kerb_plan,
                const Kerb& kerb,
                const SurfaceFrame& frame,
                int slot,
                double distance_m,
                RandomStream& random) {
  if (kerb_plan.has_lamps && slot % 5 == 2) {
    BuildLampPost(context, frame, 7.0);
    return;
  }
  if (kerb_plan.has_trees && slot % 2 == 0 && kerb.pavement_m > 1.9) {
    PlantTree(context, kerb_plan, kerb, frame.At(0, -0.02, 0), distance_m, random);
    return;
  }
  const double draw = random.Uniform() / std::max(0.05, context.street_life);
  if (draw < 0.16) {
    BuildSignPost(context, frame, random);
  } else if (draw < 0.19 && kerb.pavement_m > 2.3) {
    BuildAdvertisingColumn(context, frame.MovedTo(0, 0, -0.4), random);
  } else if (draw < 0.225 && kerb.pavement_m > 2.3) {
    BuildBusShelter(context, frame.MovedTo(0, 0, 0.2), random);
  } else if (draw < 0.31) {
    BuildCabinet(context, frame, random);
  } else if (draw < 0.5 && kerb_plan.has_bollards) {
    for (const double along_m : {-1.4, 0.0, 1.4}) {
      BuildBollard(context, frame.MovedTo(along_m, 0, 0.15));
    }
  }
}

void PlacePeople(const BuildContext& context,
                 const Kerb& kerb,
                 const StreetPlan& plan,
                 RandomStream& random) {
  const int count =
      static_cast<int>(kerb.length_m / 9.0 * context.street_life * random.Uniform(0.4, 1.2));
  for (int i = 0; i < count; ++i) {
    const double along_m = random.Uniform(3.0, std::max(3.1, kerb.length_m - 3.0));
    const double back_m = random.Uniform(1.1, std::max(1.2, kerb.pavement_m - 0.45));
    const SurfaceFrame frame = kerb.frame.MovedTo(along_m, 0.0, -back_m);
    RandomStream own(random.Bits());
    if (back_m + 0.4 < kerb.pavement_m &&
        DistanceToDrive(plan, frame.origin_m.head<2>()) > kClear_m + 0.4) {
      BuildPerson(context, frame, own);
    }
  }
}

/// Whether a thing of this radius stands on the block's pavement, off the drive and off the lots.
bool IsFreePavement(const Block& block, const StreetPlan& plan, const Vec2d& at_m) {
  const std::vector<Vec2d> island_m = ChamferedRect(block.island, block.island_chamfer_m);
  const std::vector<Vec2d> lots_m = ChamferedRect(block.lots, block.lots_chamfer_m);
  return DistanceToPath(island_m, {at_m}) == 0.0 && DistanceToPath(lots_m, {at_m}) > 0.3 &&
         DistanceToDrive(plan, at_m) > kClear_m + 0.3;
}

void FurnishKerb(const BuildContext& context,
                 const Block& block,
                 size_t edge,
                 const StreetPlan& plan,
                 uint64_t seed) {
  constexpr double kSlot_m = 5.4;
  const Kerb kerb = KerbOf(block, edge);
  RandomStream random({seed, edge});
  KerbPlan kerb_plan;
  kerb_plan.has_trees = random.Chance(std::min(1.0, 0.42 * context.street_life));
  kerb_plan.has_bollards = random.Chance(0.5);
  kerb_plan.has_lamps = edge == kSouth || edge == kEast;
  kerb_plan.tree_height_m = random.Uniform(7.0, 12.0);
  kerb_plan.leaf = Pick(context.palette.leaf, random);
  const int num_slots = static_cast<int>((kerb.length_m - 2.0 * kCornerRoom_m) / kSlot_m);
  for (int slot = 0; slot < num_slots; ++slot) {
    const double along_m =
        kCornerRoom_m + (slot + 0.5) * (kerb.length_m - 2.0 * kCornerRoom_m) / num_slots;
    const SurfaceFrame frame = kerb.frame.MovedTo(along_m, 0.0, -kFromKerb_m);
    RandomStream own(random.Bits());
    const Vec2d at_m = frame.origin_m.head<2>();
    const double distance_m = DistanceToDrive(plan, at_m);
    if (distance_m < kReach_m && IsFreePavement(block, plan, at_m)) {
      PlaceThing(context, kerb_plan, kerb, frame, slot, distance_m, own);
    }
  }
  const double near_m =
      DistanceToPath({kerb.frame.origin_m.head<2>(), kerb.frame.At(kerb.length_m, 0, 0).head<2>()},
                     plan.drive_path_m);
  if (near_m > kReach_m) {
    return;
  }
  if (kerb.length_m > 3.0 * kCornerRoom_m) {
    ParkVehicles(context, kerb, plan, random);
  }
  PlacePeople(context, kerb, plan, random);
  // Lights and signs where streets cross.
  for (const double along_m : {3.8, kerb.length_m - 3.8}) {
    const SurfaceFrame frame = kerb.frame.MovedTo(along_m, 0.0, -0.55);
    RandomStream own(random.Bits());
    if (kerb.length_m > 12.0 && IsFreePavement(block, plan, frame.origin_m.head<2>()) &&
        own.Chance(0.75 * std::min(1.0, context.street_life))) {
      BuildTrafficLight(context, frame, own);
    }
  }
}

}  // namespace

void FurnishBlock(const BuildContext& context,
                  const Block& block,
                  const StreetPlan& plan,
                  uint64_t seed) {
  if (context.street_life <= 0.0) {
    return;
  }
  for (size_t edge = 0; edge < 4; ++edge) {
    if (block.is_street[edge] && !block.is_rim) {
      FurnishKerb(context, block, edge, plan, seed);
    }
  }
}

}  // namespace pfseq
