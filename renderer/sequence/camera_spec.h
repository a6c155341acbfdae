// SPDX-License-Identifier: Apache-2.0
// What a camera does to the light besides projecting it, as plain values: the shutter, the optics
// and the sensor of the `realistic` frames. Everything is off by default.
#pragma once

#include "renderer/sequence/named.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pfseq {

/// shutter: when light falls on the film.
struct ShutterSpec {
  /// Full width at half of the shutter's opening; 0: an instant, no motion blur.
  double exposure_s = 0.0;
  /// Time to open, and to close, as a share of exposure_s: 0 box, 1 triangle, between trapezoid.
  double ramp = 0.0;
  /// Middle of the exposure after the frame's pose.
  double offset_s = 0.0;
  /// Rolling shutter: from the first to the last line that is read; 0: all at once.
  double readout_s = 0.0;
  /// Way of the lines in the image: down, up, right or left. The middle line has the frame's time.
  std::string readout = "down";

  bool operator==(const ShutterSpec&) const = default;
  bool IsOn() const { return exposure_s > 0.0 || readout_s > 0.0 || offset_s != 0.0; }
};

/// optics.lateral_color: the image height depends on the wavelength.
struct LateralColorSpec {
  /// How much further out the Fraunhofer C line (656.3 nm) falls than the F line (486.1 nm) at the
  /// rim of the image circle.
  double rim_px = 0.0;
  /// Share of that which grows with the third power of the image height; the rest is linear.
  double cubic = 0.5;

  bool operator==(const LateralColorSpec&) const = default;
};

/// optics.blur: a Gaussian point spread, the same for all wavelengths.
struct BlurSpec {
  double center_sigma_px = 0.0;
  /// Along the radius and across it at the rim.
  std::array<double, 2> rim_sigma_px = {0.0, 0.0};

  bool operator==(const BlurSpec&) const = default;
};

/// optics.vignetting: light lost with the image height rho = r / R.
struct VignettingSpec {
  /// (1 - natural rho^2)
  double natural = 0.0;
  /// (1 - mechanical smoothstep(start, 1, rho))
  double mechanical = 0.0;
  double mechanical_start = 0.8;

  bool operator==(const VignettingSpec&) const = default;
};

/// optics.rim: the soft edge of the image circle.
struct RimSpec {
  /// Over which the light of the last colour fades; 0: a sharp edge.
  double width_px = 0.0;
  /// How far out each of red, green and blue reaches, as a share of the width: what reaches
  /// furthest colours the rim.
  std::array<double, 3> reach = {0.5, 0.7, 1.0};

  bool operator==(const RimSpec&) const = default;
};

/// optics.glare: light scattered in the lens.
struct GlareSpec {
  /// Share of all light that goes into a halo.
  double bloom = 0.0;
  double bloom_radius_px = 24.0;
  /// Share of all light that spreads evenly over the image circle.
  double veil = 0.0;

  bool operator==(const GlareSpec&) const = default;
};

/// optics.sun_star: diffraction at the blades of the aperture.
struct SunStarSpec {
  /// Share of the sun's light that goes into the spikes.
  double strength = 0.0;
  double length_px = 120.0;
  double width_px = 1.5;

  bool operator==(const SunStarSpec&) const = default;
};

/// optics.ghosts.NAME: light of the sun that lens surfaces have reflected twice.
struct GhostSpec {
  /// Image height of the ghost's centre as a multiple of the sun's; negative: on the other side.
  double position = -0.5;
  double radius_px = 30.0;
  /// Share of the sun's light of each colour.
  std::array<double, 3> strength = {1e-6, 1e-6, 1e-6};
  /// 0: a full picture of the aperture; towards 1: only its edge.
  double hollow = 0.0;

  bool operator==(const GhostSpec&) const = default;
};

/// optics: pixel figures are for an image of image_width_px.
struct OpticsSpec {
  /// 0: the pixel figures are meant as they are; otherwise they scale with the image's width.
  int image_width_px = 0;
  LateralColorSpec lateral_color;
  /// Axial colour: standard deviation of the blur at 440 and 660 nm, sharp at 550 nm.
  double axial_color_sigma_px = 0.0;
  /// Dispersion blur along the radius: standard deviation at the rim, growing as rho^2.
  double dispersion_sigma_px = 0.0;
  BlurSpec blur;
  /// Diameter of the circle of confusion of a lens out of focus.
  double defocus_px = 0.0;
  VignettingSpec vignetting;
  RimSpec rim;
  GlareSpec glare;
  /// Of the aperture, which shapes sun star and ghosts; 0: round.
  int aperture_blades = 6;
  double aperture_rotation_deg = 15.0;
  SunStarSpec sun_star;
  std::vector<Named<GhostSpec>> ghosts;

  bool operator==(const OpticsSpec&) const = default;

  /// Whether anything spreads the light of a point.
  bool HasPointSpread() const {
    return lateral_color.rim_px != 0.0 || axial_color_sigma_px > 0.0 || dispersion_sigma_px > 0.0 ||
           blur != BlurSpec{} || defocus_px > 0.0;
  }
  bool HasFalloff() const {
    return vignetting.natural > 0.0 || vignetting.mechanical > 0.0 || rim.width_px > 0.0;
  }
  bool HasGlare() const { return glare.bloom > 0.0 || glare.veil > 0.0; }
  bool HasFlare() const { return sun_star.strength > 0.0 || !ghosts.empty(); }
  bool IsOn() const { return HasPointSpread() || HasFalloff() || HasGlare() || HasFlare(); }
};

/// sensor: exposure and tone curve serve all pictures, the rest realistic ones alone.
struct SensorSpec {
  /// Multiplies linear radiance before the tone curve. Absent ("auto" in the file): follows from
  /// the light (renderer/film/exposure.h); a rendered sequence's description has the number.
  std::optional<double> exposure;
  /// How an absent exposure is found: light, or frame (renderer/metering.h).
  std::string metering = "light";
  /// clip (linear up to white) or shoulder (highlights roll off smoothly).
  std::string tone_curve = "shoulder";
  /// srgb or linear.
  std::string encoding = "srgb";
  /// Electrons that a pixel collects at the exposed value 1; 0: no photon noise.
  double white_electrons = 0.0;
  /// Standard deviation of what reading adds, in electrons.
  double read_noise_electrons = 0.0;
  /// none, or the colours of the upper left 2 x 2 pixels: rggb, grbg, gbrg, bggr.
  std::string mosaic = "none";
  /// rgb or grey.
  std::string color = "rgb";
  /// Of a channel: 8 or 16.
  int bits = 8;
  /// 0: PNG without loss; 1 to 100: JPEG.
  int jpeg_quality = 0;

  bool operator==(const SensorSpec&) const = default;

  /// Whether realistic pictures differ from those of exposure and tone curve alone.
  bool IsRealistic() const {
    SensorSpec plain;
    plain.exposure = exposure;
    plain.metering = metering;
    plain.tone_curve = tone_curve;
    return !(*this == plain);
  }
};

}  // namespace pfseq
