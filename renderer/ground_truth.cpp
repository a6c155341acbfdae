// SPDX-License-Identifier: Apache-2.0
#include "renderer/ground_truth.h"

#include "renderer/core/parallel.h"

#include <limits>
#include <optional>

namespace pfseq {

double CastPixelCentreM(const RayScene& scene,
                        const Lens& lens,
                        const RigidTransform& world_from_camera,
                        int x,
                        int y) {
  const std::optional<Vec3d> direction_camera = lens.Unproject(Vec2d(x + 0.5, y + 0.5));
  if (!direction_camera.has_value()) {
    return 0.0;
  }
  const std::optional<RayHit> hit = scene.Intersect(world_from_camera.translation_m,
                                                    world_from_camera.Direction(*direction_camera));
  return hit.has_value() ? hit->distance_m : std::numeric_limits<double>::infinity();
}

GroundTruth RenderGroundTruth(const RayScene& scene,
                              const Lens& lens,
                              const RigidTransform& world_from_camera,
                              int width_px,
                              int height_px,
                              double max_distance_m,
                              int num_threads) {
  GroundTruth truth{Image<float>(width_px, height_px, 1), Image<uint8_t>(width_px, height_px, 1)};
  ParallelFor(static_cast<size_t>(height_px), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < width_px; ++x) {
      const double distance_m = CastPixelCentreM(scene, lens, world_from_camera, x, y);
      truth.sky.At(x, y) = distance_m == std::numeric_limits<double>::infinity() ? 255 : 0;
      truth.distance_m.At(x, y) = distance_m > max_distance_m
                                      ? std::numeric_limits<float>::infinity()
                                      : static_cast<float>(distance_m);
    }
  });
  return truth;
}

}  // namespace pfseq
