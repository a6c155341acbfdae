// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/flare.h"

#include "renderer/lens/camera_rig.h"
#include "tests/film/small_lens.h"
#include "tests/support/driving.h"
#include "tests/support/simple_scenes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// The camera looks up; with identity rotation x and y are those of the world.
std::vector<SunImage> Seen(const RayScene& scene,
                           const SunDisc& sun,
                           const Lens& lens,
                           double rate_radps = 0.0) {
  const ExposurePoses poses(
      Shutter({.exposure_s = 0.1}), Driving(0.0, rate_radps), RigidTransform{}, 0.0);
  return SeenSun(scene, sun, lens, Vec2d::Constant(kSmallSizePx), poses);
}

SunDisc SunAt(const Vec3d& direction) {
  return {direction, Rgb(2.0F, 1.0F, 0.5F), RadFromDeg(2.0)};
}

/// Far below.
std::shared_ptr<const Scene> Nothing() { return BoxScene(Vec3f(-1, -1, -20), Vec3f(1, 1, -19)); }

TEST(SeenSun, HasThePlaceAndLightOfTheDisc) {
  const RayScene scene(Nothing());
  const Lens lens = SmallLens();
  const double theta_rad = 0.9;
  const SunDisc sun = SunAt({std::sin(theta_rad), 0.0, std::cos(theta_rad)});
  const std::vector<SunImage> seen = Seen(scene, sun, lens);
  ASSERT_EQ(seen.size(), 1U);
  const double focal_px = lens.FocalPx().x();
  EXPECT_NEAR((seen[0].place_px - kSmallMiddlePx - Vec2d(focal_px * theta_rad, 0)).norm(), 0, 1e-6);
  // An equidistant lens shows a solid angle on f^2 theta / sin(theta) times the area.
  const double area_px2 = focal_px * focal_px * theta_rad / std::sin(theta_rad);
  EXPECT_NEAR(seen[0].light[0] / (2.0 * area_px2), 1.0, 0.003);
  EXPECT_NEAR(seen[0].light[2] / (0.5 * area_px2), 1.0, 0.003);
}

TEST(SeenSun, FadesAsAnEdgeCoversTheDisc) {
  const Lens lens = SmallLens();
  // A wall that covers x < 0 above the camera, whose edge goes through the middle of the disc.
  const RayScene scene(BoxScene(Vec3f(-50, -50, 100), Vec3f(0, 50, 101)));
  const RayScene nothing(Nothing());
  const Vec3d zenith = Vec3d::UnitZ();
  const double half =
      Seen(scene, SunAt(zenith), lens)[0].light[1] / Seen(nothing, SunAt(zenith), lens)[0].light[1];
  EXPECT_NEAR(half, 0.5, 0.01);
  // Moved by half its radius, a disc shows 0.195501 or the rest.
  const double shift_rad = 0.5 * RadFromDeg(1.0);
  const double less =
      Seen(scene, SunAt(Vec3d(-std::sin(shift_rad), 0, std::cos(shift_rad))), lens)[0].light[1] /
      Seen(nothing, SunAt(zenith), lens)[0].light[1];
  EXPECT_NEAR(less, 0.1955, 0.01);
  EXPECT_TRUE(Seen(scene, SunAt(Vec3d(-0.2, 0, 1).normalized()), lens).empty());
  EXPECT_TRUE(Seen(nothing, SunAt(-Vec3d::UnitZ()), lens).empty());
}

TEST(SeenSun, MovesWithTheTurnOfTheCamera) {
  const RayScene scene(Nothing());
  const Lens lens = SmallLens();
  const SunDisc sun = SunAt(Vec3d(1, 0, 0.5).normalized());
  // 0.05 rad during the exposure, at 98.7 px from the middle: 4.9 px.
  const std::vector<SunImage> seen = Seen(scene, sun, lens, 0.5);
  ASSERT_EQ(seen.size(), 5U);
  double light = 0.0;
  for (const SunImage& image : seen) {
    light += image.light[1];
  }
  EXPECT_NEAR(light / Seen(scene, sun, lens)[0].light[1], 1.0, 0.005);
  // The rig turns to the left, so the image turns to the right: with y down, y falls.
  EXPECT_LT(seen.back().place_px.y(), seen.front().place_px.y() - 3.5);
}

