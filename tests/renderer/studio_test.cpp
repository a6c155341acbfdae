// SPDX-License-Identifier: Apache-2.0
#include "renderer/studio.h"

#include "renderer/core/units.h"
#include "tests/renderer/room.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// A U of 10, 20 and 10 m with corners of 2 m to the left; frame 1 is long after its end, which is
/// at x = 0, y = 24 m, with the rig turned round.
SequenceInput AfterTheDrive() {
  SequenceInput input = Room();
  input.spec.trajectory.drive = {.first_street_m = 10.0,
                                 .cross_street_m = 20.0,
                                 .last_street_m = 10.0,
                                 .corner_radius_m = 2.0};
  input.spec.trajectory.frame_rate_hz = 0.01;
  input.spec.trajectory.height_m = 1.5;
  input.spec.cameras[1].value = {.position_m = {-2.0, 1.0, 0.5}, .rotation_xzy_deg = {0, 0, 0}};
  return input;
}

/// Starts at once with 2 m/s2; a frame each second.
SequenceInput Starting() {
  SequenceInput input = Room();
  input.spec.trajectory.drive.stop_s = 0.0;
  input.spec.trajectory.drive.acceleration_mps2 = 2.0;
  input.spec.trajectory.frame_rate_hz = 1.0;
  input.spec.trajectory.height_m = 1.5;
  return input;
}

