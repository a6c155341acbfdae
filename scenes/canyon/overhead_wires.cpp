// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/random.h"
#include "scenes/canyon/shapes.h"
#include "scenes/canyon/street_life.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pfseq {
namespace {

/// Wires hang within this distance of the drive.
constexpr double kReach_m = 110.0;
/// From a crossing's edge to the nearest span.
constexpr double kCornerRoom_m = 6.0;
/// Nothing is hung across streets that are wider.
constexpr double kWidestSpan_m = 30.0;
/// Wires end this far within the wall they are fixed to.
constexpr double kInWall_m = 0.12;

/// A wire of three sides from point to point, open at its ends, which are in walls or far off.
void AddWire(const BuildContext& context, const std::vector<Vec3d>& points_m, double radius_m) {
  MeshBuilder& builder = context.builder;
  const int material = context.palette.wire;
  const Vec3d along = (points_m.back() - points_m.front()).normalized();
  const Vec3d side = along.cross(Vec3d::UnitZ()).normalized();
  const Vec3d up = side.cross(along);
  const auto corner = [&](const Vec3d& at_m, int i) {
    constexpr double kCos[] = {0.0, -0.866, 0.866};
    constexpr double kSin[] = {1.0, -0.5, -0.5};
    return Vec3d(at_m + radius_m * (kCos[i % 3] * side + kSin[i % 3] * up));
  };
  for (size_t k = 0; k + 1 < points_m.size(); ++k) {
    for (int i = 0; i < 3; ++i) {
      builder.Quad(material,
                   corner(points_m[k], i + 1),
                   corner(points_m[k], i),
                   corner(points_m[k + 1], i),
                   corner(points_m[k + 1], i + 1));
    }
  }
}

/// Points of a wire that sags in the middle, a parabola.
std::vector<Vec3d> Sagging(const Vec3d& from_m, const Vec3d& to_m, double sag_m, int num_pieces) {
  std::vector<Vec3d> points_m;
  for (int i = 0; i <= num_pieces; ++i) {
    const double t = static_cast<double>(i) / num_pieces;
    points_m.emplace_back(from_m + t * (to_m - from_m) - Vec3d(0, 0, 4.0 * sag_m * t * (1.0 - t)));
  }
  return points_m;
}

/// A lamp that hangs from a wire.
void AddHangingLamp(const BuildContext& context, const Vec3d& at_m, bool along_x) {
  SurfaceFrame frame;
  frame.origin_m = at_m;
  if (!along_x) {
    frame.right = Vec3d::UnitY();
    frame.out = Vec3d::UnitX();
  }
  ++context.stats.num_lamps;
  AddBox(context.builder,
         context.palette.railing,
         frame,
         {-0.02, -0.25, -0.02},
         {0.02, 0.03, 0.02},
         kFacesSides | kFaceTop);
  AddBox(context.builder,
         context.palette.pale_metal,
         frame,
         {-0.32, -0.38, -0.13},
         {0.32, -0.25, 0.13},
         kFacesAll);
  AddBox(context.builder,
         context.palette.head_lamp,
         frame,
         {-0.3, -0.41, -0.11},
         {0.3, -0.381, 0.11},
         kFacesAll);
}

/// Small flags on a line across the street.
void AddBunting(const BuildContext& context,
                const std::vector<Vec3d>& points_m,
                RandomStream& random) {
  for (size_t k = 0; k + 1 < points_m.size(); ++k) {
    const Vec3d step_m = points_m[k + 1] - points_m[k];
    constexpr int kFlags = 3;
    for (int i = 0; i < kFlags; ++i) {
      const Vec3d a_m = points_m[k] + (i + 0.15) / kFlags * step_m - Vec3d(0, 0, 0.01);
      const Vec3d b_m = points_m[k] + (i + 0.75) / kFlags * step_m - Vec3d(0, 0, 0.01);
      const Vec3d tip_m = 0.5 * (a_m + b_m) - Vec3d(0, 0, 0.38);
      const Vec3d thick_m = 0.006 * step_m.cross(Vec3d::UnitZ()).normalized();
      const int cloth = Pick(context.palette.cloth, random);
      // A thin wedge: two faces and the edges between them.
      const auto face = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
        const std::array<Vec3d, 3> corners_m = {a, b, c};
        context.builder.Polygon(cloth, corners_m);
      };
      face(a_m + thick_m, tip_m, b_m + thick_m);
      face(b_m - thick_m, tip_m, a_m - thick_m);
      face(b_m + thick_m, tip_m, b_m - thick_m);
      face(a_m - thick_m, tip_m, a_m + thick_m);
      context.builder.Quad(cloth, a_m + thick_m, b_m + thick_m, b_m - thick_m, a_m - thick_m);
    }
  }
}

