// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/rigid_transform.h"
#include "renderer/lens/lens_raster.h"
#include "renderer/trace/ray_scene.h"

#include <array>
#include <functional>

namespace pfseq {

/// How far what pixels show moves over the image while the camera goes from one pose to another.
/// The sky is infinitely far.
class ImageMotion {
 public:
  /// `middle` is the pose at which the pixels show it. Scene and raster must outlive this.
  ImageMotion(const RayScene& scene,
              const LensRaster& raster,
              const RigidTransform& middle,
              const RigidTransform& first,
              const RigidTransform& last)
      : scene_(&scene),
        raster_(&raster),
        middle_(middle),
        from_world_{first.Inverse(), last.Inverse()} {}

  /// Of what the pixel's centre shows, in pixels, x to the right and y down; 0 outside the image
  /// circle.
  Vec2d AtPx(int x, int y) const;

 private:
  const RayScene* scene_;
  const LensRaster* raster_;
  RigidTransform middle_;
  std::array<RigidTransform, 2> from_world_;
};

/// How far what a pixel's centre shows moves over the image while the shutter is open, in pixels:
/// its velocity at mid-exposure times exposure_s, two channels, x to the right and y down; see
/// ImageMotion. 0 without an exposure.
/// `world_from_camera_at` gives the camera so many seconds after mid-exposure.
Image<float> RenderBlurVectors(const RayScene& scene,
                               const LensRaster& raster,
                               const std::function<RigidTransform(double)>& world_from_camera_at,
                               double exposure_s,
                               int num_threads);

}  // namespace pfseq
