// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_surface.h"

#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

constexpr double kTile_m = 24.0;
/// Paint and covers lie this far above the asphalt: far above the rounding of float32.
constexpr double kPaint_m = 0.004;
constexpr double kKerbWidth_m = 0.18;
/// Markings are painted within this distance of the drive.
constexpr double kMarkingReach_m = 120.0;

void AddMark(const BuildContext& context, const Vec2d& low_m, const Vec2d& high_m) {
  context.builder.Quad(context.palette.marking,
                       Lift(low_m, kPaint_m),
                       {high_m.x(), low_m.y(), kPaint_m},
                       Lift(high_m, kPaint_m),
                       {low_m.x(), high_m.y(), kPaint_m});
}

/// The same along X or along Y: (along, across) to the plane.
Vec2d Place(bool along_x, double along_m, double across_m) {
  return along_x ? Vec2d(along_m, across_m) : Vec2d(across_m, along_m);
}

/// Bars across a street before a crossing, from kerb to kerb.
void AddZebra(const BuildContext& context, const Street& street, bool along_x, double from_m) {
  const double half_m = 0.5 * street.width_m - street.pavement_m;
  const int num_bars = std::max(1, static_cast<int>(std::floor((2.0 * half_m - 0.3) / 1.0)));
  for (int i = 0; i < num_bars; ++i) {
    const double across_m = street.center_m + (i - 0.5 * (num_bars - 1)) * 1.0;
    AddMark(context,
            Place(along_x, from_m, across_m - 0.25),
            Place(along_x, from_m + 2.6, across_m + 0.25));
  }
}

/// Dashes and a manhole now and then between two crossings; zebras at both ends.
void MarkSection(
    const BuildContext& context, const Street& street, bool along_x, double low_m, double high_m) {
  constexpr double kZebraRoom_m = 4.6;
  constexpr double kStride_m = 6.0;
  if (high_m - low_m < 4.0 * kZebraRoom_m) {
    return;
  }
  AddZebra(context, street, along_x, low_m + 1.0);
  AddZebra(context, street, along_x, high_m - 3.6);
  const double begin_m = low_m + kZebraRoom_m + 1.0;
  const int count =
      static_cast<int>(std::floor((high_m - low_m - 2.0 * kZebraRoom_m - 2.0) / kStride_m));
  for (int i = 0; i < count; ++i) {
    const double at_m = begin_m + i * kStride_m;
    AddMark(context,
            Place(along_x, at_m, street.center_m - 0.06),
            Place(along_x, at_m + 2.5, street.center_m + 0.06));
    if (i % 4 == 2) {
      std::vector<Vec2d> disc_m;
      const Vec2d center_m = Place(along_x, at_m + 4.2, street.center_m + 1.1);
      for (int k = 0; k < 16; ++k) {
        const double angle_rad = 2.0 * std::numbers::pi * k / 16.0;
        disc_m.emplace_back(center_m + 0.34 * Vec2d(std::cos(angle_rad), std::sin(angle_rad)));
      }
      AddLevelPolygon(context.builder, context.palette.manhole, disc_m, kPaint_m);
    }
  }
}

void MarkStreets(const BuildContext& context, const StreetPlan& plan, bool along_x) {
  const std::vector<Street>& streets = along_x ? plan.streets_along_x : plan.streets_along_y;
  const std::vector<Street>& crossing = along_x ? plan.streets_along_y : plan.streets_along_x;
  for (size_t k = 0; k < streets.size(); ++k) {
    const Street& street = streets[k];
    // Streets that run into one another are one open place, without markings.
    const bool is_merged =
        (k > 0 && streets[k - 1].HighFacade() > street.LowFacade()) ||
        (k + 1 < streets.size() && streets[k + 1].LowFacade() < street.HighFacade());
    for (size_t i = 0; !is_merged && i + 1 < crossing.size(); ++i) {
      const double low_m = crossing[i].HighFacade() - crossing[i].pavement_m + 1.0;
      const double high_m = crossing[i + 1].LowFacade() + crossing[i + 1].pavement_m - 1.0;
      const std::vector<Vec2d> section = {Place(along_x, low_m, street.center_m),
                                          Place(along_x, high_m, street.center_m)};
      if (high_m > low_m && DistanceToPath(section, plan.drive_path_m) < kMarkingReach_m) {
        MarkSection(context, street, along_x, low_m, high_m);
      }
    }
  }
}

