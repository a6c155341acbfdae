// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/lens/lens.h"
#include "renderer/sequence/camera_spec.h"

namespace pfseq {

/// Light scattered in the lens: a share `bloom` of every pixel's light goes into a halo, a share
/// `veil` of all light spreads evenly over the image circle, the rest stays. The halo is a mean of
/// Gaussians of 0.5, 1 and 2 times one width, such that half of its light falls within
/// bloom_radius_px; what falls beyond the image's edges is lost, all other light is kept.
class Glare {
 public:
  /// Pixel figures of the spec are taken as they are.
  Glare(const GlareSpec& spec, const Lens& lens);

  void Apply(Image<float>& radiance, int num_threads) const;

 private:
  GlareSpec spec_;
  Vec2d principal_point_px_;
  double circle_radius_px_;
};

}  // namespace pfseq
