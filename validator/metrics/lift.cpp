// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/lift.h"

#include <cmath>

namespace pfseq {

std::optional<Vec3d> LiftByMap(const Vec2d& pixel_px,
                               const Lens& lens,
                               const RigidTransform& world_from_camera,
                               const Image<float>& distance_m) {
  // The pixel whose centre is nearest is the one that contains the point.
  const double x = std::floor(pixel_px.x());
  const double y = std::floor(pixel_px.y());
  if (!(x >= 0.0 && x < distance_m.WidthPx() && y >= 0.0 && y < distance_m.HeightPx())) {
    return std::nullopt;
  }
  const double distance = distance_m.At(static_cast<int>(x), static_cast<int>(y));
  const std::optional<Vec3d> direction_camera = lens.Unproject(pixel_px);
  if (!(distance > 0.0 && std::isfinite(distance)) || !direction_camera) {
    return std::nullopt;
  }
  return world_from_camera.Point(distance * *direction_camera);
}

std::optional<Vec3d> LiftByRay(const Vec2d& pixel_px,
                               const Lens& lens,
                               const RigidTransform& world_from_camera,
                               const RayScene& scene,
                               double max_distance_m) {
  const std::optional<Vec3d> direction_camera = lens.Unproject(pixel_px);
  if (!direction_camera) {
    return std::nullopt;
  }
  const std::optional<RayHit> hit = scene.Intersect(world_from_camera.translation_m,
                                                    world_from_camera.Direction(*direction_camera),
                                                    max_distance_m);
  if (!hit) {
    return std::nullopt;
  }
  return world_from_camera.Point(hit->distance_m * *direction_camera);
}

}  // namespace pfseq
