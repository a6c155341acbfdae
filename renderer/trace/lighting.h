// SPDX-License-Identifier: Apache-2.0
// What lights a scene: the sun's disc and the sky. Radiance in kcd/m^2, irradiance in klx.
#pragma once

#include "renderer/core/simd.h"
#include "renderer/core/vector.h"
#include "renderer/sequence/sequence_spec.h"
#include "renderer/trace/scene.h"
#include "renderer/trace/sky.h"

#include <optional>

namespace pfseq {

/// A disc of uniform radiance at infinity.
class SunDisc {
 public:
  /// `irradiance` is that on a surface that faces the disc's centre. The diameter must lie in (0,
  /// pi).
  SunDisc(const Vec3d& direction_to_sun, const Rgb& irradiance, double angular_diameter_rad);

  /// Whether a unit direction points at the disc.
  bool Contains(const Vec3d& direction) const { return direction.dot(direction_) >= cos_radius_; }

  /// A direction uniform over the disc's solid angle, from two numbers in [0, 1).
  Vec3d SampleDirection(const Vec2d& sample) const;
  /// The same for eight pairs of numbers, in single precision.
  Vec3x8 SampleDirection(Float8 first, Float8 second) const;

  /// SampleDirection's density within the disc, by solid angle.
  double Pdf() const { return pdf_; }

  const Rgb& Radiance() const { return radiance_; }
  /// On a surface that faces the disc's centre.
  const Rgb& Irradiance() const { return irradiance_; }
  const Vec3d& DirectionToSun() const { return direction_; }

 private:
  Vec3d direction_;
  /// 1 - cos of the angular radius, which the cosine itself would give with few digits.
  double cap_height_;
  double cos_radius_;
  double pdf_;
  Rgb irradiance_;
  Rgb radiance_;
};

struct Lighting {
  /// Nothing when the sun gives no light.
  std::optional<SunDisc> sun;
  Sky sky;
};

/// The sun's direction and its irradiance at the ground: 133 klx with the colours of a black body
/// of 5778 K, dimmed by Rayleigh scattering, haze (Angstrom) and ozone as in Preetham et al. 1999,
/// appendix A.1. None from below the horizon.
Sun MakeSun(const SunSpec& spec, double turbidity);

/// The sun of the description if it has one, else the scene's own, else the default one; with the
/// description's sky. Clouds dim the sun by what they let pass, on average over its disc. A sky map
/// is read from its file and brings its own sun or none, whatever the others are. InputError when a
/// name is unknown, the turbidity outside the sky's range, or the map no good.
Lighting MakeLighting(const LightSpec& spec, const std::optional<Sun>& scene_sun);

}  // namespace pfseq
