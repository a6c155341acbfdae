// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pfseq {
namespace {

/// A tapering limb of five sides, closed at its thin end.
void BuildLimb(MeshBuilder& builder,
               int material_idx,
               const Vec3d& from_m,
               const Vec3d& to_m,
               double from_radius_m,
               double to_radius_m) {
  constexpr int kSides = 5;
  const Vec3d along = (to_m - from_m).normalized();
  const Vec3d side =
      along.cross(std::abs(along.z()) > 0.9 ? Vec3d::UnitX() : Vec3d::UnitZ()).normalized();
  const Vec3d other = along.cross(side);
  const auto ring = [&](const Vec3d& center_m, double radius_m, int i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kSides;
    return Vec3d(center_m + radius_m * (std::cos(angle_rad) * side + std::sin(angle_rad) * other));
  };
  std::vector<Vec3d> end_m;
  for (int i = 0; i < kSides; ++i) {
    builder.Quad(material_idx,
                 ring(from_m, from_radius_m, i),
                 ring(from_m, from_radius_m, i + 1),
                 ring(to_m, to_radius_m, i + 1),
                 ring(to_m, to_radius_m, i));
    end_m.push_back(ring(to_m, to_radius_m, i));
  }
  builder.Polygon(material_idx, end_m);
}

Vec3d RandomUnit(RandomStream& random) {
  const double z = random.Uniform(-1.0, 1.0);
  const double angle_rad = random.Uniform(0.0, 2.0 * std::numbers::pi);
  const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {across * std::cos(angle_rad), across * std::sin(angle_rad), z};
}

}  // namespace

void BuildTree(const BuildContext& context,
               const TreeDesign& design,
               const Vec3d& foot_m,
               RandomStream& random) {
  MeshBuilder& builder = context.builder;
  ++context.stats.num_trees;
  const int bark = context.palette.bark;
  const double crown_m = design.height_m - design.clear_m;
  const Vec3d fork_m =
      foot_m + Vec3d(random.Uniform(-0.1, 0.1), random.Uniform(-0.1, 0.1), design.clear_m - 0.3);
  const Vec3d top_m =
      foot_m +
      Vec3d(random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), design.clear_m + 0.75 * crown_m);
  const double trunk_m = 0.016 * design.height_m;
  BuildLimb(builder, bark, foot_m - Vec3d(0, 0, 0.05), fork_m, trunk_m, 0.75 * trunk_m);
  BuildLimb(builder, bark, fork_m, top_m, 0.75 * trunk_m, 0.02);

  // Leaves gather in clumps at the boughs' ends; between the clumps the sky shows.
  struct Clump {
    Vec3d center_m;
    double radius_m;
  };
  std::vector<Clump> clumps;
  const int num_clumps = std::max(6, static_cast<int>(std::lround(15.0 * design.crown_radius_m)));
  for (int i = 0; i < num_clumps; ++i) {
    const double up = (i + 0.5) / num_clumps;
    // Widest a little under the middle, round at the top.
    const double width = std::sqrt(std::max(0.05, 1.0 - std::pow(1.9 * (up - 0.42), 2.0)));
    const double radius_m = design.crown_radius_m * random.Uniform(0.2, 0.34);
    const double reach_m = std::max(0.0, width * design.crown_radius_m - radius_m) *
                           std::sqrt(random.Uniform(0.2, 1.0));
    const double angle_rad = 2.4 * i + random.Uniform(-0.5, 0.5);
    const Vec3d center_m = foot_m + Vec3d(reach_m * std::cos(angle_rad),
                                          reach_m * std::sin(angle_rad),
                                          design.clear_m + up * crown_m * 0.92);
    clumps.push_back({center_m, radius_m});
    const double from = std::clamp(up - 0.25, 0.0, 0.9);
    BuildLimb(builder, bark, fork_m + from * (top_m - fork_m), center_m, 0.35 * trunk_m, 0.008);
  }
  for (int i = 0; i < design.num_leaves; ++i) {
    const Clump& clump = clumps[static_cast<size_t>(random.Integer(0, num_clumps - 1))];
    const Vec3d away = RandomUnit(random);
    const Vec3d at_m = clump.center_m + clump.radius_m * std::cbrt(random.Uniform(0.15, 1.0)) *
                                            away.cwiseProduct(Vec3d(1, 1, 0.8));
    const double length_m = random.Uniform(0.08, 0.16);
    const Vec2d from_axis_m = (at_m - foot_m).head<2>();
    if (from_axis_m.norm() + length_m > design.crown_radius_m) {
      continue;
    }
    // Leaves hang out and down and face the light more or less.
    const Vec3d facing =
        (0.9 * Vec3d::UnitZ() + 0.8 * away + 0.7 * RandomUnit(random)).normalized();
    const Vec3d stem = facing.cross(RandomUnit(random)).normalized();
    const Vec3d across = facing.cross(stem);
    const Vec3d half_m = 0.5 * length_m * stem;
    const Vec3d half_width_m = 0.3 * length_m * across;
    builder.Quad(
        design.leaf, at_m - half_m, at_m + half_width_m, at_m + half_m, at_m - half_width_m);
  }
}

}  // namespace pfseq
