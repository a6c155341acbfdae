// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/curtain_wall.h"

#include "scenes/canyon/shapes.h"
#include "scenes/canyon/window.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfseq {
namespace {

constexpr double kSpandrel_m = 0.85;
/// How far a pane's corner may lie behind the plane of the wall, and how far mullions reach behind
/// it.
constexpr double kTilt_m = 0.006;
constexpr double kBehind_m = 0.03;
constexpr double kHalfBar_m = 0.03;
constexpr double kMullionDepth_m = 0.1;
constexpr double kTransomDepth_m = 0.05;

/// Heights of the horizontal joints: spandrel and pane in turn.
std::vector<double> Joints(const Building& building, double foot_m) {
  std::vector<double> joints_m;
  for (int floor = 0; floor < building.num_upper_floors; ++floor) {
    const double floor_m = foot_m + floor * building.floor_height_m;
    joints_m.push_back(floor_m);
    joints_m.push_back(floor_m + kSpandrel_m);
  }
  joints_m.push_back(foot_m + building.num_upper_floors * building.floor_height_m);
  return joints_m;
}

/// A pane whose inner corners lie a little behind the wall; those on the facade's own ends do not.
void BuildPane(const BuildContext& context,
               const Building& building,
               const SurfaceFrame& facade,
               const Opening& pane,
               double width_m,
               bool is_spandrel,
               RandomStream& random) {
  const auto corner = [&](double u, double v) {
    const bool on_end = u <= 0.0 || u >= width_m;
    return facade.At(u, v, on_end ? 0.0 : -random.Uniform(0.0, kTilt_m));
  };
  const Vec3d a = corner(pane.low_m.x(), pane.low_m.y());
  const Vec3d b = corner(pane.high_m.x(), pane.low_m.y());
  const Vec3d c = corner(pane.high_m.x(), pane.high_m.y());
  const Vec3d d = corner(pane.low_m.x(), pane.high_m.y());
  const TextureWindow picture = AtlasCell(kWindowAtlasCells, random);
  if (is_spandrel) {
    context.builder.Quad(building.spandrel, a, b, c, d);
  } else {
    ++context.stats.num_windows;
    context.builder.PictureQuad(context.palette.facade_glass, a, b, c, d, picture);
  }
}

}  // namespace

void BuildCurtainWall(const BuildContext& context,
                      const Building& building,
                      const SurfaceFrame& facade,
                      double width_m,
                      double foot_m,
                      Lod lod,
                      RandomStream& random) {
  MeshBuilder& builder = context.builder;
  const std::vector<double> joints_m = Joints(building, foot_m);
  const double head_m = joints_m.back();
  builder.Rectangle(building.spandrel, facade, {0.0, head_m}, {width_m, building.eave_m}, 0.0);
  const int num_modules =
      std::max(1, static_cast<int>(std::lround(width_m / building.bay_width_m)));
  if (lod >= Lod::kMedium) {
    context.stats.num_windows += num_modules * building.num_upper_floors;
    builder.Rectangle(context.palette.curtain_wall, facade, {0.0, foot_m}, {width_m, head_m}, 0.0);
    return;
  }
  const double module_m = width_m / num_modules;
  for (int i = 0; i < num_modules; ++i) {
    const double left_m = i * module_m;
    const double right_m = i + 1 == num_modules ? width_m : (i + 1) * module_m;
    for (size_t j = 0; j + 1 < joints_m.size(); ++j) {
      BuildPane(context,
                building,
                facade,
                {{left_m, joints_m[j]}, {right_m, joints_m[j + 1]}},
                width_m,
                j % 2 == 0,
                random);
    }
  }
  for (int i = 0; i <= num_modules; ++i) {
    const double center_m = std::clamp(i * module_m, 0.08, width_m - 0.08);
    AddBox(builder,
           building.frame,
           facade,
           {center_m - kHalfBar_m, foot_m - 0.05, -kBehind_m},
           {center_m + kHalfBar_m, building.eave_m - 0.3, kMullionDepth_m},
           kFaceFront | kFaceLeft | kFaceRight | kFaceTop | kFaceBottom);
  }
  for (const double joint_m : joints_m) {
    AddBox(builder,
           building.frame,
           facade,
           {0.02, joint_m - kHalfBar_m, -kBehind_m},
           {width_m - 0.02, joint_m + kHalfBar_m, kTransomDepth_m},
           kFacesOnWall);
  }
}

}  // namespace pfseq
