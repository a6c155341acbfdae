// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_plan.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "renderer/sequence/sequence_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace pfseq {
namespace {

/// The city must end within this distance of the drive's bounding box.
constexpr double kGreatestReach_m = 440.0;
constexpr double kRimDepth_m = 14.0;
constexpr double kRimApron_m = 0.5;
/// From the drive's centre line: half a car and a margin to the kerb, and the pavement that is left
/// at the least.
constexpr double kKerbClearance_m = 1.6;
constexpr double kLeastPavement_m = 1.2;
constexpr double kHalfCar_m = 1.05;
/// The rig is as long as this behind the path's start.
constexpr double kBehindStart_m = 3.0;

struct Span {
  double low_m = 0.0;
  double high_m = 0.0;
};

void CheckSpec(const CanyonSpec& canyon) {
  const auto [narrow_m, wide_m] = canyon.street_width_m;
  if (!(narrow_m >= 4.0 && wide_m >= narrow_m && wide_m <= 100.0)) {
    throw InputError(
        "scene.canyon.street_width_m: expected 4 <= least <= greatest <= 100, got {} {}",
        narrow_m,
        wide_m);
  }
  const auto [low_m, high_m] = canyon.building_height_m;
  if (!(low_m >= 3.0 && high_m >= low_m && high_m <= 300.0)) {
    throw InputError(
        "scene.canyon.building_height_m: expected 3 <= least <= greatest <= 300, got {} {}",
        low_m,
        high_m);
  }
  if (!(canyon.detail >= 0.0 && canyon.detail <= 2.0)) {
    throw InputError("scene.canyon.detail: expected 0 to 2, got {}", canyon.detail);
  }
  if (!(canyon.relief > 0.0 && canyon.relief <= 1.0)) {
    throw InputError("scene.canyon.relief: expected above 0 to 1, got {}", canyon.relief);
  }
  const auto check_share = [](std::string_view key, double share) {
    if (!(share >= 0.0 && share <= 1.0)) {
      throw InputError("scene.canyon.{}: expected 0 to 1, got {}", key, share);
    }
  };
  check_share("small_panes", canyon.small_panes);
  check_share("rubble", canyon.rubble);
  check_share("pitched_roof_share", canyon.pitched_roof_share);
  if (canyon.surrounding_blocks < 0) {
    throw InputError("scene.canyon.surrounding_blocks: expected >= 0, got {}",
                     canyon.surrounding_blocks);
  }
}

Street MakeStreet(double center_m, const CanyonSpec& canyon, RandomStream& random) {
  Street street;
  street.center_m = center_m;
  // Whole decimetres: building lines then fall on short decimal figures.
  street.width_m =
      std::round(random.Uniform(canyon.street_width_m[0], canyon.street_width_m[1]) * 10.0) / 10.0;
  street.pavement_m = std::min(0.17 * street.width_m, 4.5);
  return street;
}

/// Streets on one axis: those of the drive at `fixed_m` (ascending), so many beyond them that
/// `around` rows of blocks surround the span of the drive.
std::vector<Street> PlaceStreets(const std::vector<double>& fixed_m,
                                 const Span& drive_span,
                                 const CanyonSpec& canyon,
                                 const Vec2d& block_length_m,
                                 RandomStream random) {
  std::vector<Street> streets;
  for (const double center_m : fixed_m) {
    streets.push_back(MakeStreet(center_m, canyon, random));
  }
  const double stride_reserve_m = block_length_m.y() + 2.0 * canyon.street_width_m[1] + kRimDepth_m;
  const auto extend = [&](double from_m, double sign, double limit_m) {
    double center_m = from_m;
    int num_beyond = 0;
    // The drive's end must lie before the last street; beyond that, as many rows as fit.
    while (sign * (center_m - limit_m) < 0.0 ||
           (num_beyond < canyon.surrounding_blocks &&
            sign * (center_m - limit_m) + stride_reserve_m < kGreatestReach_m)) {
      center_m += sign * std::round(random.Uniform(block_length_m.x(), block_length_m.y()) +
                                    canyon.street_width_m[1]);
      streets.push_back(MakeStreet(center_m, canyon, random));
      // Rows count only from where the drive's end lies inside a block.
      if (sign * (center_m - limit_m) > 0.5 * canyon.street_width_m[1]) {
        ++num_beyond;
      }
    }
  };
  extend(fixed_m.front(), -1.0, drive_span.low_m);
  extend(fixed_m.back(), 1.0, drive_span.high_m);
  std::sort(streets.begin(), streets.end(), [](const Street& a, const Street& b) {
    return a.center_m < b.center_m;
  });
  return streets;
}

/// Positive when the point lies to the right of the line from a to b.
double RightHandSide(const Vec2d& a_m, const Vec2d& b_m, const Vec2d& point_m) {
  const Vec2d along_m = b_m - a_m;
  const Vec2d to_point_m = point_m - a_m;
  return along_m.y() * to_point_m.x() - along_m.x() * to_point_m.y();
}

double PointSegmentDistance(const Vec2d& point_m, const Vec2d& a_m, const Vec2d& b_m) {
  const Vec2d along_m = b_m - a_m;
  const double length2 = along_m.squaredNorm();
  const double t =
      length2 > 0.0 ? std::clamp((point_m - a_m).dot(along_m) / length2, 0.0, 1.0) : 0.0;
  return (point_m - a_m - t * along_m).norm();
}

/// The least cut at a corner, not under `least_m`, with which that quarter of the rectangle keeps
/// `clearance_m` from the path.
double ClearChamfer(const PlanRect& rect,
                    size_t corner,
                    double least_m,
                    double clearance_m,
                    const std::vector<Vec2d>& path_m) {
  const Vec2d center_m = rect.Center();
  const Vec2d to_corner_m = rect.Corners()[corner] - center_m;
  std::vector<Vec2d> near_path_m;
  for (const Vec2d& point_m : path_m) {
    if ((point_m - center_m).cwiseProduct(to_corner_m).minCoeff() >= 0.0) {
      near_path_m.push_back(point_m);
    }
  }
  const double most_m = 0.95 * rect.Size().minCoeff();
  for (double chamfer_m = least_m; chamfer_m < most_m; chamfer_m += 0.5) {
    std::array<double, 4> chamfers_m = {};
    chamfers_m[corner] = chamfer_m;
    if (DistanceToPath(ChamferedRect(rect, chamfers_m), near_path_m) >= clearance_m) {
      return chamfer_m;
    }
  }
  return std::max(most_m, 0.0);
}

/// Cuts the corners between streets: some for their looks, those in the drive's way as needed.
void ChamferBlock(const std::vector<Vec2d>& path_m,
                  double narrowest_street_m,
                  RandomStream& random,
                  Block& block) {
  const bool often_cut = random.Chance(0.3);
  const bool near_path = DistanceToPath(ChamferedRect(block.island, {}), path_m) < 4.0;
  // In the narrowest streets even straight kerbs and fronts are nearer than that.
  const double kerb_m = std::min(kKerbClearance_m, 0.32 * narrowest_street_m);
  const double front_m = std::min(kKerbClearance_m + kLeastPavement_m, 0.49 * narrowest_street_m);
  for (size_t corner = 0; corner < 4; ++corner) {
    const bool is_cut = random.Chance(often_cut ? 0.85 : 0.12);
    const double cut_m = is_cut ? random.Uniform(2.2, 3.4) : 0.0;
    if (!block.is_street[corner] || !block.is_street[(corner + 3) % 4]) {
      continue;
    }
    block.lots_chamfer_m[corner] = cut_m;
    if (near_path) {
      block.island_chamfer_m[corner] = ClearChamfer(block.island, corner, 0.0, kerb_m, path_m);
      block.lots_chamfer_m[corner] = ClearChamfer(block.lots, corner, cut_m, front_m, path_m);
    }
  }
}

Block MakeBlock(const Span& x, const Span& y, const std::array<double, 4>& pavement_m) {
  Block block;
  block.lots = {Vec2d(x.low_m, y.low_m), Vec2d(x.high_m, y.high_m)};
  block.island = {block.lots.low_m - Vec2d(pavement_m[kWest], pavement_m[kSouth]),
                  block.lots.high_m + Vec2d(pavement_m[kEast], pavement_m[kNorth])};
  return block;
}

void AddBlocks(double narrowest_street_m, RandomStream random, StreetPlan& plan) {
  for (size_t i = 0; i + 1 < plan.streets_along_y.size(); ++i) {
    for (size_t j = 0; j + 1 < plan.streets_along_x.size(); ++j) {
      const Street& west = plan.streets_along_y[i];
      const Street& east = plan.streets_along_y[i + 1];
      const Street& south = plan.streets_along_x[j];
      const Street& north = plan.streets_along_x[j + 1];
      Block block =
          MakeBlock({west.HighFacade(), east.LowFacade()},
                    {south.HighFacade(), north.LowFacade()},
                    {south.pavement_m, east.pavement_m, north.pavement_m, west.pavement_m});
      if (block.island.Size().minCoeff() < 1.0) {
        continue;
      }
      // Too flat for lots: the island stays, empty.
      if (block.lots.Size().minCoeff() < 0.0) {
        block.lots = {block.island.Center(), block.island.Center()};
      }
      ChamferBlock(plan.drive_path_m, narrowest_street_m, random, block);
      // An island that no cut takes out of the way is left out.
      if (DistanceToPath(ChamferedRect(block.island, block.island_chamfer_m), plan.drive_path_m) >=
          kHalfCar_m) {
        plan.blocks.push_back(block);
      }
    }
  }
}

/// A closed ring of houses around the last streets, so that every street's view ends at a wall.
void AddRim(StreetPlan& plan) {
  const Street& south = plan.streets_along_x.front();
  const Street& north = plan.streets_along_x.back();
  const Street& west = plan.streets_along_y.front();
  const Street& east = plan.streets_along_y.back();
  const Span x{west.LowFacade(), east.HighFacade()};
  const Span y{south.LowFacade(), north.HighFacade()};
  // West and east overlap the others' ends by this much, behind a slot that nobody sees into.
  constexpr double kOverlap_m = 4.0;
  constexpr double kSlot_m = 0.05;
  const Span y_long{y.low_m - kOverlap_m, y.high_m + kOverlap_m};
  const Span x_short{x.low_m + kSlot_m, x.high_m - kSlot_m};
  // Pavements reach under the houses and a little beyond; they meet without overlapping.
  const double back_m = kRimDepth_m + kRimApron_m;
  const double west_kerb_m = x.low_m + west.pavement_m;
  const double east_kerb_m = x.high_m - east.pavement_m;
  const auto add = [&](const PlanRect& lots, const PlanRect& island, BlockEdge edge) {
    Block block;
    block.lots = lots;
    block.island = island;
    block.is_street = {};
    block.is_street[edge] = true;
    block.is_rim = true;
    plan.blocks.push_back(block);
  };
  add({{x.low_m - kRimDepth_m, y_long.low_m}, {x.low_m, y_long.high_m}},
      {{x.low_m - back_m, y.low_m - back_m}, {west_kerb_m, y.high_m + back_m}},
      kEast);
  add({{x.high_m, y_long.low_m}, {x.high_m + kRimDepth_m, y_long.high_m}},
      {{east_kerb_m, y.low_m - back_m}, {x.high_m + back_m, y.high_m + back_m}},
      kWest);
  add({{x_short.low_m, y.low_m - kRimDepth_m}, {x_short.high_m, y.low_m}},
      {{west_kerb_m, y.low_m - back_m}, {east_kerb_m, y.low_m + south.pavement_m}},
      kNorth);
  add({{x_short.low_m, y.high_m}, {x_short.high_m, y.high_m + kRimDepth_m}},
      {{west_kerb_m, y.high_m - north.pavement_m}, {east_kerb_m, y.high_m + back_m}},
      kSouth);
  plan.extent = {Vec2d(x.low_m - back_m, y.low_m - back_m),
                 Vec2d(x.high_m + back_m, y.high_m + back_m)};
}

}  // namespace

