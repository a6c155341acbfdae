// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/sky.h"

#include "renderer/core/units.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3d Direction(double elevation_deg, double azimuth_deg) {
  const double elevation_rad = RadFromDeg(elevation_deg);
  const double azimuth_rad = RadFromDeg(azimuth_deg);
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

const Vec3d kSun = Direction(40.0, 130.0);

TEST(ClearSky, ZenithHasTheLuminanceAndColourWorkedOutByHand) {
  // Turbidity 3, sun 50 degrees from the zenith: chi = (4/9 - 3/120) (pi - 2 * 0.872665) = 0.585655
  // rad, tan chi = 0.663281, Y = (12.1359 - 4.9710) 0.663281 - 0.6465 + 2.4192 = 6.52504 kcd/m^2; x
  // = 0.244412, y = 0.250521.
  const Rgb zenith = Sky::Clear(kSun, 3.0, 1.0).Radiance(Vec3d::UnitZ());
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
  const Sky sky = Sky::Clear(kSun, 3.0, 1.0);
  // At the horizon a quarter turn from the sun, gamma = 90 degrees; 45 degrees high opposite it,
  // gamma = 95 degrees.
  EXPECT_NEAR(Luminance(sky.Radiance(Direction(1e-6, 220.0))), 8.1117F, 0.01F);
  EXPECT_NEAR(Luminance(sky.Radiance(Direction(45.0, 310.0))), 4.9462F, 0.01F);
}

TEST(ClearSky, IsBrightestTowardTheSun) {
  const Sky sky = Sky::Clear(kSun, 3.0, 1.0);
  const float toward = Luminance(sky.Radiance(kSun));
  for (int elevation_deg = 0; elevation_deg <= 90; elevation_deg += 10) {
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 10) {
      EXPECT_LE(Luminance(sky.Radiance(Direction(elevation_deg, azimuth_deg))), toward);
    }
  }
  EXPECT_FLOAT_EQ(Luminance(sky.Radiance(Direction(30.0, 130.0 + 25.0))),
                  Luminance(sky.Radiance(Direction(30.0, 130.0 - 25.0))));
}

TEST(ClearSky, StrengthScalesAllOfIt) {
  const Sky one = Sky::Clear(kSun, 3.0, 1.0);
  const Sky half = Sky::Clear(kSun, 3.0, 0.5);
  for (const double elevation_deg : {-20.0, 10.0, 80.0}) {
    EXPECT_TRUE((half.Radiance(Direction(elevation_deg, 1.0)) * 2.0F)
                    .isApprox(one.Radiance(Direction(elevation_deg, 1.0)), 1e-5F));
  }
  EXPECT_FALSE(half.IsBlack());
  EXPECT_TRUE(Sky::Clear(kSun, 3.0, 0.0).IsBlack());
}

TEST(ClearSky, GroundIsAFifthOfTheSkysIrradiance) {
  const Sky sky = Sky::Clear(kSun, 3.0, 1.0);
  const Rgb expected = sky.HorizontalIrradiance() * static_cast<float>(0.2 / kPi);
  EXPECT_TRUE(sky.Radiance(Direction(-1e-3, 20.0)).isApprox(expected, 1e-5F));
  EXPECT_TRUE(sky.Radiance(-Vec3d::UnitZ()).isApprox(expected, 1e-5F));
}

TEST(ClearSky, IsFiniteAndNotNegativeForAllSunsAndTurbidities) {
  for (const double turbidity : {kMinTurbidity, 2.0, 5.0, kMaxTurbidity}) {
    for (const double sun_deg : {-90.0, -10.0, 0.0, 1.0, 30.0, 90.0}) {
      const Sky sky = Sky::Clear(Direction(sun_deg, 10.0), turbidity, 1.0);
      for (int elevation_deg = -90; elevation_deg <= 90; elevation_deg += 5) {
        const Rgb radiance = sky.Radiance(Direction(elevation_deg, 77.0));
        ASSERT_TRUE(radiance.isFinite().all() && radiance.minCoeff() >= 0.0F)
            << turbidity << " " << sun_deg;
        if (elevation_deg >= 0) {
          ASSERT_GT(Luminance(radiance), 0.0F)
              << turbidity << " " << sun_deg << " " << elevation_deg;
        }
      }
    }
  }
}

/// Sum of a function of direction over a fine grid of the sphere.
template <typename Function>
double IntegrateSphere(const Function& function) {
  constexpr int kNumRows = 640;
  constexpr int kNumColumns = 1280;
  double sum = 0.0;
  for (int i = 0; i < kNumRows; ++i) {
    for (int j = 0; j < kNumColumns; ++j) {
      const double z = 2.0 * (i + 0.5) / kNumRows - 1.0;
      const double azimuth_rad = 2.0 * kPi * (j + 0.5) / kNumColumns;
      const double radius = std::sqrt(1.0 - z * z);
      sum += function(Vec3d(radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), z));
    }
  }
  return sum * 4.0 * kPi / (kNumRows * kNumColumns);
}

