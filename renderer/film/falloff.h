// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/lens/lens.h"
#include "renderer/sequence/camera_spec.h"

namespace pfseq {

/// Share of the light of each colour that reaches the film at an image height r; rho = r / R:
///   (1 - natural rho^2) (1 - mechanical s((rho - start) / (1 - start))) s((E_c - r) / (E_c - I))
/// with s the smoothstep 3 t^2 - 2 t^3 of t in [0, 1]. The last factor is the rim: each colour
/// fades from I = R - width to E_c = I + reach_c width, at R or before it.
class Falloff {
 public:
  /// Pixel figures of the spec are taken as they are.
  Falloff(const OpticsSpec& spec, const Lens& lens);

  Rgb At(double height_px) const;

  /// Multiplies radiance.
  void Apply(Image<float>& radiance, int num_threads) const;

 private:
  VignettingSpec vignetting_;
  RimSpec rim_;
  Vec2d principal_point_px_;
  double circle_radius_px_;
};

}  // namespace pfseq