std::vector<Vec2d> SampleDrivePath(const DriveSpec& drive, double spacing_m) {
  const DrivePath path = MakeDrivePath(drive);
  const int count = std::max(1, static_cast<int>(std::ceil(path.LengthM() / spacing_m)));
  std::vector<Vec2d> points_m;
  for (int i = 0; i <= count; ++i) {
    const double way_m = path.LengthM() * i / count;
    points_m.emplace_back(path.WorldFromCar(way_m).translation_m.head<2>());
  }
  return points_m;
}

double DistanceToPath(const std::vector<Vec2d>& polygon_m, const std::vector<Vec2d>& path_m) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Vec2d& point_m : path_m) {
    bool is_inside = true;
    for (size_t i = 0; i < polygon_m.size(); ++i) {
      const Vec2d& a_m = polygon_m[i];
      const Vec2d& b_m = polygon_m[(i + 1) % polygon_m.size()];
      is_inside = is_inside && RightHandSide(a_m, b_m, point_m) <= 0.0;
      least_m = std::min(least_m, PointSegmentDistance(point_m, a_m, b_m));
    }
    if (is_inside) {
      return 0.0;
    }
  }
  return least_m;
}

std::vector<Vec2d> ChamferedRect(const PlanRect& rect, const std::array<double, 4>& chamfer_m) {
  const std::array<Vec2d, 4> corners_m = rect.Corners();
  std::vector<Vec2d> polygon_m;
  for (size_t i = 0; i < 4; ++i) {
    if (chamfer_m[i] <= 0.0) {
      polygon_m.push_back(corners_m[i]);
      continue;
    }
    const Vec2d back = (corners_m[(i + 3) % 4] - corners_m[i]).normalized();
    const Vec2d ahead = (corners_m[(i + 1) % 4] - corners_m[i]).normalized();
    polygon_m.emplace_back(corners_m[i] + chamfer_m[i] * back);
    polygon_m.emplace_back(corners_m[i] + chamfer_m[i] * ahead);
  }
  return polygon_m;
}

StreetPlan PlanStreets(const CanyonSpec& canyon, const DriveSpec& drive) {
  CheckSpec(canyon);
  StreetPlan plan;
  plan.drive_path_m = SampleDrivePath(drive, 0.5);
  const double cross_x_m = drive.first_street_m + drive.corner_radius_m;
  const double last_y_m =
      (drive.turn == "right" ? -1.0 : 1.0) * (drive.cross_street_m + 2.0 * drive.corner_radius_m);
  const Span x{std::min(-kBehindStart_m, drive.first_street_m - drive.last_street_m), cross_x_m};
  const Span y{std::min(0.0, last_y_m), std::max(0.0, last_y_m)};
  plan.streets_along_x =
      PlaceStreets({y.low_m, y.high_m}, y, canyon, {34.0, 52.0}, RandomStream({canyon.seed, 1}));
  plan.streets_along_y =
      PlaceStreets({cross_x_m}, x, canyon, {46.0, 72.0}, RandomStream({canyon.seed, 2}));
  AddBlocks(canyon.street_width_m[0], RandomStream({canyon.seed, 3}), plan);
  AddRim(plan);
  return plan;
}

}  // namespace pfseq
