// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/simd.h"

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

  /// Of eight directions or roughnesses.
  struct Scales8 {
    Float8 f0_scale;
    Float8 f90_scale;
  };

  SpecularAlbedo();

  /// The one table that all share; it is made at the first call and never changes.
  static const SpecularAlbedo& Table();

  /// Toward a viewer at this cosine to the normal, in [0, 1]; perceptual roughness (the root of
  /// alpha) in [0, 1].
  Scales Directional(double cosine, double roughness) const;

  /// The mean over all directions, weighted with the cosine.
  Scales Mean(double roughness) const;

  /// The same in single precision.
  Scales8 Directional(Float8 cosine, Float8 roughness) const;
  Scales8 Mean(Float8 roughness) const;

  /// Like Directional, but the surrounding's radiance is the component of its direction in the
  /// surface, away from the viewer: in all how far forward the lobe leans.
  Scales8 Forward(Float8 cosine, Float8 roughness) const;

 private:
  std::vector<Scales> directional_;
  std::vector<Scales> mean_;
  /// f0_scale and f90_scale of each entry in turn.
  std::vector<float> directional_f_;
  std::vector<float> forward_f_;
  std::vector<float> mean_f_;
};

}  // namespace pfseq