/// Whether a block's building line runs along both sides of a street at this place.
bool HasFronts(const StreetPlan& plan, const Street& street, bool along_x, double at_m) {
  const auto is_built = [&](double line_m) {
    return std::any_of(plan.blocks.begin(), plan.blocks.end(), [&](const Block& block) {
      const int axis = along_x ? 0 : 1;
      const bool on_line = std::abs(block.lots.low_m[1 - axis] - line_m) < 1e-6 ||
                           std::abs(block.lots.high_m[1 - axis] - line_m) < 1e-6;
      return on_line && at_m > block.lots.low_m[axis] + kCornerRoom_m &&
             at_m < block.lots.high_m[axis] - kCornerRoom_m;
    });
  };
  return is_built(street.LowFacade()) && is_built(street.HighFacade());
}

void HangAcross(const BuildContext& context,
                const StreetPlan& plan,
                const Street& street,
                bool along_x,
                double low_m,
                double high_m,
                RandomStream& random) {
  const auto place = [&](double along_m, double across_m, double z_m) {
    return along_x ? Vec3d(along_m, across_m, z_m) : Vec3d(across_m, along_m, z_m);
  };
  const double spacing_m = random.Uniform(13.0, 24.0) / std::max(0.25, context.street_life);
  const bool has_lamps = random.Chance(0.7);
  const bool has_bunting = random.Chance(0.22);
  for (double along_m = low_m + kCornerRoom_m + random.Uniform(0.0, 6.0);
       along_m < high_m - kCornerRoom_m;
       along_m += spacing_m * random.Uniform(0.8, 1.2)) {
    const double skew_m = random.Uniform(-2.0, 2.0);
    const double height_m = random.Uniform(6.4, 9.0);
    RandomStream own(random.Bits());
    if (!HasFronts(plan, street, along_x, along_m - skew_m) ||
        !HasFronts(plan, street, along_x, along_m + skew_m)) {
      continue;
    }
    const Vec3d from_m = place(along_m - skew_m, street.LowFacade() - kInWall_m, height_m);
    const Vec3d to_m =
        place(along_m + skew_m, street.HighFacade() + kInWall_m, height_m + own.Uniform(-0.4, 0.4));
    const std::vector<Vec3d> points_m = Sagging(from_m, to_m, own.Uniform(0.25, 0.7), 8);
    AddWire(context, points_m, own.Uniform(0.008, 0.014));
    ++context.stats.num_wires;
    if (has_lamps && own.Chance(0.7)) {
      AddHangingLamp(context, points_m[4], along_x);
    } else if (has_bunting) {
      AddBunting(context, points_m, own);
    }
  }
}

/// The two contact wires of a tramway, held by the spans.
void HangTramway(
    const BuildContext& context, const Street& street, bool along_x, double low_m, double high_m) {
  constexpr double kPiece_m = 14.0;
  const int num_pieces = std::max(1, static_cast<int>((high_m - low_m) / kPiece_m));
  for (const double shift_m : {-1.6, 1.6}) {
    std::vector<Vec3d> points_m;
    for (int i = 0; i <= num_pieces; ++i) {
      const double along_m = low_m + (high_m - low_m) * i / num_pieces;
      const double across_m = street.center_m + shift_m + (i % 2 == 0 ? 0.15 : -0.15);
      points_m.push_back(along_x ? Vec3d(along_m, across_m, 5.7) : Vec3d(across_m, along_m, 5.7));
    }
    AddWire(context, points_m, 0.012);
    ++context.stats.num_wires;
  }
}

void HangOverStreets(const BuildContext& context,
                     const StreetPlan& plan,
                     bool along_x,
                     uint64_t seed) {
  const std::vector<Street>& streets = along_x ? plan.streets_along_x : plan.streets_along_y;
  const std::vector<Street>& crossing = along_x ? plan.streets_along_y : plan.streets_along_x;
  for (size_t k = 0; k < streets.size(); ++k) {
    const Street& street = streets[k];
    RandomStream random({seed, k, along_x ? 1U : 0U});
    const bool has_tramway = random.Chance(0.3 * context.street_life);
    const auto near_drive = [&](double low_m, double high_m) {
      const auto at = [&](double along_m) {
        return along_x ? Vec2d(along_m, street.center_m) : Vec2d(street.center_m, along_m);
      };
      return DistanceToPath({at(low_m), at(high_m)}, plan.drive_path_m) < kReach_m;
    };
    for (size_t i = 0; i + 1 < crossing.size(); ++i) {
      const double low_m = crossing[i].HighFacade();
      const double high_m = crossing[i + 1].LowFacade();
      RandomStream own(random.Bits());
      if (street.width_m > kWidestSpan_m || high_m - low_m < 4.0 * kCornerRoom_m ||
          !near_drive(low_m, high_m)) {
        continue;
      }
      HangAcross(context, plan, street, along_x, low_m, high_m, own);
      if (has_tramway) {
        HangTramway(context, street, along_x, crossing[i].center_m, crossing[i + 1].center_m);
      }
    }
  }
}

}  // namespace

void HangWires(const BuildContext& context, const StreetPlan& plan, uint64_t seed) {
  if (context.street_life <= 0.0) {
    return;
  }
  HangOverStreets(context, plan, true, HashKey({seed, 1}));
  HangOverStreets(context, plan, false, HashKey({seed, 2}));
}

}  // namespace pfseq
