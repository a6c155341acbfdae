// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/sky.h"

#include "renderer/trace/clouds.h"
#include "renderer/trace/sky_map.h"
#include "tests/trace/directions.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kPi = std::numbers::pi;

const Vec3d kSun = DirectionAt(40.0, 130.0);

/// A sky of each kind.
const std::vector<Sky>& AllSkies() {
  static const std::vector<Sky> skies = [] {
    const Sky clear = Sky::Clear(kSun, 3.0, 1.0);
    const Clouds clouds(0.5, 1, {kSun, Rgb::Constant(80.0F), Rgb::Constant(20.0F), 3.0});
    Image<float> map(64, 32, 3, 1.0F);
    for (int x = 0; x < 64; ++x) {
      map.At(x, x / 2, 1) = 0.3F * static_cast<float>(x);
    }
    return std::vector<Sky>{clear,
                            clear.With(clouds),
                            Sky::FromMap(SkyMap(map, 0.4), 2.0),
                            Sky::Constant(Rgb::Ones()),
                            Sky::Constant(Rgb::Zero())};
  }();
  return skies;
}

TEST(ClearSkyImage, IsWithinAFewInTenThousandOfTheFormula) {
  // But for the cusp of the formula at the sun's centre, which lies inside the disc.
  double worst = 0.0;
  for (const double turbidity : {kMinTurbidity, 3.0, kMaxTurbidity}) {
    for (const double sun_deg : {5.0, 40.0, 75.0}) {
      const Vec3d to_sun = DirectionAt(sun_deg, 130.0);
      const Sky sky = Sky::Clear(to_sun, turbidity, 1.0);
      const ClearSky formula(to_sun, turbidity, 1.0);
      for (double elevation_deg = 0.0; elevation_deg <= 90.0; elevation_deg += 0.37) {
        for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 2.9) {
          const Vec3d direction = DirectionAt(elevation_deg, azimuth_deg);
          if (direction.dot(to_sun) < std::cos(RadFromDeg(1.0))) {
            const Rgb expected = formula.Radiance(direction);
            const Rgb error = (sky.Radiance(direction) - expected).abs() / Luminance(expected);
            worst = std::max(worst, static_cast<double>(error.maxCoeff()));
          }
        }
      }
    }
  }
  RecordProperty("worst_relative_error", std::to_string(worst));
  EXPECT_LT(worst, 4e-4);
}

TEST(Sky, IsTheSameForSingleAndDoublePrecision) {
  for (const Sky& sky : AllSkies()) {
    for (int i = 0; i < 500; ++i) {
      const Vec3d direction = DirectionAt(-90.0 + 0.36 * i, 47.0 * i);
      const Rgb radiance = sky.Radiance(direction);
      ASSERT_TRUE((sky.Radiance(Vec3f(direction.cast<float>())) - radiance).abs().maxCoeff() <=
                  1e-4F * radiance.maxCoeff())
          << i;
    }
  }
}

TEST(ClearSky, StrengthScalesAllOfIt) {
  const Sky one = Sky::Clear(kSun, 3.0, 1.0);
  const Sky half = Sky::Clear(kSun, 3.0, 0.5);
  for (const double elevation_deg : {-20.0, 10.0, 80.0}) {
    EXPECT_TRUE((half.Radiance(DirectionAt(elevation_deg, 1.0)) * 2.0F)
                    .isApprox(one.Radiance(DirectionAt(elevation_deg, 1.0)), 1e-5F));
  }
  EXPECT_FALSE(half.IsBlack());
  EXPECT_TRUE(Sky::Clear(kSun, 3.0, 0.0).IsBlack());
}

TEST(ClearSky, GroundIsAFifthOfTheSkysIrradiance) {
  const Sky sky = Sky::Clear(kSun, 3.0, 1.0);
  const Rgb expected = sky.HorizontalIrradiance() * static_cast<float>(0.2 / kPi);
  EXPECT_TRUE(sky.Radiance(DirectionAt(-1e-3, 20.0)).isApprox(expected, 1e-5F));
  EXPECT_TRUE(sky.Radiance(-Vec3d::UnitZ()).isApprox(expected, 1e-5F));
}

TEST(SkySampling, DensityIntegratesToOneAndIsAboveZero) {
  for (const Sky& sky : AllSkies()) {
    double least = 1.0;
    const double integral = IntegrateSphere([&](const Vec3d& direction) {
      least = std::min(least, sky.Pdf(direction));
      return sky.Pdf(direction);
    });
    EXPECT_NEAR(integral, 1.0, 2e-3);
    EXPECT_GT(least, 1e-5);
  }
}

