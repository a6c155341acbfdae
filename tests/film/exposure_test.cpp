// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/exposure.h"

#include "renderer/sequence/sequence_spec.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

LightSpec SunAt(double elevation_deg) {
  LightSpec light;
  light.sun = SunSpec{.elevation_deg = elevation_deg};
  return light;
}

double ExposureOf(const LightSpec& light) {
  return AutoExposure(MakeLighting(light, std::nullopt));
}

TEST(AutoExposure, IsCalibratedWithTheDefaultLight) { EXPECT_EQ(ExposureOf(SunAt(40.0)), 0.06); }

TEST(AutoExposure, FallsWithTheRootOfTheIlluminanceOfSunAndSky) {
  // An even sky of radiance L gives pi L; a sun overhead adds all of its irradiance, one at 30
  // degrees half of it.
  const auto lighting = [](float sky, float sun, double sin_elevation) {
    Lighting made{std::nullopt, Sky::Constant(Rgb::Constant(sky))};
    if (sun > 0.0F) {
      made.sun.emplace(Vec3d(std::sqrt(1.0 - sin_elevation * sin_elevation), 0.0, sin_elevation),
                       Rgb::Constant(sun),
                       0.01);
    }
    return made;
  };
  const auto expected = [](double illuminance_klx) {
    return 0.06 * std::sqrt(79.0 / illuminance_klx);
  };
  const double sky = 2.0 * std::numbers::pi;
  EXPECT_NEAR(AutoExposure(lighting(2.0F, 0.0F, 1.0)) / expected(sky), 1.0, 5e-3);
  EXPECT_NEAR(AutoExposure(lighting(2.0F, 50.0F, 1.0)) / expected(sky + 50.0), 1.0, 5e-3);
  EXPECT_NEAR(AutoExposure(lighting(2.0F, 50.0F, 0.5)) / expected(sky + 25.0), 1.0, 5e-3);
}

TEST(AutoExposure, HasThreeDigits) {
  for (const double elevation_deg : {5.0, 17.0, 62.0}) {
    const double exposure = ExposureOf(SunAt(elevation_deg));
    ASSERT_GT(exposure, 0.01);
    ASSERT_LT(exposure, 1.0);
    EXPECT_NEAR(exposure * 1e4, std::round(exposure * 1e4), 1e-9);
  }
}

TEST(AutoExposure, GrowsTowardTheEveningAndWithAClosedSky) {
  double before = 0.0;
  for (const double elevation_deg : {70.0, 50.0, 30.0, 15.0, 5.0}) {
    const double exposure = ExposureOf(SunAt(elevation_deg));
    EXPECT_GT(exposure, before) << elevation_deg;
    before = exposure;
  }
  LightSpec overcast = SunAt(40.0);
  overcast.sky.clouds.share = 1.0;
  EXPECT_GT(ExposureOf(overcast), 0.07);
}

TEST(AutoExposure, WithoutLightIsThatOfTheDefault) {
  const Lighting dark{std::nullopt, Sky::Constant(Rgb::Zero())};
  EXPECT_EQ(AutoExposure(dark), 0.06);
}

}  // namespace
}  // namespace pfseq
