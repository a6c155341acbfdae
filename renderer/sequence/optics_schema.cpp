// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/schema_parts.h"

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr double kMaxSpreadPx = 64.0;

YamlTypePtr<LateralColorSpec> LateralColorSchema() {
  auto schema = NewMapping<LateralColorSpec>();
  schema
      ->Key("rim_px",
            &LateralColorSpec::rim_px,
            From(-kMaxSpreadPx, kMaxSpreadPx),
            "How much further out red (656.3 nm) falls than blue (486.1 nm) at the rim, in pixels.")
      .Key("cubic",
           &LateralColorSpec::cubic,
           From(-10.0, 10.0),
           "Share of it that grows with the cube of the image height; the rest is linear.");
  return schema;
}

YamlTypePtr<BlurSpec> BlurSchema() {
  auto schema = NewMapping<BlurSpec>();
  schema
      ->Key("center_sigma_px",
            &BlurSpec::center_sigma_px,
            From(0.0, kMaxSpreadPx),
            "Standard deviation of the lens's point spread in the middle, in pixels.")
      .Key("rim_sigma_px",
           &BlurSpec::rim_sigma_px,
           YamlArray<2>(From(0.0, kMaxSpreadPx), true),
           "At the rim, along the radius and across it; between, it grows with the square of the "
           "image height.");
  return schema;
}

YamlTypePtr<VignettingSpec> VignettingSchema() {
  auto schema = NewMapping<VignettingSpec>();
  schema
      ->Key("natural",
            &VignettingSpec::natural,
            From(0.0, 1.0),
            "Share of the light lost at the rim; grows with the square of the image height.")
      .Key("mechanical",
           &VignettingSpec::mechanical,
           From(0.0, 1.0),
           "Share lost at the rim to the lens's barrel, with a smooth start.")
      .Key("mechanical_start",
           &VignettingSpec::mechanical_start,
           From(0.0, 0.999),
           "Where that starts, as a share of the image circle's radius.");
  return schema;
}

YamlTypePtr<RimSpec> RimSchema() {
  auto schema = NewMapping<RimSpec>();
  schema
      ->Key("width_px",
            &RimSpec::width_px,
            From(0.0, 1e4),
            "Width of the soft edge of the image circle in pixels; 0: sharp.")
      .Key("reach",
           &RimSpec::reach,
           YamlArray<3>(From(0.0, 1.0)),
           "Where in the width red, green and blue end; the one that reaches furthest colours the "
           "edge.");
  return schema;
}

YamlTypePtr<GlareSpec> GlareSchema() {
  auto schema = NewMapping<GlareSpec>();
  schema
      ->Key("bloom",
            &GlareSpec::bloom,
            From(0.0, 0.5),
            "Share of all light that the lens scatters into halos.")
      .Key("bloom_radius_px",
           &GlareSpec::bloom_radius_px,
           From(2.0, 1e4),
           "Within which half of a halo's light falls, in pixels.")
      .Key("veil",
           &GlareSpec::veil,
           From(0.0, 0.5),
           "Share of all light that spreads evenly over the image circle.");
  return schema;
}

YamlTypePtr<SunStarSpec> SunStarSchema() {
  auto schema = NewMapping<SunStarSpec>();
  schema
      ->Key("strength",
            &SunStarSpec::strength,
            From(0.0, 0.5),
            "Share of the sun's light that the blades of the aperture throw into spikes.")
      .Key("length_px",
           &SunStarSpec::length_px,
           Above0(1e4),
           "Over which a spike loses two thirds of its light, in pixels.")
      .Key("width_px", &SunStarSpec::width_px, From(0.5, 100.0), "Width of a spike in pixels.");
  return schema;
}

YamlTypePtr<GhostSpec> GhostSchema() {
  auto schema = NewMapping<GhostSpec>();
  schema
      ->Key("position",
            &GhostSpec::position,
            From(-10.0, 10.0),
            "Image height of the ghost's middle as a multiple of the sun's; negative: beyond the "
            "principal point.")
      .Key("radius_px", &GhostSpec::radius_px, From(1.0, 1e4), "Radius in pixels.")
      .Key("strength",
           &GhostSpec::strength,
           YamlArray<3>(From(0.0, 0.5), true),
           "Share of the sun's red, green and blue light.")
      .Key("hollow",
           &GhostSpec::hollow,
           From(0.0, 0.95),
           "0: an evenly lit picture of the aperture; towards 1: its edge alone.");
  return schema;
}

}  // namespace

YamlTypePtr<OpticsSpec> OpticsSchema() {
  auto schema = NewMapping<OpticsSpec>();
  schema
      ->Key("image_width_px",
            &OpticsSpec::image_width_px,
            YamlInteger<int>(0, 1000000),
            "Image width for which the pixel figures below are meant; at another width they scale "
            "with it. 0: they are meant as they are.")
      .Key("lateral_color", &OpticsSpec::lateral_color, LateralColorSchema(), "")
      .Key("axial_color_sigma_px",
           &OpticsSpec::axial_color_sigma_px,
           From(0.0, kMaxSpreadPx),
           "Axial colour: standard deviation of the blur of violet (440 nm) and red (660 nm), "
           "sharp at 550 nm; purple fringes about bright edges.")
      .Key("dispersion_sigma_px",
           &OpticsSpec::dispersion_sigma_px,
           From(0.0, kMaxSpreadPx),
           "Dispersion blur along the radius: standard deviation at the rim; grows with the square "
           "of the image height.")
      .Key("blur", &OpticsSpec::blur, BlurSchema(), "")
      .Key("defocus_px",
           &OpticsSpec::defocus_px,
           From(0.0, kMaxSpreadPx),
           "Diameter of the circle of confusion, in pixels: a Gaussian of the same second moment.")
      .Key("vignetting", &OpticsSpec::vignetting, VignettingSchema(), "")
      .Key("rim", &OpticsSpec::rim, RimSchema(), "")
      .Key("glare", &OpticsSpec::glare, GlareSchema(), "")
      .Key("aperture_blades",
           &OpticsSpec::aperture_blades,
           YamlInteger<int>(0, 32),
           "Blades of the aperture, which shape sun star and ghosts; 0: round.")
      .Key("aperture_rotation_deg",
           &OpticsSpec::aperture_rotation_deg,
           From(-360.0, 360.0),
           "Turns the aperture, in degrees.")
      .Key("sun_star", &OpticsSpec::sun_star, SunStarSchema(), "")
      .Key("ghosts",
           &OpticsSpec::ghosts,
           YamlNamed("ghost", GhostSchema(), true),
           "",
           [](const OpticsSpec& optics) { return !optics.ghosts.empty(); })
      .Finish([](const YamlMappingView& yaml, OpticsSpec& optics) {
        if (optics.glare.bloom + optics.glare.veil > 0.9) {
          yaml.Fail("glare", "expected bloom and veil to leave light for the picture");
        }
        if (optics.sun_star.strength > 0.0 && optics.aperture_blades < 2) {
          yaml.Fail(
              "aperture_blades",
              fmt::format("expected at least 2 for a sun star, got {}", optics.aperture_blades));
        }
      });
  return schema;
}

}  // namespace pfseq
