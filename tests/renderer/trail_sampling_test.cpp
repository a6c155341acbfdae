// SPDX-License-Identifier: Apache-2.0
#include "renderer/trail_sampling.h"

#include "tests/renderer/two_boxes.h"
#include "tests/support/driving.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kSizePx = 160;
constexpr double kFocalPx = 50.0;
constexpr double kExposureS = 0.1;

/// Nothing but sky.
struct Stage {
  explicit Stage(double rate_radps, const ShutterSpec& shutter = {.exposure_s = kExposureS})
      : two_boxes(Scene{}, ConstantSkyLight(Rgb::Ones())),
        lens(Equidistant{},
             Vec2d::Constant(kFocalPx),
             Vec2d::Constant(0.5 * kSizePx),
             RadFromDeg(85.0)),
        raster(lens, kSizePx, kSizePx, 2),
        exposure(Shutter(shutter), Driving(0.0, rate_radps), RigidTransform{}, 0.0),
        sampling(two_boxes.Rays(), raster, RigidTransform{}, exposure, 2) {}

  /// Where the picture of the middle of the exposure has what a sample shows.
  Vec2d MiddlePx(int x, int y, const Vec2f& place, double along) const {
    const ExposurePoses::Pose pose = sampling.PoseOf(x, y, place, {along, 0.5});
    const Vec3d direction = *lens.Unproject(Vec2d(x, y) + place.cast<double>());
    return *lens.Project(pose.world_from_camera.cast<double>() * direction);
  }

  /// Of a sample's camera against that of the middle.
  double TurnedRad(int x, int y, const Vec2f& place, double along) const {
    const ExposurePoses::Pose pose = sampling.PoseOf(x, y, place, {along, 0.5});
    return std::atan2(pose.world_from_camera(1, 0), pose.world_from_camera(0, 0));
  }

  TwoBoxesStage two_boxes;
  Lens lens;
  LensRaster raster;
  ExposurePoses exposure;
  TrailSampling sampling;
};

const std::vector<Vec2f> kPlaces = {{0.5F, 0.5F}, {0.1F, 0.9F}, {0.8F, 0.05F}, {0.3F, 0.99F}};

TEST(TrailSampling, SamplesShowThePlacesOfTheTrailThatTheyAreFor) {
  // 0.2 rad at some 50 px from the axis: 10 px, upward or downward in the image.
  const Stage stage(2.0);
  for (const int x : {130, 131, 29}) {
    for (const double along : {0.2, 0.5, 0.8}) {
      const double centre_px = stage.MiddlePx(x, 80, {0.5F, 0.5F}, along).y();
      EXPECT_NEAR(std::abs(centre_px - 80.5), std::abs(along - 0.5) * 10.1, 0.3);
      for (const Vec2f& place : kPlaces) {
        // The block's motion, not the pixel's, is what instants follow.
        EXPECT_NEAR(stage.MiddlePx(x, 80, place, along).y(), centre_px, 0.06);
      }
    }
  }
}

TEST(TrailSampling, EveryInstantIsAsLikelyAsAnyOtherAtEachPlace) {
  constexpr int kCount = 64;
  for (const double rate_radps : {0.05, 2.0}) {
    const Stage stage(rate_radps);
    for (const Vec2f& place : kPlaces) {
      std::vector<double> turned_rad;
      for (int i = 0; i < kCount; ++i) {
        turned_rad.push_back(stage.TurnedRad(130, 80, place, (i + 0.5) / kCount));
      }
      std::sort(turned_rad.begin(), turned_rad.end());
      const double step_rad = rate_radps * kExposureS / kCount;
      for (size_t i = 1; i < turned_rad.size(); ++i) {
        EXPECT_NEAR(turned_rad[i] - turned_rad[i - 1], step_rad, 1e-6);
      }
      EXPECT_GE(turned_rad.front(), -0.5 * rate_radps * kExposureS - 1e-6);
      EXPECT_LE(turned_rad.back(), 0.5 * rate_radps * kExposureS + 1e-6);
    }
  }
}

TEST(TrailSampling, FollowsTheShutter) {
  // Open twice as long at half its height, read from left to right.
  const Stage stage(2.0,
                    {.exposure_s = kExposureS, .ramp = 1.0, .readout_s = 0.05, .readout = "right"});
  const Vec2f middle(0.5F, 0.5F);
  EXPECT_NEAR(stage.TurnedRad(130, 80, middle, 0.5), 2.0 * 0.05 * (130.5 / kSizePx - 0.5), 1e-6);
  const Vec2d late = {0.5, 0.75};
  const ExposurePoses::Pose pose = stage.sampling.PoseOf(80, 80, middle, late);
  EXPECT_NEAR(std::asin(pose.world_from_camera(1, 0)),
              2.0 * (0.25 * kExposureS + 0.05 * (80.5 / kSizePx - 0.5)),
              1e-6);
}

}  // namespace
}  // namespace pfseq
