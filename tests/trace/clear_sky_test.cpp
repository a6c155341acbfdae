// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/clear_sky.h"

#include "renderer/core/units.h"
#include "tests/trace/directions.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

const Vec3d kSun = DirectionAt(40.0, 130.0);

TEST(ClearSky, ZenithHasTheLuminanceAndColourWorkedOutByHand) {
  // Turbidity 3, sun 50 degrees from the zenith: chi = (4/9 - 3/120) (pi - 2 * 0.872665) = 0.585655
  // rad, tan chi = 0.663281, Y = (12.1359 - 4.9710) 0.663281 - 0.6465 + 2.4192 = 6.52504 kcd/m^2; x
  // = 0.244412, y = 0.250521.
  const Rgb zenith = ClearSky(kSun, 3.0, 1.0).Radiance(Vec3d::UnitZ());
  EXPECT_NEAR(Luminance(zenith), 6.52504F, 3e-3F);
  // XYZ of x, y, Y to linear Rec. 709, by the matrix of IEC 61966-2-1.
  const double x_value = 0.244412 / 0.250521 * 6.52504;
  const double z_value = (1.0 - 0.244412 - 0.250521) / 0.250521 * 6.52504;
  EXPECT_NEAR(zenith[0], 3.2406 * x_value - 1.5372 * 6.52504 - 0.4986 * z_value, 0.01);
  EXPECT_NEAR(zenith[2], 0.0557 * x_value - 0.2040 * 6.52504 + 1.0570 * z_value, 0.01);
  EXPECT_GT(zenith[2], zenith[0]);
}

TEST(ClearSky, OtherDirectionsHaveTheLuminanceWorkedOutByHand) {
  // F(theta, gamma) / F(0, theta_sun) with A = -0.9269, B = -0.6387, C = 5.257, D = -2.2153, E =
  // 0.1693.
  const ClearSky sky(kSun, 3.0, 1.0);
  // At the horizon a quarter turn from the sun, gamma = 90 degrees; 45 degrees high opposite it,
  // gamma = 95 degrees.
  EXPECT_NEAR(Luminance(sky.Radiance(DirectionAt(1e-6, 220.0))), 8.1117F, 0.01F);
  EXPECT_NEAR(Luminance(sky.Radiance(DirectionAt(45.0, 310.0))), 4.9462F, 0.01F);
}

TEST(ClearSky, IsBrightestTowardTheSun) {
  const ClearSky sky(kSun, 3.0, 1.0);
  const float toward = Luminance(sky.Radiance(kSun));
  for (int elevation_deg = 0; elevation_deg <= 90; elevation_deg += 10) {
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 10) {
      EXPECT_LE(Luminance(sky.Radiance(DirectionAt(elevation_deg, azimuth_deg))), toward);
    }
  }
  EXPECT_FLOAT_EQ(Luminance(sky.Radiance(DirectionAt(30.0, 130.0 + 25.0))),
                  Luminance(sky.Radiance(DirectionAt(30.0, 130.0 - 25.0))));
}

TEST(ClearSky, IsFiniteAndNotNegativeForAllSunsAndTurbidities) {
  for (const double turbidity : {kMinTurbidity, 2.0, 5.0, kMaxTurbidity}) {
    for (const double sun_deg : {-90.0, -10.0, 0.0, 1.0, 30.0, 90.0}) {
      const ClearSky sky(DirectionAt(sun_deg, 10.0), turbidity, 1.0);
      for (int elevation_deg = 0; elevation_deg <= 90; elevation_deg += 5) {
        const Rgb radiance = sky.Radiance(DirectionAt(elevation_deg, 77.0));
        ASSERT_TRUE(radiance.isFinite().all() && radiance.minCoeff() >= 0.0F &&
                    Luminance(radiance) > 0.0F)
            << turbidity << " " << sun_deg << " " << elevation_deg;
      }
    }
  }
}

}  // namespace
}  // namespace pfseq
