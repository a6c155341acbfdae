// SPDX-License-Identifier: Apache-2.0
#include "renderer/blur_vectors.h"

#include "renderer/core/parallel.h"

#include <optional>

namespace pfseq {
namespace {

/// Share of the exposure over which the velocity is measured.
constexpr double kStepShare = 2e-3;

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

Vec2d ImageMotion::AtPx(int x, int y) const {
  const std::optional<Vec3d> direction_camera = raster_->CentreDirection(x, y);
  if (!direction_camera.has_value()) {
    return Vec2d::Zero();
  }
  ScenePoint point{middle_.translation_m, middle_.Direction(*direction_camera), std::nullopt};
  const std::optional<RayHit> hit = scene_->Intersect(point.origin_m, point.direction);
  if (hit.has_value()) {
    point.distance_m = hit->distance_m;
  }
  // At the rim one of the two may leave the field of view: then the other half counts twice.
  const Vec2d middle_px(x + 0.5, y + 0.5);
  const Lens& lens = raster_->OwnLens();
  const std::optional<Vec2d> first_px = lens.Project(point.DirectionIn(from_world_[0]));
  const std::optional<Vec2d> last_px = lens.Project(point.DirectionIn(from_world_[1]));
  const Vec2d moved_px = last_px.value_or(middle_px) - first_px.value_or(middle_px);
  return first_px.has_value() && last_px.has_value() ? moved_px : Vec2d(2.0 * moved_px);
}

Image<float> RenderBlurVectors(const RayScene& scene,
                               const LensRaster& raster,
                               const std::function<RigidTransform(double)>& world_from_camera_at,
                               double exposure_s,
                               int num_threads) {
  Image<float> vectors(raster.WidthPx(), raster.HeightPx(), 2);
  if (exposure_s <= 0.0) {
    return vectors;
  }
  const double half_step_s = 0.5 * kStepShare * exposure_s;
  const ImageMotion motion(scene,
                           raster,
                           world_from_camera_at(0.0),
                           world_from_camera_at(-half_step_s),
                           world_from_camera_at(half_step_s));
  ParallelFor(static_cast<size_t>(raster.HeightPx()), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < raster.WidthPx(); ++x) {
      const Vec2d vector_px = motion.AtPx(x, y) / kStepShare;
      vectors.At(x, y, 0) = static_cast<float>(vector_px.x());
      vectors.At(x, y, 1) = static_cast<float>(vector_px.y());
    }
  });
  return vectors;
}

}  // namespace pfseq
