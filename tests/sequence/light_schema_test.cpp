// SPDX-License-Identifier: Apache-2.0
#include "tests/sequence/schema_fixture.h"

namespace pfseq {
namespace {

class LightSchema : public SchemaTest {};

TEST_F(LightSchema, LeavesTheSunToAGltfScene) {
  EXPECT_EQ(Read(std::string(kSmall) + "scene: {gltf: a.glb}\n").light.sun, std::nullopt);
  const SequenceSpec spec =
      Read(std::string(kSmall) + "scene: {gltf: a.glb}\nlight: {sun: {strength: 2}}\n");
  ASSERT_TRUE(spec.light.sun);
  EXPECT_EQ(spec.light.sun->strength, 2.0);
}

/// kSmall with a mapping `light`.
std::string WithLight(const std::string& light) {
  return std::string(kSmall) + "light: {" + light + "}\n";
}

TEST_F(LightSchema, TheSunFollowsFromDateAndPlace) {
  // Sun position algorithm's worked example (NREL TP-560-34302): 39.888 degrees high, 194.340
  // degrees from north; with north toward +Y that is 255.660 degrees from +X counter-clockwise.
  const std::string text = WithLight(
      "sun: {date_time: 2003-10-17T12:30:30-07:00, latitude_deg: 39.742476, longitude_deg: "
      "-105.1786, strength: 2}");
  const SequenceSpec spec = Read(text);
  EXPECT_NEAR(spec.light.sun->elevation_deg, 39.888, 0.01);
  EXPECT_NEAR(spec.light.sun->azimuth_deg + 360.0, 255.660, 0.01);
  EXPECT_EQ(spec.light.sun->strength, 2.0);
  EXPECT_NEAR(Read(text, {"light.sun.north_deg=100"}).light.sun->azimuth_deg,
              spec.light.sun->azimuth_deg + 10.0,
              1e-9);
  // The canonical form has the date and not the angles.
  const std::string canonical = CanonicalYaml(spec);
  EXPECT_NE(canonical.find("date_time: "), std::string::npos) << canonical;
  EXPECT_EQ(canonical.find("elevation_deg"), std::string::npos) << canonical;
  EXPECT_EQ(Read(canonical), spec);
  EXPECT_EQ(CanonicalYaml(Read(canonical)), canonical);
}

TEST_F(LightSchema, AnglesReplaceADateAndTheOtherWayRound) {
  const SequenceSpec by_angle =
      Read(WithLight("sun: {date_time: 2014-06-21T15:30:00+02:00, latitude_deg: 40}"),
           {"light.sun.elevation_deg=30"});
  EXPECT_EQ(by_angle.light.sun, SunSpec{.elevation_deg = 30.0});
  const SequenceSpec by_date = Read(WithLight("sun: {elevation_deg: 30, azimuth_deg: 20}"),
                                    {"light.sun.date_time=2014-06-21T15:30:00+02:00"});
  EXPECT_NEAR(by_date.light.sun->elevation_deg, 58.1, 0.5);
}

TEST_F(LightSchema, RefusesDatesThatGiveNoSun) {
  EXPECT_EQ(ErrorOf(WithLight("sun: {date_time: 2014-06-21T15:30:00+02:00, elevation_deg: 3}")),
            "demo.yaml:6: light.sun.elevation_deg: expected either this or date_time, got both");
  EXPECT_EQ(ErrorOf(WithLight("sun: {azimuth_deg: 3, north_deg: 30}")),
            "demo.yaml:6: light.sun.north_deg: expected either this or azimuth_deg, got both");
  EXPECT_EQ(ErrorOf(WithLight("sun: {latitude_deg: 3}")),
            "demo.yaml:6: light.sun.latitude_deg: expected only with date_time, got none");
  EXPECT_EQ(ErrorOf(WithLight("sun: {date_time: 2014-02-30T12:00Z}")),
            "demo.yaml:6: light.sun.date_time: expected a date from 1900 to 2099 and a time with "
            "its offset from UTC, such as 2014-06-21T15:30:00+02:00, got 2014-02-30T12:00Z");
  const std::string night = ErrorOf(WithLight("sun: {date_time: 2014-06-21T23:59:00+02:00}"));
  EXPECT_EQ(night.find("demo.yaml:6: light.sun.date_time: expected a time when the sun is up; at "
                       "2014-06-21T23:59:00+02:00 it stands at -13.4 degrees"),
            0U)
      << night;
}

TEST_F(LightSchema, AMapIsASkyWithItsOwnSun) {
  const SequenceSpec spec = Read(WithLight("sky: {map: sky/a.exr, map_rotation_deg: 30}"));
  EXPECT_EQ(spec.light.sky.model, "map");
  EXPECT_EQ(spec.light.sky.map, (folder_.Path() / "sky/a.exr").string());
  EXPECT_EQ(spec.light.sun, std::nullopt);
  EXPECT_EQ(Read(CanonicalYaml(spec)), spec);
}

TEST_F(LightSchema, OverridesExchangeMapAndSun) {
  const SequenceSpec with_map =
      ReadSequenceSpec(kData / "sequences" / "pfseq.yaml", {"light.sky.map=/a/b.hdr"});
  EXPECT_EQ(with_map.light.sky.model, "map");
  EXPECT_EQ(with_map.light.sun, std::nullopt);
  EXPECT_EQ(Read(CanonicalYaml(with_map)), with_map);
  const SequenceSpec without =
      Read(WithLight("sky: {model: map, map: a.exr}"), {"light.sky.model=clear"});
  EXPECT_EQ(without.light.sky.map, "");
  EXPECT_EQ(without.light.sun, SunSpec{});
}

TEST_F(LightSchema, RefusesMapsThatDoNotFit) {
  EXPECT_EQ(ErrorOf(WithLight("sun: {}, sky: {map: a.exr}")),
            "demo.yaml:6: light.sun: expected none with a sky map, which brings its own sun");
  EXPECT_EQ(ErrorOf(WithLight("sky: {map: a.exr}"), {"light.sun.strength=0"}),
            "--set light.sun.strength=0: light.sun: expected none with a sky map, which brings its "
            "own sun");
  EXPECT_EQ(ErrorOf(WithLight("sky: {model: clear, map: a.exr}")),
            "demo.yaml:6: light.sky.map: expected only with model: map, the model is clear");
  EXPECT_EQ(ErrorOf(WithLight("sky: {model: map}")),
            "demo.yaml:6: light.sky.map: expected the path of a file with model: map, got none");
}

}  // namespace
}  // namespace pfseq
