// SPDX-License-Identifier: Apache-2.0
// How a surface scatters light: the metallic-roughness model of the glTF 2.0 specification,
// appendix B,
//   mix(dielectric, metal, metallic),
// with Trowbridge-Reitz microfacets (alpha = roughness^2), Smith's height-correlated masking and
// Schlick's Fresnel term. In one place the appendix (which is not normative) is left: its weight (1
// - F(v . h)) of the diffuse part lets a smooth white surface return up to twice the light it gets
// at grazing angles. Instead the diffuse part is
//   base / pi * (1 - E(v)) (1 - E(l)) / (1 - mean E)
// with the albedo E of the specular part: Kelemen and Szirmay-Kalos 2001, "A Microfacet Based
// Coupled Specular-Matte BRDF Model with Importance Sampling", equation (10). It is reciprocal, and
// a white surface returns just what it gets.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/microfacet.h"

#include <optional>

namespace pfseq {

/// A material at one point, textures evaluated; all in [0, 1] but ior >= 1.
struct BsdfParameters {
  Rgb base_color = Rgb::Constant(0.8F);
  float metallic = 0.0F;
  float roughness = 1.0F;
  /// 1: no specular reflection, a Lambertian surface (of the dielectric part).
  float ior = 1.5F;
};

/// A direction of the light's origin and what it counts.
struct BsdfSample {
  Vec3d to_light;
  /// BSDF times cosine over pdf.
  Rgb weight;
  /// By solid angle.
  double pdf;
};

/// BSDF times cosine for one direction, and the density with which Sample chooses it.
struct BsdfValue {
  Rgb value_cosine = Rgb::Zero();
  double pdf = 0.0;
};

/// The scattering toward one viewer. Directions are unit vectors in the shading frame, z along the
/// normal, away from the surface; the viewer's z must be > 0.
class Bsdf {
 public:
  Bsdf(const BsdfParameters& parameters, const Vec3d& to_viewer);

  /// Zero below the surface.
  BsdfValue Evaluate(const Vec3d& to_light) const;

  /// The two parts of Evaluate's value. The specular part comes with SampleSpecular's density.
  Rgb EvaluateDiffuse(const Vec3d& to_light) const;
  BsdfValue EvaluateSpecular(const Vec3d& to_light) const;

  /// What the viewer gets of a surrounding of radiance 1 by the diffuse and by the specular lobe.
  Rgb DiffuseReflectance() const;
  Rgb SpecularReflectance() const;

  /// A direction of the specular lobe alone; the weight is that lobe's. Nothing when the direction
  /// lies below the surface or there is no such lobe.
  std::optional<BsdfSample> SampleSpecular(const Vec2d& direction_sample) const;

  /// Chooses the lobe by one number in [0, 1) and the direction within it by two. Nothing when the
  /// direction lies below the surface or the surface is black.
  std::optional<BsdfSample> Sample(double lobe_sample, const Vec2d& direction_sample) const;

 private:
  struct Lobes {
    Rgb f0;
    Rgb f90;
  };

  double DiffuseShare(double cosine) const;

  Vec3d to_viewer_;
  Ggx ggx_;
  float roughness_;
  /// Fresnel reflectances of the dielectric alone, which decide what is left to the diffuse part.
  double dielectric_f0_;
  double dielectric_f90_;
  /// Of the mixture with the metal.
  Lobes specular_;
  /// Diffuse albedo over pi and the factors of the viewer's direction and of normalisation.
  Rgb diffuse_;
  double viewer_lambda_ = 0.0;
  double mean_albedo_ = 0.0;
  /// Probability that Sample takes the specular lobe.
  double specular_probability_ = 0.0;
};

}  // namespace pfseq
