// SPDX-License-Identifier: Apache-2.0
// What the sun's disc does in a lens besides its image: a star of spikes from the blades of the
// aperture, and ghosts from light that lens surfaces reflect twice.
#pragma once

#include "renderer/core/image.h"
#include "renderer/film/shutter.h"
#include "renderer/lens/lens.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/ray_scene.h"

#include <vector>

namespace pfseq {

/// The sun's image for a while of the exposure.
struct SunImage {
  /// Of the disc's middle.
  Vec2d place_px = Vec2d::Zero();
  /// Radiance times area in px^2 of the part that the camera sees, over the whole exposure.
  Rgb light = Rgb::Zero();
};

/// The sun as the camera sees it while the frame is exposed: by rays to the disc, of which those
/// count that nothing stops. One image for each pixel that it moves, 16 at most; none when it is
/// outside the field of view or covered.
std::vector<SunImage> SeenSun(const RayScene& scene,
                              const SunDisc& sun,
                              const Lens& lens,
                              const Vec2d& image_size_px,
                              const ExposurePoses& poses);

class Flare {
 public:
  /// Pixel figures of the spec are taken as they are.
  Flare(const OpticsSpec& spec, const Lens& lens);

  /// Adds star and ghosts to radiance. A spike of the star has the light
  ///   strength / n exp(-s / L_c) / L_c  times a Gaussian of the width across it,
  /// s the way along it, n the number of spikes (the blades', twice that when it is odd), L_c its
  /// length times the channel's wavelength (610, 550, 465 nm) over 550 nm. A ghost is a picture of
  /// the aperture about p + position (sun - p), p the principal point; with m the place from its
  /// middle (0) to its edge (1) it is as bright as 1 - hollow + 4 hollow m^6, evenly at hollow 0.
  void Add(const std::vector<SunImage>& sun, Image<float>& radiance, int num_threads) const;

 private:
  Rgb StarAt(const Vec2d& from_sun_px) const;
  Rgb GhostAt(const GhostSpec& ghost, const Vec2d& from_middle_px) const;

  OpticsSpec spec_;
  Vec2d principal_point_px_;
  std::vector<Vec2d> spikes_;
  /// Normals of the aperture's edges.
  std::vector<Vec2d> edges_;
};

}  // namespace pfseq
