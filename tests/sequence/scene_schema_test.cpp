// SPDX-License-Identifier: Apache-2.0
#include "tests/sequence/schema_fixture.h"

namespace pfseq {
namespace {

class SceneSchema : public SchemaTest {};

/// kSmall with a mapping `scene.canyon`.
std::string WithCanyon(const std::string& canyon) {
  return std::string(kSmall) + "scene: {canyon: {" + canyon + "}}\n";
}

TEST_F(SceneSchema, ReadsEveryKeyIntoItsMember) {
  const SequenceSpec spec = Read(
      WithCanyon("seed: 12, street_width_m: [13, 14], building_height_m: [15, 16], detail: 1.7, "
                 "relief: 0.6, small_panes: 0.3, rubble: 0.7, street_life: 1.8, texel_m: 0.019, "
                 "pitched_roof_share: 0.18, surrounding_blocks: 19, facades: photos/all.yaml"));
  const CanyonSpec expected = {.seed = 12,
                               .street_width_m = {13.0, 14.0},
                               .building_height_m = {15.0, 16.0},
                               .detail = 1.7,
                               .relief = 0.6,
                               .small_panes = 0.3,
                               .rubble = 0.7,
                               .street_life = 1.8,
                               .texel_m = 0.019,
                               .pitched_roof_share = 0.18,
                               .surrounding_blocks = 19,
                               .facades = (folder_.Path() / "photos/all.yaml").string()};
  EXPECT_EQ(spec.scene.canyon, expected);
  EXPECT_EQ(Read(CanonicalYaml(spec)), spec);
  EXPECT_EQ(CanonicalYaml(Read(CanonicalYaml(spec))), CanonicalYaml(spec));
}

TEST_F(SceneSchema, KeysThatAreNotThereKeepTheirDefaults) {
  SceneSpec expected;
  EXPECT_EQ(Read(kSmall).scene, expected);
  expected.canyon.relief = 0.5;
  EXPECT_EQ(Read(WithCanyon("relief: 0.5")).scene, expected);
}

TEST_F(SceneSchema, TheCanonicalFormHasOneSceneAndPhotographsOnlyWhereThereAreSome) {
  const std::string canyon = CanonicalYaml(Read(kSmall));
  EXPECT_NE(canyon.find("\nscene:\n  canyon:\n    seed: 1\n"), std::string::npos) << canyon;
  EXPECT_EQ(canyon.find("gltf"), std::string::npos) << canyon;
  EXPECT_EQ(canyon.find("facades"), std::string::npos) << canyon;
  const SequenceSpec spec = Read(std::string(kSmall) + "scene: {gltf: /a/b.glb}\n");
  const std::string gltf = CanonicalYaml(spec);
  EXPECT_NE(gltf.find("\nscene:\n  gltf: /a/b.glb\n"), std::string::npos) << gltf;
  EXPECT_EQ(gltf.find("canyon"), std::string::npos) << gltf;
  EXPECT_EQ(Read(gltf), spec);
}

TEST_F(SceneSchema, TakesNumbersUpToTheEndsOfTheirRange) {
  ExpectRange("scene.canyon.detail", 0.0, 2.0);
  ExpectRange("scene.canyon.relief", 0.05, 1.0);
  ExpectRange("scene.canyon.small_panes", 0.0, 1.0);
  ExpectRange("scene.canyon.rubble", 0.0, 1.0);
  ExpectRange("scene.canyon.street_life", 0.0, 2.0);
  ExpectRange("scene.canyon.texel_m", 0.004, 1.0);
  ExpectRange("scene.canyon.pitched_roof_share", 0.0, 1.0);
  ExpectWholeRange("scene.canyon.surrounding_blocks", 0, 20);
}

TEST_F(SceneSchema, SeedsHave64Bits) {
  EXPECT_EQ(Read(WithCanyon("seed: 18446744073709551615")).scene.canyon.seed, UINT64_MAX);
  EXPECT_EQ(Read(WithCanyon("seed: 0")).scene.canyon.seed, 0U);
  const std::string expected =
      "demo.yaml:6: scene.canyon.seed: expected a whole number from 0 to 18446744073709551615, "
      "got ";
  for (const std::string seed : {"-1", "18446744073709551616", "1.5", "one"}) {
    EXPECT_EQ(ErrorOf(WithCanyon("seed: " + seed)), expected + seed);
  }
}

TEST_F(SceneSchema, RefusesWidthsAndHeightsThatAreNoInterval) {
  EXPECT_EQ(ErrorOf(std::string(kSmall) + "scene:\n  canyon:\n    street_width_m: [18, 12]\n"),
            "demo.yaml:8: scene.canyon.street_width_m: expected the least first, got [18, 12]");
  EXPECT_EQ(ErrorOf(WithCanyon("building_height_m: [20.5, 20]")),
            "demo.yaml:6: scene.canyon.building_height_m: expected the least first, got [20.5, "
            "20]");
  EXPECT_EQ(ErrorOf(WithCanyon("street_width_m: [3.9, 12]")),
            "demo.yaml:6: scene.canyon.street_width_m: expected a number from 4 to 100, got 3.9");
  EXPECT_EQ(ErrorOf(WithCanyon("building_height_m: [3, 301]")),
            "demo.yaml:6: scene.canyon.building_height_m: expected a number from 3 to 300, got "
            "301");
  EXPECT_EQ(ErrorOf(WithCanyon("street_width_m: 12")),
            "demo.yaml:6: scene.canyon.street_width_m: expected a list of 2 (each a number from 4 "
            "to 100), got 12");
  // All of one width and one height.
  const CanyonSpec canyon =
      Read(WithCanyon("street_width_m: [4, 4], building_height_m: [300, 300]")).scene.canyon;
  EXPECT_EQ(canyon.street_width_m, (std::array{4.0, 4.0}));
  EXPECT_EQ(canyon.building_height_m, (std::array{300.0, 300.0}));
}

TEST_F(SceneSchema, IsACanyonOrAFile) {
  EXPECT_EQ(ErrorOf(std::string(kSmall) + "scene: {canyon: {}, gltf: a.glb}\n"),
            "demo.yaml:6: scene.gltf: expected either this or canyon, got both");
  // An override takes the place of the other in the file.
  EXPECT_EQ(Read(WithCanyon("seed: 3"), {"scene.gltf=/a/b.glb"}).scene,
            (SceneSpec{.gltf = "/a/b.glb"}));
  EXPECT_EQ(Read(std::string(kSmall) + "scene: {gltf: a.glb}\n", {"scene.canyon.seed=3"}).scene,
            (SceneSpec{.canyon = {.seed = 3}}));
}

TEST_F(SceneSchema, RefusesUnknownKeys) {
  EXPECT_EQ(ErrorOf(WithCanyon("small_pane: 1")),
            "demo.yaml:6: scene.canyon.small_pane: unknown key; did you mean small_panes?");
  EXPECT_EQ(ErrorOf(std::string(kSmall) + "scene: {gtlf: a.glb}\n"),
            "demo.yaml:6: scene.gtlf: unknown key; did you mean gltf?");
}

}  // namespace
}  // namespace pfseq
