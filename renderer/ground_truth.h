// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/rigid_transform.h"
#include "renderer/lens/lens.h"
#include "renderer/lens/lens_raster.h"
#include "renderer/trace/ray_scene.h"

#include <cstdint>

namespace pfseq {

/// Geometry seen from a camera, one ray through each pixel's centre: no blur, no anti-aliasing, no
/// optics.
struct GroundTruth {
  /// Metres from the camera centre along the ray; +inf for sky and beyond the maximum; 0 outside
  /// the image circle.
  Image<float> distance_m;
  /// 255 where the ray meets no geometry at any distance, else 0.
  Image<uint8_t> sky;
};

/// The distance of one pixel centre's ray, in double: +inf when it meets nothing, 0 outside the
/// image circle.
double CastPixelCentreM(
    const RayScene& scene, const Lens& lens, const RigidTransform& world_from_camera, int x, int y);

GroundTruth RenderGroundTruth(const RayScene& scene,
                              const LensRaster& raster,
                              const RigidTransform& world_from_camera,
                              double max_distance_m,
                              int num_threads);

}  // namespace pfseq
