// SPDX-License-Identifier: Apache-2.0
#include "tests/sequence/schema_fixture.h"

namespace pfseq {
namespace {

class SequenceSchema : public SchemaTest {};

TEST_F(SequenceSchema, FillsInAllDefaults) {
  const SequenceSpec spec = Read(kSmall);
  EXPECT_EQ(spec.name, "pfseq");
  EXPECT_EQ(spec.image.size_px, (std::array{1200, 1200}));
  ASSERT_EQ(spec.lenses.size(), 1U);
  EXPECT_EQ(spec.lenses[0].value.model, "equidistant");
  EXPECT_EQ(spec.lenses[0].value.circle_px, 90.0);
  EXPECT_EQ(spec.trajectory, TrajectorySpec{});
  EXPECT_EQ(spec.scene, SceneSpec{});
  EXPECT_EQ(spec.light.sun, SunSpec{});
  EXPECT_EQ(spec.render, RenderSpec{});
}

// Trajectory, scene and optics have tests of their own.
TEST_F(SequenceSchema, ReadsEveryKeyIntoItsMember) {
  const SequenceSpec spec = Read(
      "name: every key\n"
      "image: {size_px: [640, 480]}\n"
      "lenses:\n"
      "  b: {model: kannala_brandt, fov_deg: 170, focal_px: [300, 301], principal_point_px: "
      "[320.5, 240],\n"
      "      image_width_px: 640, coefficients: [0.1, 0.01, 0.001, 0.0001]}\n"
      "  a: {model: perspective, fov_deg: 90, focal_px: 200}\n"
      "rig:\n"
      "  cameras:\n"
      "    z: {position_m: [1, 2, 3], rotation_xzy_deg: [4, 5, 6]}\n"
      "    y: {}\n"
      "light:\n"
      "  sun: {elevation_deg: 20, azimuth_deg: 21, angular_diameter_deg: 2.2, strength: 23}\n"
      "  sky: {model: constant, turbidity: 2.4, clouds: {share: 0.24, seed: 34}, radiance: [25, "
      "26, "
      "27],\n"
      "        map_rotation_deg: 35, strength: 28}\n"
      "render: {light: path, light_quality: 3.5, seed: 29, samples: 30, max_samples: 36, "
      "max_bounces: 31, min_indirect_roughness: 0.37}\n"
      "shutter: {exposure_s: 0.38, ramp: 0.39, offset_s: -0.4, readout_s: 0.41, readout: left}\n"
      "sensor: {exposure: 32, metering: frame, tone_curve: clip, encoding: linear, "
      "white_electrons: 7000, read_noise_electrons: 7.1, mosaic: gbrg, color: grey, bits: 8, "
      "jpeg_quality: 72}\n"
      "ground_truth: {max_distance_m: 33}\n");
  SequenceSpec expected;
  expected.name = "every key";
  expected.image.size_px = {640, 480};
  LensSpec polynomial;
  polynomial.model = "kannala_brandt";
  polynomial.fov_deg = 170.0;
  polynomial.focal_px = {300.0, 301.0};
  polynomial.principal_point_px = {320.5, 240.0};
  polynomial.image_width_px = 640;
  polynomial.coefficients = {0.1, 0.01, 0.001, 0.0001};
  LensSpec pinhole;
  pinhole.model = "perspective";
  pinhole.fov_deg = 90.0;
  pinhole.focal_px = {200.0, 200.0};
  expected.lenses = {{"b", polynomial}, {"a", pinhole}};
  expected.cameras = {{"z", {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}}, {"y", {}}};
  expected.light.sun = SunSpec{
      .elevation_deg = 20.0, .azimuth_deg = 21.0, .angular_diameter_deg = 2.2, .strength = 23.0};
  expected.light.sky = {.model = "constant",
                        .turbidity = 2.4,
                        .clouds = {0.24, 34},
                        .radiance = {25.0, 26.0, 27.0},
                        .map_rotation_deg = 35.0,
                        .strength = 28.0};
  expected.render = {.light = "path",
                     .light_quality = 3.5,
                     .seed = 29,
                     .samples = 30,
                     .max_samples = 36,
                     .max_bounces = 31,
                     .min_indirect_roughness = 0.37};
  expected.shutter = {0.38, 0.39, -0.4, 0.41, "left"};
  expected.sensor = {32.0, "frame", "clip", "linear", 7000.0, 7.1, "gbrg", "grey", 8, 72};
  expected.ground_truth = {33.0};
  EXPECT_EQ(spec, expected);
  // The canonical form of a description that sets every key gives it back.
  EXPECT_EQ(Read(CanonicalYaml(spec)), expected);
  EXPECT_EQ(CanonicalYaml(Read(CanonicalYaml(spec))), CanonicalYaml(spec));
}

TEST_F(SequenceSchema, CanonicalFormOfShippedSequencesIsStable) {
  for (const std::string name : {"pfseq.yaml", "tiny.yaml"}) {
    const SequenceSpec spec = ReadSequenceSpec(kData / "sequences" / name);
    const std::string text = CanonicalYaml(spec);
    EXPECT_EQ(Read(text), spec) << name;
    EXPECT_EQ(CanonicalYaml(Read(text)), text) << name;
  }
}

TEST_F(SequenceSchema, CanonicalFormWritesVersionAndDefaults) {
  const std::string text = CanonicalYaml(Read(kSmall));
  EXPECT_EQ(
      text.find("pfseq_version: " PFSEQ_VERSION "\nname: pfseq\nimage:\n  size_px: [1200, 1200]\n"),
      0U)
      << text;
  EXPECT_NE(text.find("\n    fov_deg: 181.8\n    circle_px: 90\n    image_width_px: 0\nrig:\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\n      rotation_xzy_deg: [0, 0, 0]\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n  sun:\n    elevation_deg: 40\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("gltf"), std::string::npos) << text;
  EXPECT_EQ(text.find("coefficients"), std::string::npos) << text;
}

TEST_F(SequenceSchema, KeepsTheOrderOfCameras) {
  const SequenceSpec spec = ReadSequenceSpec(kData / "sequences" / "pfseq.yaml");
  ASSERT_EQ(spec.cameras.size(), 2U);
  EXPECT_EQ(spec.cameras[0].name, "front");
  EXPECT_EQ(spec.cameras[1].name, "rear");
  EXPECT_EQ(spec.cameras[1].value.position_m, (std::array{-2.0, 0.0, 0.0}));
  EXPECT_EQ(spec.cameras[1].value.rotation_xzy_deg, (std::array{-8.0, 6.0, -7.0}));
}

TEST_F(SequenceSchema, OverridesReachEveryKey) {
  const SequenceSpec spec = ReadSequenceSpec(kData / "sequences" / "pfseq.yaml",
                                             {"image.size_px=300",
                                              "lenses.equisolid.fov_deg=170",
                                              "rig.cameras.rear.position_m=[-1, 0, 0.5]",
                                              "trajectory.drive.turn=right",
                                              "light.sky.radiance=[1, 2, 3]",
                                              "render.samples=16",
                                              "render.samples=17"});
  EXPECT_EQ(spec.image.size_px, (std::array{300, 300}));
  EXPECT_EQ(spec.lenses[1].value.fov_deg, 170.0);
  EXPECT_EQ(spec.lenses[0].value.fov_deg, 181.8);
  EXPECT_EQ(spec.cameras[1].value.position_m, (std::array{-1.0, 0.0, 0.5}));
  EXPECT_EQ(spec.trajectory.drive.turn, "right");
  EXPECT_EQ(spec.light.sky.radiance, (std::array{1.0, 2.0, 3.0}));
  EXPECT_EQ(spec.render.samples, 17);
}

TEST_F(SequenceSchema, OverridesReachEachKeyOfTheHelp) {
  // Each documented key takes an override (which is refused for its value here, not for its name).
  const std::string help = SchemaHelp();
  int num_keys = 0;
  for (size_t start = 0; start < help.size(); start = help.find('\n', start) + 1) {
    if (help[start] == ' ') {
      continue;
    }
    std::string key = help.substr(start, help.find(':', start) - start);
    for (const auto& [mapping, name] : {std::pair{"lenses.", "fish"},
                                        std::pair{"rig.cameras.", "front"},
                                        std::pair{"optics.ghosts.", "one"}}) {
      if (key.find(mapping) == 0) {
        key.replace(key.find("NAME"), 4, name);
      }
    }
    const std::string message =
        ErrorOf(std::string(kSmall) + "optics: {ghosts: {one: {}}}\n", {key + "={}"});
    EXPECT_EQ(message.find("--set " + key + "={}: expected "), 0U) << message;
    ++num_keys;
  }
  EXPECT_GE(num_keys, 40);
}

TEST_F(SequenceSchema, HelpTellsDefaultsRangesAndMeaning) {
  const std::string help = SchemaHelp();
  EXPECT_NE(help.find("lenses.NAME.fov_deg: 181.8\n    a number > 0 and <= 360\n    Full field of "
                      "view in degrees"),
            std::string::npos)
      << help;
  EXPECT_NE(help.find("scene.gltf: absent\n    the path of a file\n"), std::string::npos) << help;
  EXPECT_NE(help.find("lenses.NAME.circle_px: absent\n"), std::string::npos) << help;
  EXPECT_NE(help.find("light.sun.elevation_deg: 40\n"), std::string::npos) << help;
}

TEST_F(SequenceSchema, RefusesWhatIsNoDescription) {
  EXPECT_EQ(ErrorOf(""),
            "demo.yaml: expected the description of a sequence (KEY: VALUE), got nothing");
  EXPECT_EQ(ErrorOf("- a\n"),
            "demo.yaml:1: expected the description of a sequence (KEY: VALUE), got a list of 1");
  EXPECT_EQ(ErrorOf("text"),
            "demo.yaml:1: expected the description of a sequence (KEY: VALUE), got text");
  EXPECT_EQ(ErrorOf("a: [1\n").find("demo.yaml:"), 0U);
  EXPECT_EQ(ErrorOf("rig: {cameras: {front: {}}}\n"),
            "demo.yaml:1: lenses: expected at least one lens by name (a-z, 0-9, _), got nothing");
  EXPECT_EQ(
      ErrorOf("lenses: {fish: {circle_px: 90}}\n"),
      "demo.yaml:1: rig.cameras: expected at least one camera by name (a-z, 0-9, _), got nothing");
  EXPECT_EQ(ErrorOf("lenses: {Fish: {circle_px: 90}}\n"),
            "demo.yaml:1: lenses.Fish: expected a name of up to 64 of a-z, 0-9 and _");
  EXPECT_THROW(ReadSequenceSpec(folder_ / "missing.yaml"), InputError);
}

TEST_F(SequenceSchema, RefusesWrongValuesWithTheirLine) {
  const std::string small = kSmall;
  EXPECT_EQ(ErrorOf(small + "image:\n  size_px: -3\n"),
            "demo.yaml:7: image.size_px: expected a whole number from 1 to 32768, got -3");
  EXPECT_EQ(ErrorOf(small, {"image.size_px=-3"}),
            "--set image.size_px=-3: expected a whole number from 1 to 32768, got -3");
  EXPECT_EQ(ErrorOf(small + "light: {sky: {radiance: [1, .nan, 1]}}\n"),
            "demo.yaml:6: light.sky.radiance: expected a number from 0 to 1000000, got .nan");
}

TEST_F(SequenceSchema, OverridesReplaceTheAlternativeInTheFile) {
  const std::string text = std::string(kSmall) + "scene: {canyon: {seed: 3}}\n";
  const SequenceSpec spec = Read(text, {"scene.gltf=/a/b.glb", "lenses.fish.focal_px=33"});
  EXPECT_EQ(spec.scene.gltf, "/a/b.glb");
  EXPECT_EQ(spec.scene.canyon, CanyonSpec{});
  EXPECT_EQ(spec.lenses[0].value.circle_px, 0.0);
  EXPECT_EQ(spec.lenses[0].value.focal_px, (std::array{33.0, 33.0}));
  EXPECT_EQ(Read(CanonicalYaml(spec)), spec);
}

TEST_F(SequenceSchema, PathsStartAtTheFilesFolder) {
  const SequenceSpec spec =
      Read(std::string(kSmall) + "scene: {gltf: sub/../a.glb}\ntrajectory: {tum: p.txt}\n");
  EXPECT_EQ(spec.scene.gltf, (folder_.Path() / "a.glb").string());
  EXPECT_EQ(spec.trajectory.tum, (folder_.Path() / "p.txt").string());
}

TEST_F(SequenceSchema, AcceptsAnotherVersionsFile) {
  EXPECT_EQ(Read("pfseq_version: 99.0.0\n" + std::string(kSmall)), Read(kSmall));
}

TEST_F(SequenceSchema, TheShippedSequenceHasTheDefaults) {
  const SequenceSpec spec = ReadSequenceSpec(kData / "sequences" / "pfseq.yaml");
  EXPECT_EQ(spec.name, "pfseq");
  EXPECT_EQ(spec.image, ImageSpec{});
  // Its drive is tested with the poses.
  TrajectorySpec trajectory = spec.trajectory;
  trajectory.drive = DriveSpec{};
  EXPECT_EQ(trajectory, TrajectorySpec{});
  // All but what makes the city like PFSeq's: quieter streets of flat stone fronts, flat roofs.
  SceneSpec scene = spec.scene;
  EXPECT_EQ(scene.canyon.relief, 0.1);
  EXPECT_EQ(scene.canyon.street_life, 0.6);
  EXPECT_EQ(scene.canyon.small_panes, 0.3);
  EXPECT_EQ(scene.canyon.rubble, 1.0);
  EXPECT_EQ(scene.canyon.pitched_roof_share, 0.0);
  EXPECT_EQ(scene.canyon.street_width_m, (std::array{18.0, 22.0}));
  EXPECT_EQ(scene.canyon.building_height_m, (std::array{18.0, 34.0}));
  scene.canyon.relief = CanyonSpec{}.relief;
  scene.canyon.small_panes = CanyonSpec{}.small_panes;
  scene.canyon.rubble = CanyonSpec{}.rubble;
  scene.canyon.pitched_roof_share = CanyonSpec{}.pitched_roof_share;
  scene.canyon.street_life = CanyonSpec{}.street_life;
  scene.canyon.street_width_m = CanyonSpec{}.street_width_m;
  scene.canyon.building_height_m = CanyonSpec{}.building_height_m;
  EXPECT_EQ(scene, SceneSpec{});
  // The sun is seen over the cross street.
  EXPECT_EQ(spec.light.sun, (SunSpec{.elevation_deg = 60.0, .azimuth_deg = 97.0}));
  // All but the clouds.
  SkySpec sky = spec.light.sky;
  EXPECT_EQ(sky.clouds.share, 0.25);
  sky.clouds = CloudSpec{};
  EXPECT_EQ(sky, SkySpec{});
  EXPECT_EQ(spec.render, RenderSpec{});
  // A camera that exposes for the street's shade.
  SensorSpec sensor = spec.sensor;
  EXPECT_EQ(sensor.exposure, 0.055);
  sensor.exposure.reset();
  EXPECT_EQ(sensor, SensorSpec{});
  EXPECT_EQ(spec.ground_truth, GroundTruthSpec{});
  EXPECT_TRUE(spec.IsRealistic());
}

TEST_F(SequenceSchema, TellsSequencesFromLenses) {
  EXPECT_TRUE(IsSequenceFile(kData / "sequences" / "tiny.yaml"));
  EXPECT_FALSE(IsSequenceFile(kData / "lenses" / "pfseq-equisolid.yaml"));
  WriteFileAtomically(path_, std::string_view("[1, 2]\n"));
  EXPECT_THROW(IsSequenceFile(path_), InputError);
}

}  // namespace
}  // namespace pfseq
