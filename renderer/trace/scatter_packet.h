// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/simd.h"
#include "renderer/trace/ray_packet.h"
#include "renderer/trace/surface_table.h"

#include <array>

namespace pfseq {

/// Eight places on surfaces with their scattering toward the viewer: the model of Bsdf (bsdf.h) in
/// single precision and in the world frame. What inactive lanes give is of no meaning.
class ScatterPacket {
 public:
  /// Where the active ones of `rays` met the scene.
  ScatterPacket(const std::array<ShadingPoint, kPacketSize>& points,
                uint32_t active,
                const RayPacket& rays);

  /// What the viewer gets of a surrounding of radiance 1 by the diffuse and by the specular lobe.
  const Rgb8& DiffuseReflectance() const { return diffuse_reflectance_; }
  const Rgb8& SpecularReflectance() const { return specular_reflectance_; }

  /// What the viewer gets by the specular lobe of a surrounding whose radiance is the component of
  /// its direction along Forward().
  Rgb8 SpecularForward() const;
  /// Along the shading normal's plane, away from the viewer; zero where the viewer looks along the
  /// normal.
  Vec3x8 Forward() const;

  /// Mean over the normals under the footprint of their cosines to a direction, 0 where they turn
  /// away from it: rough walls in grazing light. The cosines are taken as evenly spread about their
  /// mean, with the variance that the mean normal's length tells, half of it along the light.
  Float8 MeanCosine(const Vec3x8& to_light) const;

  /// BSDF times cosine of the diffuse lobe, by MeanCosine.
  Rgb8 EvaluateDiffuse(const Vec3x8& to_light) const;

  struct Specular {
    /// BSDF times cosine.
    Rgb8 value_cosine;
    /// SampleSpecular's density by solid angle.
    Float8 pdf;
  };
  /// Zero below the surface. Spread normals mirror each by itself: none masks another.
  Specular EvaluateSpecular(const Vec3x8& to_light) const;

  struct SpecularSample {
    Vec3x8 to_light;
    /// BSDF times cosine over pdf.
    Rgb8 weight;
    Float8 pdf;
    /// Whether the direction lies above the surface and its triangle.
    Mask8 is_valid;
  };
  /// A direction of the specular lobe from two numbers in [0, 1).
  SpecularSample SampleSpecular(Float8 first, Float8 second) const;

  /// As ShadingPoint::RayOriginM.
  Vec3x8 RayOriginM() const;

  // As in ShadingPoint.
  Vec3x8 position_m;
  Vec3x8 geometric_normal;
  Vec3x8 normal;
  Float8 normal_length;
  Float8 roughness;
  Rgb8 emission;

  Vec3x8 to_viewer;
  Float8 viewer_cosine;
  /// Neither Lambertian nor inactive.
  Mask8 is_specular;

 private:
  Float8 DiffuseShare(Float8 cosine) const;

  /// Width of the GGX lobe.
  Float8 alpha_;
  /// Fresnel reflectances of the dielectric part and of the mixture with the metal.
  Float8 dielectric_f0_;
  Float8 dielectric_f90_;
  Rgb8 f0_;
  Float8 f90_;
  Float8 viewer_lambda_;
  /// Diffuse lobe without the factor of the light's direction.
  Rgb8 diffuse_;
  Rgb8 diffuse_reflectance_;
  Rgb8 specular_reflectance_;
};

}  // namespace pfseq
