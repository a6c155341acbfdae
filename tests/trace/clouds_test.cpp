// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/clouds.h"

#include "tests/trace/directions.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

CloudLight Afternoon() {
  return {DirectionAt(40.0, 130.0), Rgb(82.0F, 79.0F, 66.0F), Rgb(22.0F, 28.0F, 36.0F), 3.0};
}

/// Share of the half sphere where less than half of the light passes.
double CoveredShare(const Clouds& clouds) {
  const double covered_sr = IntegrateSphere(
      [&](const Vec3d& direction) {
        return direction.z() > 0.0 && clouds.Transmittance(direction) < 0.5F ? 1.0 : 0.0;
      },
      300);
  return covered_sr / (2.0 * std::numbers::pi);
}

TEST(Clouds, CoverTheShareThatIsAskedFor) {
  double worst = 0.0;
  for (const double share : {0.05, 0.2, 0.5, 0.9, 1.0}) {
    for (const uint64_t seed : {1, 2, 3}) {
      const double covered = CoveredShare(Clouds(share, seed, Afternoon()));
      worst = std::max(worst, std::abs(covered - share));
      EXPECT_NEAR(covered, share, 0.02) << seed;
    }
  }
  RecordProperty("worst_error_of_share", std::to_string(worst));
}

TEST(Clouds, DependOnTheSeedAndNothingElse) {
  const Clouds one(0.5, 1, Afternoon());
  const Clouds same(0.5, 1, Afternoon());
  const Clouds other(0.5, 2, Afternoon());
  int num_different = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3d direction = DirectionAt(5.0 + 0.17 * i, 37.0 * i);
    const Clouds::Layer layer = one.Toward(direction, Rgb::Ones());
    ASSERT_TRUE((layer.radiance == same.Toward(direction, Rgb::Ones()).radiance).all());
    num_different +=
        std::abs(layer.transmittance - other.Toward(direction, Rgb::Ones()).transmittance) > 0.5F;
  }
  EXPECT_GT(num_different, 100);
}

TEST(Clouds, TowardAndTransmittanceAgree) {
  const Clouds clouds(0.5, 1, Afternoon());
  for (int i = 0; i < 500; ++i) {
    const Vec3d direction = DirectionAt(0.18 * i, 37.0 * i);
    // A ray ends where hardly anything passes.
    ASSERT_NEAR(clouds.Toward(direction, Rgb::Ones()).transmittance,
                clouds.Transmittance(direction),
                0.01F);
  }
}

/// Luminances of what is opaque above 20 degrees, sorted.
std::vector<float> LuminancesOfClouds(const Clouds& clouds, double least_deg, double most_deg) {
  std::vector<float> luminances;
  const Vec3d to_sun = Afternoon().direction_to_sun;
  for (int i = 0; i < 40000; ++i) {
    const Vec3d direction = DirectionAt(20.0 + 0.0017 * i, 137.50776 * i);
    const double angle_deg = DegFromRad(std::acos(direction.dot(to_sun)));
    if (angle_deg < least_deg || angle_deg > most_deg) {
      continue;
    }
    const Clouds::Layer layer = clouds.Toward(direction, Rgb::Constant(6.0F));
    if (layer.transmittance < 0.05F) {
      luminances.push_back(Luminance(layer.radiance));
    }
  }
  std::sort(luminances.begin(), luminances.end());
  return luminances;
}

TEST(Clouds, HaveTheLuminancesOfCumulus) {
  // Sunlit sides 10 to 30 kcd/m^2, grey bases of less than half of that.
  std::vector<float> luminances = LuminancesOfClouds(Clouds(0.5, 1, Afternoon()), 60.0, 180.0);
  ASSERT_GT(luminances.size(), 1000U);
  const float bright = luminances[luminances.size() * 95 / 100];
  const float dark = luminances[luminances.size() * 5 / 100];
  EXPECT_GT(bright, 15.0F);
  EXPECT_LT(bright, 30.0F);
  EXPECT_GT(dark, 4.0F);
  EXPECT_LT(dark, 12.0F);
}

