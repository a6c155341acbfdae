// SPDX-License-Identifier: Apache-2.0
#include "renderer/lit_scene.h"

#include "tests/renderer/room.h"
#include "tests/support/temp_folder.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// What a change of a description is called, and the change.
using Change = std::pair<std::string, std::function<void(SequenceSpec&)>>;

TEST(LitSceneKey, IsTheSameForOtherCameras) {
  const std::vector<Change> changes = {
      {"name", [](SequenceSpec& spec) { spec.name = "other"; }},
      {"image",
       [](SequenceSpec& spec) {
         spec.image.size_px = {48, 32};
       }},
      {"lens", [](SequenceSpec& spec) { spec.lenses[0].value.fov_deg = 120.0; }},
      {"number of lenses", [](SequenceSpec& spec) { spec.lenses.pop_back(); }},
      {"camera", [](SequenceSpec& spec) { spec.cameras[1].value.position_m[0] = -3.0; }},
      {"number of cameras", [](SequenceSpec& spec) { spec.cameras.pop_back(); }},
      {"shutter", [](SequenceSpec& spec) { spec.shutter.exposure_s = 0.5; }},
      {"optics", [](SequenceSpec& spec) { spec.optics.defocus_px = 3.0; }},
      {"exposure", [](SequenceSpec& spec) { spec.sensor.exposure = 2.0; }},
      {"sensor", [](SequenceSpec& spec) { spec.sensor.white_electrons = 3000.0; }},
      {"way of the light", [](SequenceSpec& spec) { spec.render.light = "path"; }},
      {"samples", [](SequenceSpec& spec) { spec.render.samples = 17; }},
      {"max_samples", [](SequenceSpec& spec) { spec.render.max_samples = 17; }},
      {"seed", [](SequenceSpec& spec) { spec.render.seed = 17; }},
      {"ground truth", [](SequenceSpec& spec) { spec.ground_truth.max_distance_m = 50.0; }}};
  const std::string key = LitSceneKey(Room().spec);
  for (const auto& [name, change] : changes) {
    SequenceSpec spec = Room().spec;
    change(spec);
    EXPECT_NE(spec, Room().spec) << name;
    EXPECT_EQ(LitSceneKey(spec), key) << name;
  }
}

TEST(LitSceneKey, IsAnotherForOtherScenesAndLight) {
  const std::vector<Change> changes = {
      {"city", [](SequenceSpec& spec) { spec.scene.canyon.seed = 2; }},
      {"file", [](SequenceSpec& spec) { spec.scene.gltf = "/a/b.glb"; }},
      {"drive", [](SequenceSpec& spec) { spec.trajectory.drive.first_street_m = 47.0; }},
      {"frames", [](SequenceSpec& spec) { spec.trajectory.num_frames = 4; }},
      {"height", [](SequenceSpec& spec) { spec.trajectory.height_m = 2.0; }},
      {"sun", [](SequenceSpec& spec) { spec.light.sun->azimuth_deg = 7.0; }},
      {"no sun", [](SequenceSpec& spec) { spec.light.sun.reset(); }},
      {"sky", [](SequenceSpec& spec) { spec.light.sky.turbidity = 5.0; }},
      {"clouds", [](SequenceSpec& spec) { spec.light.sky.clouds.share = 0.5; }},
      {"light_quality", [](SequenceSpec& spec) { spec.render.light_quality = 2.0; }},
      {"max_bounces", [](SequenceSpec& spec) { spec.render.max_bounces = 2; }},
      {"roughness", [](SequenceSpec& spec) { spec.render.min_indirect_roughness = 0.0; }}};
  std::set<std::string> keys = {LitSceneKey(Room().spec)};
  for (const auto& [name, change] : changes) {
    SequenceSpec spec = Room().spec;
    change(spec);
    EXPECT_TRUE(keys.insert(LitSceneKey(spec)).second) << name;
  }
}

TEST(LitScene, HasTheLightOfTheDescription) {
  SequenceInput input = Room();
  input.spec.light.sun->elevation_deg = 30.0;
  const LitScene lit(input);
  EXPECT_EQ(lit.Key(), LitSceneKey(input.spec));
  ASSERT_TRUE(lit.Light().sun.has_value());
  EXPECT_NEAR(lit.Light().sun->DirectionToSun().z(), 0.5, 1e-6);
  EXPECT_EQ(&lit.Rays().PlainScene(), input.scene.get());
  // One that was made already is taken as it is.
  input.lighting =
      std::make_shared<const Lighting>(Lighting{std::nullopt, Sky::Constant(Rgb::Constant(2.0F))});
  EXPECT_EQ(&LitScene(input).Light(), input.lighting.get());
}

TEST(LitScene, StoredLightIsLoadedOnce) {
  const TempFolder folder;
  const SequenceInput input = Room();
  LitScene lit(input);
  CachedLight& first = lit.Stored({.folder = folder / "first"});
  EXPECT_EQ(&lit.Stored({.folder = folder / "second"}), &first);
  EXPECT_NE(first.Summary().find((folder / "first").string()), std::string::npos)
      << first.Summary();
}

/// Files of stored light, from inputs that are changed one after the other.
class StoredLightFile : public testing::Test {
 protected:
  /// How many files there are once the light of `input` has been stored.
  size_t NumFilesWith(const SequenceInput& input) {
    LitScene lit(input);
    const Lens lens(Equidistant{}, Vec2d::Constant(4.0), Vec2d::Constant(6.0), 1.5);
    const LensRaster raster(lens, 12, 12, 1);
    const View view{.lens = &lens,
                    .world_from_camera = {Eigen::Quaterniond::Identity(), Vec3d(0.0, 0.0, 1.6)},
                    .width_px = 12,
                    .height_px = 12};
    lit.Stored({.folder = folder_ / "light"}).Prepare({{&raster, view}}, {}, 1, true);
    size_t num = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "light")) {
      num += entry.path().extension() == ".light" ? 1 : 0;
    }
    return num;
  }

  TempFolder folder_;
};

TEST_F(StoredLightFile, IsSharedByCamerasAndTellsScenesApart) {
  SequenceInput input = Room();
  EXPECT_EQ(NumFilesWith(input), 1U);
  input.spec.image.size_px = {48, 48};
  input.spec.shutter.exposure_s = 0.5;
  input.files[0].bytes = "another description of the cameras";
  EXPECT_EQ(NumFilesWith(input), 1U);
  input.files[1].bytes = "another scene";
  EXPECT_EQ(NumFilesWith(input), 2U);
  input.spec.light.sun->elevation_deg = 7.0;
  EXPECT_EQ(NumFilesWith(input), 3U);
}

TEST_F(StoredLightFile, GoesByTheBytesOfASkyMapNotByItsName) {
  SequenceInput input = Room();
  input.lighting =
      std::make_shared<const Lighting>(Lighting{std::nullopt, Sky::Constant(Rgb::Constant(2.0F))});
  input.spec.light.sun.reset();
  input.spec.light.sky.model = "map";
  input.spec.light.sky.map = "/here/sky.exr";
  input.files.push_back({"sky_map.exr", "a sky"});
  EXPECT_EQ(NumFilesWith(input), 1U);
  input.spec.light.sky.map = "/there/sky.exr";
  EXPECT_EQ(NumFilesWith(input), 1U);
  input.files.back().bytes = "another sky";
  EXPECT_EQ(NumFilesWith(input), 2U);
}

}  // namespace
}  // namespace pfseq