TEST(Studio, ViewsPutTheCameraOnTheRig) {
  const SequenceInput input = AfterTheDrive();
  const Studio studio(input, 1);
  const RigidTransform first = studio.ViewOf({0, 1, 0}).world_from_camera;
  EXPECT_LT((first.translation_m - Vec3d(-2.0, 1.0, 2.0)).norm(), 1e-9);
  EXPECT_LT((first.Direction(Vec3d::UnitX()) - Vec3d::UnitX()).norm(), 1e-9);
  const RigidTransform last = studio.ViewOf({1, 1, 0}).world_from_camera;
  EXPECT_LT((last.translation_m - Vec3d(2.0, 23.0, 2.0)).norm(), 1e-9);
  EXPECT_LT((last.Direction(Vec3d::UnitX()) + Vec3d::UnitX()).norm(), 1e-9);
  EXPECT_LT((last.Direction(Vec3d::UnitZ()) - Vec3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT(
      (studio.ViewOf({1, 0, 0}).world_from_camera.translation_m - Vec3d(0.0, 24.0, 1.5)).norm(),
      1e-9);
  // The same by time.
  const RigidTransform by_time = studio.WorldFromCamera({1, 1, 0}, 5.0);
  EXPECT_LT((by_time.translation_m - last.translation_m).norm(), 1e-9);
  EXPECT_LT(by_time.rotation.angularDistance(last.rotation), 1e-6);
}

TEST(Studio, CamerasAreTurnedBeforeTheRigIs) {
  // About X by 90 degrees: the camera looks to where the rig's right was, which is +Y after the U.
  SequenceInput input = AfterTheDrive();
  input.spec.cameras[1].value.rotation_xzy_deg = {90.0, 0.0, 0.0};
  const Studio studio(input, 1);
  EXPECT_LT((studio.ViewOf({0, 1, 0}).world_from_camera.Direction(Vec3d::UnitZ()) + Vec3d::UnitY())
                .norm(),
            1e-9);
  EXPECT_LT((studio.ViewOf({1, 1, 0}).world_from_camera.Direction(Vec3d::UnitZ()) - Vec3d::UnitY())
                .norm(),
            1e-9);
}

TEST(Studio, ViewsHaveTheLensTheImageAndTheSeed) {
  SequenceInput input = Room();
  input.spec.image.size_px = {32, 20};
  input.spec.render.seed = 77;
  const Studio studio(input, 1);
  const View view = studio.ViewOf({2, 0, 1});
  EXPECT_EQ(view.lens->ModelName(), "equisolid");
  EXPECT_EQ(view.lens, &studio.RasterOf({2, 0, 1}).OwnLens());
  EXPECT_EQ(studio.RasterOf({2, 0, 1}).WidthPx(), 32);
  EXPECT_EQ(studio.RasterOf({2, 0, 1}).HeightPx(), 20);
  EXPECT_EQ(view.width_px, 32);
  EXPECT_EQ(view.height_px, 20);
  EXPECT_EQ(view.seed, 77U);
  EXPECT_EQ(view.frame, 2U);
  EXPECT_EQ(view.exposure, nullptr);
}

TEST(Studio, ViewsHaveRandomNumbersOfTheirOwn) {
  SequenceInput input = Room();
  input.spec.cameras.push_back({"left", {}});
  input.spec.lenses.push_back({"c", LensSpec{.circle_px = 20.0}});
  const Studio studio(input, 1);
  std::set<uint64_t> keys;
  for (size_t camera_idx = 0; camera_idx < 3; ++camera_idx) {
    for (size_t lens_idx = 0; lens_idx < 3; ++lens_idx) {
      keys.insert(studio.ViewOf({0, camera_idx, lens_idx}).view_idx);
    }
  }
  EXPECT_EQ(keys.size(), 9U);
  // Those of the cameras and lenses that came before are what they were without the new ones.
  const SequenceInput before = Room();
  const Studio studio_before(before, 1);
  for (const Record& record : {Record{1, 0, 1}, Record{1, 1, 0}, Record{1, 1, 1}}) {
    EXPECT_EQ(studio.ViewOf(record).view_idx, studio_before.ViewOf(record).view_idx);
    EXPECT_EQ(studio.ViewOf(record).frame, studio_before.ViewOf(record).frame);
  }
}

TEST(Studio, CamerasMoveDuringTheExposure) {
  const SequenceInput input = Starting();
  const Studio studio(input, 1);
  const Record rear{1, 1, 0};
  for (const double after_s : {-0.5, 0.0, 0.5}) {
    // x = t^2; the rear camera is 2 m behind.
    const double time_s = 1.0 + after_s;
    const Vec3d expected_m(time_s * time_s - 2.0, 0.0, 1.5);
    EXPECT_LT((studio.WorldFromCamera(rear, after_s).translation_m - expected_m).norm(), 1e-6);
    EXPECT_LT((studio.WorldFromRig(time_s).translation_m - expected_m - Vec3d(2, 0, 0)).norm(),
              1e-6);
  }
  const RigidTransform at_once = studio.ViewOf(rear).world_from_camera;
  const RigidTransform after = studio.WorldFromCamera(rear, 0.0);
  EXPECT_LT((at_once.translation_m - after.translation_m).norm(), 1e-12);
  EXPECT_LT(at_once.rotation.angularDistance(after.rotation), 1e-9);
}

TEST(Studio, ExposuresAreThoseOfTheCamera) {
  SequenceInput input = Starting();
  input.spec.shutter = {.exposure_s = 0.4, .offset_s = 0.1};
  input.spec.cameras[1].value.rotation_xzy_deg = {90.0, 0.0, 0.0};
  const Studio studio(input, 1);
  const ExposurePoses exposure = studio.ExposureOf({1, 1, 0});
  EXPECT_FALSE(exposure.IsStill());
  EXPECT_EQ(exposure.OwnShutter().ExposureS(), 0.4);
  for (const double time_s : {-0.1, 0.1, 0.3}) {
    const ExposurePoses::Pose pose = exposure.At(time_s);
    const double x_m = (1.0 + time_s) * (1.0 + time_s) - 2.0;
    EXPECT_LT((pose.origin_m - Vec3f(static_cast<float>(x_m), 0.0F, 1.5F)).norm(), 1e-4F);
    EXPECT_LT((pose.world_from_camera.col(2) + Vec3f::UnitY()).norm(), 1e-6F);
  }
  // Before the start the rig rests; the shutter closes while it does.
  input.spec.trajectory.drive.stop_s = 2.0;
  EXPECT_TRUE(Studio(input, 1).ExposureOf({1, 1, 0}).IsStill());
  EXPECT_FALSE(Studio(input, 1).ExposureOf({2, 1, 0}).IsStill());
}

TEST(Studio, FilesAreNamedByLensCameraAndFrame) {
  const SequenceInput input = Room();
  const Studio studio(input, 1);
  EXPECT_EQ(studio.FileOf({2, 1, 0}, Output::kDistance).RelativePath(),
            "a/rear/distance/000002.exr");
  EXPECT_EQ(studio.FileOf({0, 0, 1}, Output::kClean).RelativePath(), "b/front/clean/000000.png");
}

TEST(Studio, OpticsAreThoseOfTheImageAndTheLens) {
  SequenceInput input = Room();
  input.spec.optics.image_width_px = 48;
  input.spec.optics.defocus_px = 3.0;
  const Studio studio(input, 1);
  // The image has 24 columns.
  EXPECT_DOUBLE_EQ(studio.OpticsOf({0, 0, 0}).Spec().defocus_px, 1.5);
  EXPECT_NE(&studio.OpticsOf({0, 0, 0}), &studio.OpticsOf({0, 0, 1}));
  EXPECT_EQ(&studio.OpticsOf({0, 0, 1}), &studio.OpticsOf({2, 1, 1}));
}

TEST(Studio, SamplesAreThoseOfTheDescription) {
  SequenceInput input = Room();
  input.spec.render.samples = 5;
  input.spec.render.max_samples = 50;
  input.spec.light.sky.model = "constant";
  input.spec.light.sky.radiance = {1.0, 2.0, 3.0};
  const PixelSampling sampling = Studio(input, 1).Sampling();
  EXPECT_EQ(sampling.num_samples, 5);
  EXPECT_EQ(sampling.max_samples, 50);
  EXPECT_GT(sampling.tolerance, 0.0F);
  // White paint in the open is as bright as the constant sky.
  const double white = 0.2126 * 1.0 + 0.7152 * 2.0 + 0.0722 * 3.0;
  EXPECT_NEAR(white / sampling.reference_radiance, 10.0 / std::numbers::pi, 0.02);
}

TEST(Studio, TellsWhatLightThereIs) {
  SequenceInput input = Room();
  EXPECT_TRUE(Studio(input, 1).UsesCachedLight());
  const Studio sunny(input, 1);
  ASSERT_NE(sunny.Sun(), nullptr);
  const double elevation_rad = RadFromDeg(input.spec.light.sun->elevation_deg);
  EXPECT_NEAR(sunny.Sun()->DirectionToSun().z(), std::sin(elevation_rad), 1e-6);
  input.spec.light.sun->strength = 0.0;
  input.spec.render.light = "path";
  const Studio dull(input, 1);
  EXPECT_EQ(dull.Sun(), nullptr);
  EXPECT_FALSE(dull.UsesCachedLight());
}

TEST(Studio, TakesTheLitSceneThatIsGiven) {
  SequenceInput input = Room();
  input.lit_scene = std::make_shared<LitScene>(input);
  input.spec.image.size_px = {16, 16};
  Studio studio(input, 1);
  EXPECT_EQ(&studio.Rays(), &input.lit_scene->Rays());
  EXPECT_EQ(&studio.Tracer(), &input.lit_scene->Tracer());
  studio.LoadLight({});
  EXPECT_EQ(&studio.Light(), &input.lit_scene->Stored({}));
  // But not that of another light.
  input.spec.light.sun->elevation_deg = 7.0;
  EXPECT_DEATH(Studio(input, 1), "another description");
}

}  // namespace
}  // namespace pfseq