/// Replaces each corner by an arc.
std::vector<Vec2d> RoundedPolygon(const std::vector<Vec2d>& points_m, double radius_m) {
  constexpr int kSteps = 6;
  const size_t count = points_m.size();
  std::vector<Vec2d> result;
  for (size_t i = 0; i < count; ++i) {
    const Vec2d& corner_m = points_m[i];
    const Vec2d back_m = points_m[(i + count - 1) % count] - corner_m;
    const Vec2d ahead_m = points_m[(i + 1) % count] - corner_m;
    // Half the inner angle; the arc touches the edges at radius / tan(half) from the corner.
    const double half_rad =
        0.5 * std::acos(std::clamp(back_m.normalized().dot(ahead_m.normalized()), -1.0, 1.0));
    const double most_m = 0.4 * std::min(back_m.norm(), ahead_m.norm());
    const double cut_m = std::min(radius_m / std::tan(half_rad), most_m);
    const double radius = cut_m * std::tan(half_rad);
    const Vec2d center_m = corner_m + (back_m.normalized() + ahead_m.normalized()).normalized() *
                                          (radius / std::sin(half_rad));
    const Vec2d from = corner_m + cut_m * back_m.normalized() - center_m;
    const double turn_rad = std::numbers::pi - 2.0 * half_rad;
    for (int k = 0; k <= kSteps; ++k) {
      const double angle_rad = turn_rad * k / kSteps;
      result.emplace_back(center_m +
                          Vec2d(std::cos(angle_rad) * from.x() - std::sin(angle_rad) * from.y(),
                                std::sin(angle_rad) * from.x() + std::cos(angle_rad) * from.y()));
    }
  }
  return result;
}

}  // namespace

void BuildCarriageways(const BuildContext& context, const StreetPlan& plan) {
  const Vec2d size_m = plan.extent.Size();
  const int columns = static_cast<int>(std::ceil(size_m.x() / kTile_m));
  const int rows = static_cast<int>(std::ceil(size_m.y() / kTile_m));
  const auto grid = [&](int column, int row) {
    return Vec3d(plan.extent.low_m.x() + size_m.x() * column / columns,
                 plan.extent.low_m.y() + size_m.y() * row / rows,
                 0.0);
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      context.builder.Quad(context.palette.asphalt,
                           grid(column, row),
                           grid(column + 1, row),
                           grid(column + 1, row + 1),
                           grid(column, row + 1));
    }
  }
  if (context.detail > 0.0) {
    MarkStreets(context, plan, true);
    MarkStreets(context, plan, false);
  }
}

void BuildPavement(const BuildContext& context, const Block& block) {
  MeshBuilder& builder = context.builder;
  std::vector<Vec2d> outer_m = ChamferedRect(block.island, block.island_chamfer_m);
  if (!block.is_rim) {
    outer_m = RoundedPolygon(outer_m, 3.0);
  }
  const std::vector<double> width_m(outer_m.size(), kKerbWidth_m);
  const std::vector<Vec2d> inner_m = InsetPolygon(outer_m, width_m);
  for (size_t i = 0; i < outer_m.size(); ++i) {
    const size_t next = (i + 1) % outer_m.size();
    builder.Quad(context.palette.kerb,
                 Lift(outer_m[i], -0.02),
                 Lift(outer_m[next], -0.02),
                 Lift(outer_m[next], kKerbHeight_m),
                 Lift(outer_m[i], kKerbHeight_m));
    builder.Quad(context.palette.kerb,
                 Lift(outer_m[i], kKerbHeight_m),
                 Lift(outer_m[next], kKerbHeight_m),
                 Lift(inner_m[next], kKerbHeight_m),
                 Lift(inner_m[i], kKerbHeight_m));
  }
  AddLevelPolygon(builder, context.palette.pavement, inner_m, kKerbHeight_m);
}

}  // namespace pfseq
