// SPDX-License-Identifier: Apache-2.0
#include "renderer/blur_vectors.h"

#include "renderer/core/parallel.h"

#include <optional>

namespace pfseq {
namespace {

/// Share of the exposure over which the velocity is measured.
constexpr double kStepShare = 1e-3;

/// A point of the scene: at infinity without a distance.
struct ScenePoint {
  Vec3d origin_m;
  Vec3d direction;
  std::optional<double> distance_m;

  Vec3d DirectionIn(const RigidTransform& camera_from_world) const {
    return distance_m.has_value() ? camera_from_world.Point(origin_m + *distance_m * direction)
                                  : camera_from_world.Direction(direction);
  }
};

}  // namespace

Image<float> RenderBlurVectors(const RayScene& scene,
                               const LensRaster& raster,
                               const std::function<RigidTransform(double)>& world_from_camera_at,
                               double exposure_s,
                               int num_threads) {
  Image<float> vectors(raster.WidthPx(), raster.HeightPx(), 2);
  if (exposure_s <= 0.0) {
    return vectors;
  }
  const double step_s = kStepShare * exposure_s;
  const RigidTransform world_from_camera = world_from_camera_at(0.0);
  const RigidTransform before = world_from_camera_at(-step_s).Inverse();
  const RigidTransform after = world_from_camera_at(step_s).Inverse();
  ParallelFor(static_cast<size_t>(raster.HeightPx()), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < raster.WidthPx(); ++x) {
      const std::optional<Vec3d> direction_camera = raster.CentreDirection(x, y);
      if (!direction_camera.has_value()) {
        continue;
      }
      ScenePoint point{world_from_camera.translation_m,
                       world_from_camera.Direction(*direction_camera),
                       std::nullopt};
      const std::optional<RayHit> hit = scene.Intersect(point.origin_m, point.direction);
      if (hit.has_value()) {
        point.distance_m = hit->distance_m;
      }
      // At the rim one of the two may leave the field of view.
      const Vec2d middle_px(x + 0.5, y + 0.5);
      const Lens& lens = raster.OwnLens();
      const std::optional<Vec2d> start_px = lens.Project(point.DirectionIn(before));
      const std::optional<Vec2d> end_px = lens.Project(point.DirectionIn(after));
      const int num_steps = (start_px.has_value() ? 1 : 0) + (end_px.has_value() ? 1 : 0);
      if (num_steps > 0) {
        const Vec2d moved_px = end_px.value_or(middle_px) - start_px.value_or(middle_px);
        const Vec2d vector_px = moved_px / (num_steps * kStepShare);
        vectors.At(x, y, 0) = static_cast<float>(vector_px.x());
        vectors.At(x, y, 1) = static_cast<float>(vector_px.y());
      }
    }
  });
  return vectors;
}

}  // namespace pfseq
