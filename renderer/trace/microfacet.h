// SPDX-License-Identifier: Apache-2.0
// The GGX (Trowbridge-Reitz) distribution of microfacets with Smith's height-correlated masking and
// shadowing: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz
// 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (JCGT 3(2)).
// Directions are unit vectors in the shading frame, z along the normal.
#pragma once

#include "renderer/core/vector.h"

namespace pfseq {

/// Below this width (roughness 0.03) the lobe is a mirror for all that a camera can tell.
inline constexpr double kMinAlpha = 1e-3;

class Ggx {
 public:
  /// alpha is the width of the lobe, the square of glTF's roughness; it is raised to kMinAlpha.
  explicit Ggx(double alpha);

  /// Density of microfacet normals, by solid angle: D(h).
  double Density(const Vec3d& half_vector) const;

  /// Smith's Lambda of a direction with z > 0; G1 = 1 / (1 + Lambda).
  double Lambda(const Vec3d& direction) const;

  /// A microfacet normal with the distribution of those that `to_viewer` sees, D(h) G1 (v . h) /
  /// v_z: Heitz 2018, "Sampling the GGX Distribution of Visible Normals" (JCGT 7(4)), in the form
  /// of Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps". Its mirror
  /// direction has the density D(h) G1 / (4 v_z).
  Vec3d SampleVisibleNormal(const Vec3d& to_viewer, const Vec2d& sample) const;

 private:
  double alpha_;
};

/// (1 - cosine)^5, the weight of f90 in Schlick 1994, "An Inexpensive BRDF Model for
/// Physically-based Rendering".
double SchlickWeight(double cosine);

}  // namespace pfseq