TEST(Clouds, ThinPartsShineNearTheSun) {
  const Clouds clouds(0.5, 1, Afternoon());
  const Vec3d to_sun = Afternoon().direction_to_sun;
  float near = 0.0F;
  float far = 0.0F;
  for (int i = 0; i < 40000; ++i) {
    const Vec3d direction = DirectionAt(10.0 + 0.002 * i, 137.50776 * i);
    const Clouds::Layer layer = clouds.Toward(direction, Rgb::Constant(6.0F));
    if (layer.transmittance > 0.2F && layer.transmittance < 0.9F) {
      const float brightness = Luminance(layer.radiance) / (1.0F - layer.transmittance);
      float& most = direction.dot(to_sun) > 0.985 ? near : far;
      if (&most == &near || direction.dot(to_sun) < 0.7) {
        most = std::max(most, brightness);
      }
    }
  }
  EXPECT_GT(near, 80.0F);
  EXPECT_LT(far, 40.0F);
}

TEST(Clouds, AreSmallerTowardTheHorizon) {
  // Crossings of a cloud's edge on a circle at two elevations, for each degree of the way.
  const Clouds clouds(0.5, 1, Afternoon());
  const auto crossings_a_degree = [&](double elevation_deg) {
    int num_crossings = 0;
    bool was_covered = false;
    for (int i = 0; i <= 7200; ++i) {
      const bool is_covered = clouds.Transmittance(DirectionAt(elevation_deg, 0.05 * i)) < 0.5F;
      num_crossings += i > 0 && is_covered != was_covered ? 1 : 0;
      was_covered = is_covered;
    }
    return num_crossings / (360.0 * std::cos(RadFromDeg(elevation_deg)));
  };
  EXPECT_GT(crossings_a_degree(10.0), 2.0 * crossings_a_degree(50.0));
}

TEST(Clouds, FadeIntoTheSkyAtTheHorizon) {
  const Clouds clouds(1.0, 1, Afternoon());
  const Rgb sky(3.0F, 5.0F, 7.0F);
  const Clouds::Layer layer = clouds.Toward(DirectionAt(0.2, 50.0), sky);
  const Rgb seen = layer.radiance + layer.transmittance * sky;
  EXPECT_TRUE(seen.isApprox(sky, 0.1F)) << seen.transpose();
  const Clouds::Layer above = clouds.Toward(DirectionAt(70.0, 50.0), sky);
  EXPECT_FALSE(Rgb(above.radiance + above.transmittance * sky).isApprox(sky, 0.1F));
}

TEST(Clouds, BrightnessIsProportionalToTheLight) {
  CloudLight twice = Afternoon();
  twice.sun_irradiance *= 2.0F;
  twice.sky_irradiance *= 2.0F;
  const Clouds clouds(0.6, 4, Afternoon());
  const Clouds brighter(0.6, 4, twice);
  for (int i = 0; i < 200; ++i) {
    const Vec3d direction = DirectionAt(5.0 + 0.4 * i, 37.0 * i);
    const Clouds::Layer layer = clouds.Toward(direction, Rgb::Ones());
    const Clouds::Layer other = brighter.Toward(direction, 2.0F * Rgb::Ones());
    ASSERT_EQ(layer.transmittance, other.transmittance);
    ASSERT_TRUE(other.radiance.isApprox(2.0F * layer.radiance, 1e-4F));
  }
}

TEST(Clouds, SunTransmittanceIsTheMeanOverTheDisc) {
  // With a sun as wide as a fifth of the sky the mean is that of a fine grid over it.
  const Clouds clouds(0.5, 2, Afternoon());
  const Vec3d to_sun = Afternoon().direction_to_sun;
  const double radius_rad = RadFromDeg(4.0);
  double sum = 0.0;
  double weight = 0.0;
  IntegrateSphere(
      [&](const Vec3d& direction) {
        if (direction.dot(to_sun) > std::cos(radius_rad)) {
          sum += clouds.Transmittance(direction);
          weight += 1.0;
        }
        return 0.0;
      },
      500);
  ASSERT_GT(weight, 500.0);
  EXPECT_NEAR(clouds.SunTransmittance(2.0 * radius_rad), sum / weight, 0.05);
  EXPECT_LT(Clouds(1.0, 2, Afternoon()).SunTransmittance(RadFromDeg(0.53)), 0.05F);
}

}  // namespace
}  // namespace pfseq