/// The light that each channel gets, and its mean place.
struct Added {
  Eigen::Array3d light = Eigen::Array3d::Zero();
  Vec2d mean_px = Vec2d::Zero();
};
Added AddedBy(const OpticsSpec& spec, const SunImage& sun) {
  Image<float> image(kSmallSizePx, kSmallSizePx, 3);
  const Lens lens = SmallLens();
  Flare(spec, lens).Add({sun}, image, 2);
  Added added;
  for (int y = 0; y < kSmallSizePx; ++y) {
    for (int x = 0; x < kSmallSizePx; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        added.light[channel] += image.At(x, y, channel);
      }
      added.mean_px += image.At(x, y, 1) * Vec2d(x + 0.5, y + 0.5);
    }
  }
  added.mean_px /= added.light[1];
  return added;
}

TEST(Flare, GhostsLieOnTheAxisThroughTheMiddleAndHaveTheirLight) {
  const SunImage sun{Vec2d(220.0, 110.0), Rgb(1e6F, 2e6F, 4e6F)};
  for (const int blades : {0, 6, 7}) {
    for (const double position : {-0.8, 0.4}) {
      OpticsSpec spec;
      spec.aperture_blades = blades;
      spec.ghosts = {{"g",
                      {.position = position,
                       .radius_px = 14.0,
                       .strength = {1e-3, 2e-3, 1e-3},
                       .hollow = 0.4}}};
      const Added added = AddedBy(spec, sun);
      EXPECT_NEAR(added.light[0], 1e3, 15.0) << blades;
      EXPECT_NEAR(added.light[1], 4e3, 60.0) << blades;
      EXPECT_NEAR(added.light[2], 4e3, 60.0) << blades;
      const Vec2d expected_px = kSmallMiddlePx + position * Vec2d(70.0, -40.0);
      EXPECT_LT((added.mean_px - expected_px).norm(), 0.1) << blades << " " << position;
    }
  }
}

TEST(Flare, StarHasItsLightAndTwiceAnOddNumberOfBladesAsSpikes) {
  const SunImage sun{kSmallMiddlePx, Rgb(1e6F, 1e6F, 1e6F)};
  for (const auto& [blades, num_spikes] : {std::pair(6, 6), std::pair(5, 10)}) {
    OpticsSpec spec;
    spec.aperture_blades = blades;
    spec.aperture_rotation_deg = 20.0;
    spec.sun_star = {.strength = 0.01, .length_px = 15.0, .width_px = 1.0};
    const Added added = AddedBy(spec, sun);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(added.light[channel], 1e4, 200.0);
    }
    Image<float> image(kSmallSizePx, kSmallSizePx, 3);
    const Lens lens = SmallLens();
    Flare(spec, lens).Add({sun}, image, 1);
    // Around a circle, at the spikes and between them.
    for (int i = 0; i < 2 * num_spikes; ++i) {
      const double angle_rad = RadFromDeg(20.0) + std::numbers::pi * i / num_spikes;
      const Vec2d place_px =
          kSmallMiddlePx + 30.0 * Vec2d(std::cos(angle_rad), std::sin(angle_rad));
      const float value =
          image.At(static_cast<int>(place_px.x()), static_cast<int>(place_px.y()), 1);
      EXPECT_EQ(value > 1.0F, i % 2 == 0) << blades << " " << i << " " << value;
    }
  }
}

TEST(Flare, WithoutTheSunAddsNothing) {
  OpticsSpec spec;
  spec.sun_star.strength = 0.1;
  Image<float> image(8, 8, 3, 0.5F);
  Flare(spec, SmallLens()).Add({}, image, 1);
  EXPECT_EQ(image, Image<float>(8, 8, 3, 0.5F));
}

}  // namespace
}  // namespace pfseq
