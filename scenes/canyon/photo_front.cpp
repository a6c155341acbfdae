// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/photo_front.h"

#include "renderer/core/check.h"
#include "renderer/core/random.h"
#include "scenes/canyon/facade_photos.h"
#include "scenes/canyon/window.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfseq {
namespace {

constexpr double kFoot_m = kKerbHeight_m - 0.02;
/// Windows that would be narrower or come nearer to the front's rim than this stay flat.
constexpr double kLeastRim_m = 0.05;
constexpr double kLeastWindow_m = 0.25;
/// Grain and relief are added below the photograph's own resolution.
constexpr double kPhotoTexel = 1.5;
constexpr double kNear_m = 6.5;

/// The wall around holes: bands between the holes' edges, each cut at the holes in it.
void BuildWallWithHoles(MeshBuilder& builder,
                        int material_idx,
                        const SurfaceFrame& facade,
                        const WallRect& area,
                        const std::vector<WallRect>& holes) {
  std::vector<double> levels_m = {area.low_m.y(), area.high_m.y()};
  for (const WallRect& hole : holes) {
    levels_m.push_back(hole.low_m.y());
    levels_m.push_back(hole.high_m.y());
  }
  std::sort(levels_m.begin(), levels_m.end());
  for (size_t i = 0; i + 1 < levels_m.size(); ++i) {
    const double middle_m = 0.5 * (levels_m[i] + levels_m[i + 1]);
    std::vector<std::pair<double, double>> cuts_m;
    for (const WallRect& hole : holes) {
      if (hole.low_m.y() < middle_m && middle_m < hole.high_m.y()) {
        cuts_m.emplace_back(hole.low_m.x(), hole.high_m.x());
      }
    }
    std::sort(cuts_m.begin(), cuts_m.end());
    double left_m = area.low_m.x();
    for (const auto& [cut_left_m, cut_right_m] : cuts_m) {
      builder.Rectangle(
          material_idx, facade, {left_m, levels_m[i]}, {cut_left_m, levels_m[i + 1]}, 0.0);
      left_m = std::max(left_m, cut_right_m);
    }
    builder.Rectangle(
        material_idx, facade, {left_m, levels_m[i]}, {area.high_m.x(), levels_m[i + 1]}, 0.0);
  }
}

/// The photograph's windows as it lies on the front, without those at its rim or on one another.
std::vector<WallRect> WindowsOf(const FacadePhoto& photo,
                                const WallPhoto& placed,
                                const WallRect& area) {
  const Vec2d scale = placed.size_m.cwiseQuotient(photo.size_m);
  const int repeats =
      static_cast<int>(std::ceil((area.high_m.x() - placed.low_m.x()) / placed.size_m.x()));
  std::vector<WallRect> windows;
  for (int k = 0; k < repeats; ++k) {
    for (const WallRect& window : photo.windows) {
      WallRect at{window.low_m.cwiseProduct(scale), window.high_m.cwiseProduct(scale)};
      if (placed.is_mirrored) {
        at = {{placed.size_m.x() - at.high_m.x(), at.low_m.y()},
              {placed.size_m.x() - at.low_m.x(), at.high_m.y()}};
      }
      const Vec2d origin_m = placed.low_m + Vec2d(k * placed.size_m.x(), 0.0);
      at.low_m = (at.low_m + origin_m).cwiseMax(area.low_m + Vec2d::Constant(kLeastRim_m));
      at.high_m = (at.high_m + origin_m).cwiseMin(area.high_m - Vec2d::Constant(kLeastRim_m));
      const bool is_apart =
          std::none_of(windows.begin(), windows.end(), [&](const WallRect& other) {
            return at.low_m.x() < other.high_m.x() && other.low_m.x() < at.high_m.x() &&
                   at.low_m.y() < other.high_m.y() && other.low_m.y() < at.high_m.y();
          });
      if (is_apart && (at.high_m - at.low_m).minCoeff() > kLeastWindow_m) {
        windows.push_back(at);
      }
    }
  }
  return windows;
}

}  // namespace

void BuildPhotoFront(const BuildContext& context,
                     const Building& building,
                     const SurfaceFrame& facade,
                     double width_m,
                     double sight_m) {
  PFSEQ_CHECK(building.photo != nullptr && context.paintings != nullptr);
  const FacadePhoto& photo = *building.photo;
  const WallRect area{{0.0, kFoot_m}, {width_m, building.eave_m}};
  const double height_m = building.eave_m - kFoot_m;
  // Sideways it is stretched as upwards, and a little more or less so that whole photographs fit.
  const double natural_m = photo.size_m.x() * height_m / photo.size_m.y();
  const double count = std::max(1.0, std::round(width_m / natural_m));
  const double fitted_m = width_m / count;
  WallPhoto placed;
  placed.image = photo.image;
  placed.normal = photo.normal;
  placed.roughness = photo.roughness;
  placed.low_m = area.low_m;
  placed.size_m = {std::clamp(fitted_m, 0.85 * natural_m, 1.15 * natural_m), height_m};
  placed.is_mirrored = RandomStream({building.seed, 46}).Chance(0.5);

  WallPainting painting;
  painting.look = context.paintings->LookOf(building.wall, building.seed, building.age);
  painting.photo = placed;
  painting.area = area;
  painting.texel_m =
      context.paintings->TexelM() * kPhotoTexel * std::clamp(sight_m / kNear_m, 1.0, 12.0);
  painting.normal_step = 2;
  painting.pavement_m = kKerbHeight_m;
  painting.eave_m = building.eave_m;
  const std::vector<WallRect> windows = WindowsOf(photo, placed, area);
  MeshBuilder& builder = context.builder;
  const int wall = context.paintings->Add(builder, facade, building.wall, std::move(painting));
  ++context.stats.num_painted_walls;
  BuildWallWithHoles(builder, wall, facade, area, windows);
  for (const WallRect& window : windows) {
    ++context.stats.num_windows;
    BuildReveal(
        builder, building.wall, facade, {window.low_m, window.high_m}, 0.0, -photo.recess_m, true);
    builder.Rectangle(wall, facade, window.low_m, window.high_m, -photo.recess_m);
  }
}

}  // namespace pfseq