TEST(SkySampling, DensityIntegratesToOne) {
  for (const Sky& sky :
       {Sky::Clear(kSun, 3.0, 1.0), Sky::Constant(Rgb::Ones()), Sky::Constant(Rgb::Zero())}) {
    EXPECT_NEAR(
        IntegrateSphere([&](const Vec3d& direction) { return sky.Pdf(direction); }), 1.0, 1e-9);
  }
}

TEST(SkySampling, SampleAgreesWithPdf) {
  const Sky sky = Sky::Clear(kSun, 2.2, 1.0);
  for (int i = 0; i < 50; ++i) {
    for (int j = 0; j < 50; ++j) {
      const Sky::DirectionSample sample =
          sky.SampleDirection(Vec2d((i + 0.37) / 50, (j + 0.61) / 50));
      ASSERT_NEAR(sample.direction.norm(), 1.0, 1e-12);
      ASSERT_NEAR(sample.pdf, sky.Pdf(sample.direction), 1e-9 * sample.pdf);
    }
  }
}

TEST(SkySampling, CornersOfTheSquareAreValid) {
  const Sky sky = Sky::Clear(kSun, 3.0, 1.0);
  for (const double x : {0.0, 1.0 - 0x1.0p-32}) {
    for (const double y : {0.0, 1.0 - 0x1.0p-32}) {
      const Sky::DirectionSample sample = sky.SampleDirection({x, y});
      EXPECT_TRUE(sample.direction.allFinite() && sample.pdf > 0.0);
    }
  }
}

TEST(SkySampling, EstimatorsMatchQuadrature) {
  const Sky sky = Sky::Clear(kSun, 3.0, 1.0);
  // Of horizontal irradiance, and of the irradiance on a wall that faces +X.
  constexpr int kNumSide = 512;
  double horizontal = 0.0;
  double wall = 0.0;
  for (int i = 0; i < kNumSide; ++i) {
    for (int j = 0; j < kNumSide; ++j) {
      const Sky::DirectionSample sample = sky.SampleDirection(Vec2d(i + 0.5, j + 0.5) / kNumSide);
      horizontal += Luminance(sky.Radiance(sample.direction)) *
                    std::max(0.0, sample.direction.z()) / sample.pdf;
      wall += Luminance(sky.Radiance(sample.direction)) * std::max(0.0, sample.direction.x()) /
              sample.pdf;
    }
  }
  horizontal /= kNumSide * kNumSide;
  wall /= kNumSide * kNumSide;
  const auto radiance = [&](const Vec3d& direction) {
    return static_cast<double>(Luminance(sky.Radiance(direction)));
  };
  EXPECT_NEAR(horizontal, Luminance(sky.HorizontalIrradiance()), 1e-3 * horizontal);
  EXPECT_NEAR(horizontal,
              IntegrateSphere([&](const Vec3d& d) { return radiance(d) * std::max(0.0, d.z()); }),
              1e-3 * horizontal);
  EXPECT_NEAR(wall,
              IntegrateSphere([&](const Vec3d& d) { return radiance(d) * std::max(0.0, d.x()); }),
              2e-3 * wall);
}

TEST(SkySampling, FollowsTheLuminance) {
  // Were the table turned or upside down, the weights would spread widely.
  const Sky sky = Sky::Clear(kSun, 3.0, 1.0);
  double sum = 0.0;
  double sum_of_squares = 0.0;
  constexpr int kNumSide = 100;
  for (int i = 0; i < kNumSide; ++i) {
    for (int j = 0; j < kNumSide; ++j) {
      const Sky::DirectionSample sample = sky.SampleDirection(Vec2d(i + 0.5, j + 0.5) / kNumSide);
      const double weight = Luminance(sky.Radiance(sample.direction)) / sample.pdf;
      sum += weight;
      sum_of_squares += weight * weight;
    }
  }
  const double mean = sum / (kNumSide * kNumSide);
  EXPECT_LT(std::sqrt(sum_of_squares / (kNumSide * kNumSide) - mean * mean) / mean, 0.05);
}

TEST(ConstantSky, IsTheSameEverywhere) {
  const Rgb radiance(0.5F, 1.0F, 2.0F);
  const Sky sky = Sky::Constant(radiance);
  for (const double elevation_deg : {-90.0, -3.0, 0.0, 45.0}) {
    EXPECT_TRUE((sky.Radiance(Direction(elevation_deg, 12.0)) == radiance).all());
  }
  EXPECT_NEAR(sky.Pdf(kSun), 1.0 / (4.0 * kPi), 1e-9);
  EXPECT_NEAR(sky.HorizontalIrradiance()[1], kPi, 1e-4);
  EXPECT_TRUE(Sky::Constant(Rgb::Zero()).IsBlack());
}

}  // namespace
}  // namespace pfseq