TEST(SkySampling, SampleAgreesWithPdf) {
  for (const Sky& sky : AllSkies()) {
    for (int i = 0; i < 50; ++i) {
      for (int j = 0; j < 50; ++j) {
        const Sky::DirectionSample sample =
            sky.SampleDirection(Vec2d((i + 0.37) / 50, (j + 0.61) / 50));
        ASSERT_NEAR(sample.direction.norm(), 1.0, 1e-12);
        ASSERT_NEAR(sample.pdf, sky.Pdf(sample.direction), 1e-9 * sample.pdf);
      }
    }
  }
}

TEST(SkySampling, CornersOfTheSquareAreValid) {
  for (const Sky& sky : AllSkies()) {
    for (const double x : {0.0, 1.0 - 0x1.0p-32}) {
      for (const double y : {0.0, 1.0 - 0x1.0p-32}) {
        const Sky::DirectionSample sample = sky.SampleDirection({x, y});
        EXPECT_TRUE(sample.direction.allFinite() && sample.pdf > 0.0);
      }
    }
  }
}

TEST(SkySampling, EstimatorsMatchQuadrature) {
  // Of horizontal irradiance, and of the irradiance on a wall that faces +X.
  int sky_idx = 0;
  for (const Sky& sky : AllSkies()) {
    constexpr int kNumSide = 512;
    double horizontal = 0.0;
    double wall = 0.0;
    for (int i = 0; i < kNumSide; ++i) {
      for (int j = 0; j < kNumSide; ++j) {
        const Sky::DirectionSample sample = sky.SampleDirection(Vec2d(i + 0.5, j + 0.5) / kNumSide);
        const double light = Luminance(sky.Radiance(sample.direction)) / sample.pdf;
        horizontal += light * std::max(0.0, sample.direction.z());
        wall += light * std::max(0.0, sample.direction.x());
      }
    }
    horizontal /= kNumSide * kNumSide;
    wall /= kNumSide * kNumSide;
    const auto radiance = [&](const Vec3d& direction) {
      return static_cast<double>(Luminance(sky.Radiance(direction)));
    };
    EXPECT_NEAR(horizontal, Luminance(sky.HorizontalIrradiance()), 1e-3 * horizontal) << sky_idx;
    EXPECT_NEAR(horizontal,
                IntegrateSphere([&](const Vec3d& d) { return radiance(d) * std::max(0.0, d.z()); }),
                1e-3 * horizontal)
        << sky_idx;
    EXPECT_NEAR(wall,
                IntegrateSphere([&](const Vec3d& d) { return radiance(d) * std::max(0.0, d.x()); }),
                4e-3 * wall)
        << sky_idx;
    ++sky_idx;
  }
}

/// Standard deviation of luminance over density, relative to its mean.
double SpreadOfWeights(const Sky& sky) {
  double sum = 0.0;
  double sum_of_squares = 0.0;
  constexpr int kNumSide = 200;
  for (int i = 0; i < kNumSide; ++i) {
    for (int j = 0; j < kNumSide; ++j) {
      const Sky::DirectionSample sample = sky.SampleDirection(Vec2d(i + 0.5, j + 0.5) / kNumSide);
      const double weight = Luminance(sky.Radiance(sample.direction)) / sample.pdf;
      sum += weight;
      sum_of_squares += weight * weight;
    }
  }
  const double mean = sum / (kNumSide * kNumSide);
  return std::sqrt(sum_of_squares / (kNumSide * kNumSide) - mean * mean) / mean;
}

TEST(SkySampling, FollowsTheLuminance) {
  // Were the table turned or upside down, the weights would spread widely.
  const std::vector<Sky>& skies = AllSkies();
  EXPECT_LT(SpreadOfWeights(skies[0]), 0.05);
  EXPECT_LT(SpreadOfWeights(skies[1]), 0.1);
  EXPECT_LT(SpreadOfWeights(skies[2]), 0.1);
}

TEST(CloudySky, GroundFollowsTheClouds) {
  const Sky& sky = AllSkies()[1];
  const Rgb expected = sky.HorizontalIrradiance() * static_cast<float>(0.2 / kPi);
  EXPECT_TRUE(sky.Radiance(DirectionAt(-30.0, 20.0)).isApprox(expected, 1e-5F));
  EXPECT_FALSE(sky.HorizontalIrradiance().isApprox(AllSkies()[0].HorizontalIrradiance(), 0.02F));
}

TEST(ConstantSky, IsTheSameEverywhere) {
  const Rgb radiance(0.5F, 1.0F, 2.0F);
  const Sky sky = Sky::Constant(radiance);
  for (const double elevation_deg : {-90.0, -3.0, 0.0, 45.0}) {
    EXPECT_TRUE((sky.Radiance(DirectionAt(elevation_deg, 12.0)) == radiance).all());
  }
  EXPECT_NEAR(sky.Pdf(kSun), 1.0 / (4.0 * kPi), 1e-9);
  EXPECT_NEAR(sky.HorizontalIrradiance()[1], kPi, 1e-4);
  EXPECT_TRUE(Sky::Constant(Rgb::Zero()).IsBlack());
}

}  // namespace
}  // namespace pfseq
