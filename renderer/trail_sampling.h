// SPDX-License-Identifier: Apache-2.0
// Which instants of an exposure the samples of a pixel show.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/rigid_transform.h"
#include "renderer/film/shutter.h"
#include "renderer/lens/lens_raster.h"
#include "renderer/trace/ray_scene.h"

namespace pfseq {

/// While the camera moves, a trail of points of the scene passes through a pixel: a place in it and
/// an instant show the same as another place a little earlier or later. So the instants of a
/// pixel's samples depend on their places such that the samples are spread evenly over the trail
/// that passes the pixel's centre. At each place every instant is still as likely as any other,
/// whatever the motion is taken to be: that decides the noise, not what the image converges to.
class TrailSampling {
 public:
  /// `world_from_camera` is the pose in the middle of the exposure. The exposure must outlive this.
  TrailSampling(const RayScene& scene,
                const LensRaster& raster,
                const RigidTransform& world_from_camera,
                const ExposurePoses& exposure,
                int num_threads);

  /// The camera for a sample at `place` in a pixel, in [0, 1)^2; the sample's first number is its
  /// place along the trail, the second one is the shutter's.
  ExposurePoses::Pose PoseOf(int x, int y, const Vec2f& place, const Vec2d& sample) const;

 private:
  /// The motion is that of the middle of a block of pixels.
  static constexpr int kBlockPx = 4;

  const ExposurePoses* exposure_;
  Vec2d image_size_px_;
  /// In the whole exposure, in pixels, one for each block.
  Image<float> motion_px_;
};

}  // namespace pfseq
