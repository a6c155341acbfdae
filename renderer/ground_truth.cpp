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
                              const LensRaster& raster,
                              const RigidTransform& world_from_camera,
                              double max_distance_m,
                              int num_threads) {
  const int width_px = raster.WidthPx();
  const int height_px = raster.HeightPx();
  GroundTruth truth{Image<float>(width_px, height_px, 1), Image<uint8_t>(width_px, height_px, 1)};
  const Vec3d& origin_m = world_from_camera.translation_m;
  // Packets of 4 x 2 neighbours.
  constexpr int kBlockWidth = 4;
  constexpr int kBlockHeight = kPacketSize / kBlockWidth;
  const auto num_rows = static_cast<size_t>((height_px + kBlockHeight - 1) / kBlockHeight);
  ParallelFor(num_rows, num_threads, [&](size_t row) {
    const int y0 = static_cast<int>(row) * kBlockHeight;
    for (int x0 = 0; x0 < width_px; x0 += kBlockWidth) {
      RayPacket packet;
      std::array<Vec3d, kPacketSize> directions;
      for (int i = 0; i < kPacketSize; ++i) {
        const int x = x0 + i % kBlockWidth;
        const int y = y0 + i / kBlockWidth;
        if (x >= width_px || y >= height_px) {
          continue;
        }
        const std::optional<Vec3d> direction_camera = raster.CentreDirection(x, y);
        if (direction_camera.has_value()) {
          directions[static_cast<size_t>(i)] = world_from_camera.Direction(*direction_camera);
          packet.Set(i, origin_m.cast<float>(), directions[static_cast<size_t>(i)].cast<float>());
        }
      }
      if (packet.active == 0) {
        continue;
      }
      HitPacket hits;
      scene.Intersect(packet, Coherence::kCoherent, hits);
      for (int i = 0; i < kPacketSize; ++i) {
        if (!packet.IsActive(i)) {
          continue;
        }
        const int x = x0 + i % kBlockWidth;
        const int y = y0 + i / kBlockWidth;
        double distance_m = std::numeric_limits<double>::infinity();
        if (hits.IsHit(i)) {
          distance_m =
              scene.ExactHit(hits.Of(i), origin_m, directions[static_cast<size_t>(i)]).distance_m;
        } else {
          truth.sky.At(x, y) = 255;
        }
        truth.distance_m.At(x, y) = distance_m > max_distance_m
                                        ? std::numeric_limits<float>::infinity()
                                        : static_cast<float>(distance_m);
      }
    }
  });
  return truth;
}

}  // namespace pfseq
