// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace pfseq {

/// The light that the GGX specular lobe returns from a white surrounding, tabulated by direction
/// and roughness, for Schlick's Fresnel term F = f0 + (f90 - f0) (1 - cos)^5: albedo = f0 *
/// f0_scale + f90 * f90_scale.
class SpecularAlbedo {
 public:
  struct Scales {
    double f0_scale = 0.0;
    double f90_scale = 0.0;
  };

  SpecularAlbedo();

  /// The one table that all share; it is made at the first call and never changes.
  static const SpecularAlbedo& Table();

  /// Toward a viewer at this cosine to the normal, in [0, 1]; perceptual roughness (the root of
  /// alpha) in [0, 1].
  Scales Directional(double cosine, double roughness) const;

  /// The mean over all directions, weighted with the cosine.
  Scales Mean(double roughness) const;

 private:
  std::vector<Scales> directional_;
  std::vector<Scales> mean_;
};

}  // namespace pfseq
