// SPDX-License-Identifier: Apache-2.0
// Procedural clouds: cumulus over a flat base 1.5 km above the scene, and thin high clouds behind
// them. World frame, Z up; radiance in kcd/m^2, irradiance in klx, per channel of linear Rec. 709.
//
// The cumulus are a height field: where a noise of several scales (gradient noise for the places,
// cellular noise for the billows, displaced by a finer tile) exceeds a threshold, a cloud stands as
// high and as dense as the excess lets it. A ray marches through it; light fades by Beer-Lambert's
// law. The light that a point sends on comes from the sun once scattered (two lobes of Henyey and
// Greenstein 1941), from the sun many times scattered, which falls with the optical depth tau
// toward the sun as 1 / (1 + 3/4 (1 - g) tau) (two-stream approximation of a slab: Bohren 1987,
// "Multiple scattering of light and some of its observable consequences", Am. J. Phys. 55(6)), and
// from sky and ground likewise. The air before far clouds turns them into the sky beside them.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/noise_tile.h"

#include <cstdint>
#include <vector>

namespace pfseq {

/// What lights the clouds.
struct CloudLight {
  Vec3d direction_to_sun = Vec3d::UnitZ();
  /// Of the sun, on a surface that faces it.
  Rgb sun_irradiance = Rgb::Zero();
  /// Of the clear sky, on a horizontal surface.
  Rgb sky_irradiance = Rgb::Zero();
  double turbidity = 3.0;
};

class Clouds {
 public:
  /// `share` of the sky above the horizon is covered: so much of its solid angle where less than
  /// half of the light behind a cloud passes. In (0, 1].
  Clouds(double share, uint64_t seed, const CloudLight& light);

  /// What the clouds in a direction add, and the share of the light from behind that passes.
  struct Layer {
    Rgb radiance = Rgb::Zero();
    float transmittance = 1.0F;
  };

  /// Toward a unit direction above the horizon. `sky_radiance` is the clear sky's there, which the
  /// air before the clouds takes on.
  Layer Toward(const Vec3d& direction, const Rgb& sky_radiance) const;

  /// Toward's transmittance alone.
  float Transmittance(const Vec3d& direction) const;

  /// Mean transmittance over a disc about the sun.
  float SunTransmittance(double angular_diameter_rad) const;

 private:
  /// A ray through the cumulus; z counts from their base.
  struct Way {
    Vec3f start_m;
    Vec3f step_m;
    int num_steps;
    float step_length_m;
    /// From the eye to the base.
    float distance_m;
  };

  Way CumulusWay(const Vec3d& direction) const;
  float CumulusDepth(const Vec3d& direction) const;
  /// Optical depth of the thin high clouds.
  float VeilDepth(const Vec3d& direction) const;
  float HeightBoundM(const Vec3f& point_m) const;
  float ExtinctionPerM(const Vec3f& point_m) const;
  /// About its mean over a length, without details.
  float MeanExtinctionPerM(const Vec3f& point_m, float length_m) const;
  Rgb Source(const Vec3f& point_m, float sun_phase) const;
  Rgb VeilSource(float sun_phase, float depth) const;
  void BoundPlaces();
  void SetThreshold(float threshold);
  void CalibrateThreshold(double share);

  CloudLight light_;
  Vec3f to_sun_;
  Rgb ground_irradiance_;
  /// First value: the cumulus; second: the veil.
  NoiseTile places_;
  NoiseTile details_;
  /// Greatest noise that a point of each square of places_ can have, and the cloud's height there.
  std::vector<float> place_bounds_;
  std::vector<float> height_bounds_m_;
  float veil_amount_ = 0.0F;
  float threshold_ = 0.0F;
};

}  // namespace pfseq
