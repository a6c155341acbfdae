// SPDX-License-Identifier: Apache-2.0
#include "tests/sequence/schema_fixture.h"

namespace pfseq {
namespace {

class OpticsSchema : public SchemaTest {};

TEST_F(OpticsSchema, ReadsEveryKeyIntoItsMember) {
  const SequenceSpec spec = Read(
      std::string(kSmall) +
      "optics:\n"
      "  image_width_px: 1000\n"
      "  lateral_color: {rim_px: -4.2, cubic: 0.43}\n"
      "  axial_color_sigma_px: 4.4\n"
      "  dispersion_sigma_px: 4.5\n"
      "  blur: {center_sigma_px: 4.6, rim_sigma_px: [4.7, 4.8]}\n"
      "  defocus_px: 4.9\n"
      "  vignetting: {natural: 0.50, mechanical: 0.51, mechanical_start: 0.52}\n"
      "  rim: {width_px: 53, reach: [0.54, 0.55, 0.56]}\n"
      "  glare: {bloom: 0.057, bloom_radius_px: 58, veil: 0.059}\n"
      "  aperture_blades: 9\n"
      "  aperture_rotation_deg: 60\n"
      "  sun_star: {strength: 0.061, length_px: 62, width_px: 6.3}\n"
      "  ghosts:\n"
      "    one: {position: 0.64, radius_px: 65, strength: [0.066, 0.067, 0.068], hollow: 0.69}\n"
      "    two: {}\n");
  const OpticsSpec expected = {
      .image_width_px = 1000,
      .lateral_color = {-4.2, 0.43},
      .axial_color_sigma_px = 4.4,
      .dispersion_sigma_px = 4.5,
      .blur = {4.6, {4.7, 4.8}},
      .defocus_px = 4.9,
      .vignetting = {0.50, 0.51, 0.52},
      .rim = {53.0, {0.54, 0.55, 0.56}},
      .glare = {0.057, 58.0, 0.059},
      .aperture_blades = 9,
      .aperture_rotation_deg = 60.0,
      .sun_star = {0.061, 62.0, 6.3},
      .ghosts = {{"one", {0.64, 65.0, {0.066, 0.067, 0.068}, 0.69}}, {"two", {}}}};
  EXPECT_EQ(spec.optics, expected);
  EXPECT_EQ(Read(CanonicalYaml(spec)), spec);
  EXPECT_EQ(CanonicalYaml(Read(CanonicalYaml(spec))), CanonicalYaml(spec));
}

TEST_F(OpticsSchema, KeysThatAreNotThereKeepTheirDefaults) {
  EXPECT_EQ(Read(kSmall).optics, OpticsSpec{});
  EXPECT_FALSE(Read(kSmall).optics.IsOn());
  OpticsSpec expected;
  expected.glare.veil = 0.25;
  expected.ghosts = {{"a", {.hollow = 0.5}}};
  EXPECT_EQ(
      Read(std::string(kSmall) + "optics: {glare: {veil: 0.25}, ghosts: {a: {hollow: 0.5}}}\n")
          .optics,
      expected);
}

TEST_F(OpticsSchema, TheCanonicalFormHasGhostsOnlyWhereThereAreSome) {
  EXPECT_EQ(CanonicalYaml(Read(kSmall)).find("ghosts"), std::string::npos);
  const std::string text = CanonicalYaml(Read(std::string(kSmall) + "optics: {ghosts: {a: {}}}\n"));
  EXPECT_NE(text.find("\n  ghosts:\n    a:\n      position: -0.5\n"), std::string::npos) << text;
}

TEST_F(OpticsSchema, OneNumberStandsForAllDirectionsAndColours) {
  const OpticsSpec optics =
      Read(std::string(kSmall) +
           "optics: {blur: {rim_sigma_px: 2}, ghosts: {a: {strength: 0.001}}}\n")
          .optics;
  EXPECT_EQ(optics.blur.rim_sigma_px, (std::array{2.0, 2.0}));
  EXPECT_EQ(optics.ghosts[0].value.strength, (std::array{0.001, 0.001, 0.001}));
  // Where the colours end says nothing when it is the same for all.
  EXPECT_EQ(ErrorOf(std::string(kSmall) + "optics: {rim: {reach: 1}}\n"),
            "demo.yaml:6: optics.rim.reach: expected a list of 3 (each a number from 0 to 1), got "
            "1");
}

TEST_F(OpticsSchema, TakesNumbersUpToTheEndsOfTheirRange) {
  ExpectWholeRange("optics.image_width_px", 0, 1000000);
  ExpectRange("optics.lateral_color.rim_px", -64.0, 64.0);
  ExpectRange("optics.lateral_color.cubic", -10.0, 10.0);
  ExpectRange("optics.axial_color_sigma_px", 0.0, 64.0);
  ExpectRange("optics.dispersion_sigma_px", 0.0, 64.0);
  ExpectRange("optics.blur.center_sigma_px", 0.0, 64.0);
  ExpectRange("optics.defocus_px", 0.0, 64.0);
  ExpectRange("optics.vignetting.natural", 0.0, 1.0);
  ExpectRange("optics.vignetting.mechanical", 0.0, 1.0);
  ExpectRange("optics.vignetting.mechanical_start", 0.0, 0.999);
  ExpectRange("optics.rim.width_px", 0.0, 10000.0);
  ExpectRange("optics.glare.bloom", 0.0, 0.5);
  ExpectRange("optics.glare.bloom_radius_px", 2.0, 10000.0);
  ExpectRange("optics.glare.veil", 0.0, 0.5);
  ExpectWholeRange("optics.aperture_blades", 0, 32);
  ExpectRange("optics.aperture_rotation_deg", -360.0, 360.0);
  ExpectRange("optics.sun_star.strength", 0.0, 0.5);
  ExpectAbove0("optics.sun_star.length_px", 10000.0);
  ExpectRange("optics.sun_star.width_px", 0.5, 100.0);
}

TEST_F(OpticsSchema, RefusesElementsBeyondTheirRange) {
  const auto error = [&](const std::string& optics) {
    return ErrorOf(std::string(kSmall) + "optics: {" + optics + "}\n");
  };
  EXPECT_EQ(error("blur: {rim_sigma_px: [1, 64.5]}"),
            "demo.yaml:6: optics.blur.rim_sigma_px: expected a number from 0 to 64, got 64.5");
  EXPECT_EQ(error("rim: {reach: [0.5, -0.1, 1]}"),
            "demo.yaml:6: optics.rim.reach: expected a number from 0 to 1, got -0.1");
  EXPECT_EQ(error("ghosts: {one: {position: -11}}"),
            "demo.yaml:6: optics.ghosts.one.position: expected a number from -10 to 10, got -11");
  EXPECT_EQ(error("ghosts: {one: {radius_px: 0.9}}"),
            "demo.yaml:6: optics.ghosts.one.radius_px: expected a number from 1 to 10000, got 0.9");
  EXPECT_EQ(error("ghosts: {one: {strength: 0.6}}"),
            "demo.yaml:6: optics.ghosts.one.strength: expected a number from 0 to 0.5, got 0.6");
  EXPECT_EQ(error("ghosts: {one: {hollow: 1}}"),
            "demo.yaml:6: optics.ghosts.one.hollow: expected a number from 0 to 0.95, got 1");
}

TEST_F(OpticsSchema, RefusesUnknownKeys) {
  const auto error = [&](const std::string& optics) {
    return ErrorOf(std::string(kSmall) + "optics: {" + optics + "}\n");
  };
  EXPECT_EQ(error("vigneting: {}"),
            "demo.yaml:6: optics.vigneting: unknown key; did you mean vignetting?");
  EXPECT_EQ(error("glare: {bloom_px: 3}").find("demo.yaml:6: optics.glare.bloom_px: unknown key"),
            0U);
  EXPECT_EQ(error("ghosts: {Two: {}}"),
            "demo.yaml:6: optics.ghosts.Two: expected a name of up to 64 of a-z, 0-9 and _");
}

TEST_F(OpticsSchema, RefusesGlareThatLeavesNoPicture) {
  EXPECT_EQ(ErrorOf(std::string(kSmall) + "optics:\n  glare: {bloom: 0.5, veil: 0.41}\n"),
            "demo.yaml:7: optics.glare: expected bloom and veil to leave light for the picture");
  const OpticsSpec optics =
      Read(kSmall, {"optics.glare.bloom=0.5", "optics.glare.veil=0.375"}).optics;
  EXPECT_EQ(optics.glare, (GlareSpec{.bloom = 0.5, .veil = 0.375}));
}

TEST_F(OpticsSchema, ASunStarNeedsBlades) {
  for (const std::string blades : {"0", "1"}) {
    const std::string error =
        ErrorOf(kSmall, {"optics.aperture_blades=" + blades, "optics.sun_star.strength=0.1"});
    EXPECT_NE(error.find("expected at least 2 for a sun star, got " + blades), std::string::npos)
        << error;
    EXPECT_NE(error.find("optics.aperture_blades"), std::string::npos) << error;
    // Ghosts may be round.
    EXPECT_EQ(Read(std::string(kSmall) + "optics: {ghosts: {a: {}}}\n",
                   {"optics.aperture_blades=" + blades})
                  .optics.ghosts.size(),
              1U);
  }
  EXPECT_EQ(Read(kSmall, {"optics.aperture_blades=2", "optics.sun_star.strength=0.1"})
                .optics.aperture_blades,
            2);
}

TEST_F(OpticsSchema, EachShippedFileTurnsOnItsOwnEffect) {
  const auto read = [&](const std::string& name) {
    return Read(kSmall, {"optics=" + (kData / "optics" / (name + ".yaml")).string()}).optics;
  };
  EXPECT_FALSE(read("off").IsOn());
  for (const std::string name : {"lateral_color", "axial_color", "dispersion", "blur", "defocus"}) {
    const OpticsSpec optics = read(name);
    EXPECT_TRUE(optics.HasPointSpread()) << name;
    EXPECT_FALSE(optics.HasFalloff() || optics.HasGlare() || optics.HasFlare()) << name;
  }
  for (const std::string name : {"vignetting", "rim", "glare", "sun_star", "ghosts"}) {
    const OpticsSpec optics = read(name);
    EXPECT_EQ(optics.HasFalloff() + optics.HasGlare() + optics.HasFlare(), 1) << name;
    EXPECT_FALSE(optics.HasPointSpread()) << name;
  }
  for (const std::string name : {"pfseq", "strong"}) {
    const OpticsSpec optics = read(name);
    EXPECT_TRUE(optics.HasPointSpread() && optics.HasFalloff() && optics.HasGlare() &&
                optics.HasFlare())
        << name;
  }
}

}  // namespace
}  // namespace pfseq
