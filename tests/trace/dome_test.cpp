// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/dome.h"

#include "tests/trace/directions.h"

#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(DomePoint, IsInvertedByDomeDirection) {
  for (int elevation_deg = 0; elevation_deg <= 90; elevation_deg += 3) {
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 7) {
      const Vec3d direction = DirectionAt(elevation_deg, azimuth_deg);
      const Vec2d point = DomePoint(direction);
      ASSERT_LE(point.lpNorm<Eigen::Infinity>(), 1.0 + 1e-12);
      ASSERT_LT((DomeDirection(point) - direction).norm(), 1e-12);
    }
  }
  EXPECT_LT(DomePoint(Vec3d(Vec3d::UnitZ())).norm(), 1e-12);
  EXPECT_LT((DomePoint(Vec3d(0.0, 1.0, 0.0)) - Vec2d(1.0, -1.0)).norm(), 1e-12);
}

TEST(DomeSolidAngle, IsTheAreaThatASmallSquareCovers) {
  for (const Vec2d& corner :
       {Vec2d(0.1, 0.2), Vec2d(0.5, 0.7), Vec2d(-0.9, 0.3), Vec2d(-0.4, -0.98)}) {
    constexpr double kStep = 1e-4;
    const Vec3d origin = DomeDirection(corner);
    const Vec3d along_u = DomeDirection(corner + Vec2d(kStep, 0.0)) - origin;
    const Vec3d along_v = DomeDirection(corner + Vec2d(0.0, kStep)) - origin;
    EXPECT_NEAR(along_u.cross(along_v).norm() / (kStep * kStep), DomeSolidAngle(origin), 2e-3);
  }
}

/// A different smooth function in each channel.
Rgb Waves(const Vec3d& direction) {
  return {static_cast<float>(2.0 + direction.x()),
          static_cast<float>(2.0 + direction.y() * direction.z()),
          static_cast<float>(1.0 + direction.z())};
}

TEST(DomeImage, GivesBackWhatItWasMadeOf) {
  const DomeImage image(513, Waves);
  for (int elevation_deg = 0; elevation_deg <= 90; ++elevation_deg) {
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 5) {
      const Vec3d direction = DirectionAt(elevation_deg, azimuth_deg + 0.3);
      ASSERT_LT((image.At(direction.cast<float>()) - Waves(direction)).abs().maxCoeff(), 1e-4F)
          << elevation_deg << " " << azimuth_deg;
    }
  }
}

TEST(DomeImage, HasTheCornersOfTheRimToo) {
  const DomeImage image(5, Waves);
  for (const Vec3d& direction :
       {Vec3d(1.0, 0.0, 0.0), Vec3d(0.0, -1.0, 0.0), Vec3d(-1.0, 0.0, 0.0)}) {
    EXPECT_LT((image.At(direction.cast<float>()) - Waves(direction)).abs().maxCoeff(), 1e-5F);
  }
}

TEST(DomeImage, HorizontalIrradianceIsThatOfTheClosedForm) {
  // The integral of cosine over the half sphere is pi, of cosine squared 2 pi / 3; x and y z
  // cancel.
  const Rgb irradiance = DomeImage(513, Waves).HorizontalIrradiance();
  EXPECT_NEAR(irradiance[0], 2.0 * kPi, 1e-4);
  EXPECT_NEAR(irradiance[1], 2.0 * kPi, 1e-4);
  EXPECT_NEAR(irradiance[2], kPi + 2.0 * kPi / 3.0, 1e-4);
}

TEST(RunningSum, GivesEachIntervalItsShareOfTheNumbers) {
  const RunningSum sum({1.0, 0.0, 5.0, 2.0});
  EXPECT_EQ(sum.Total(), 8.0);
  EXPECT_EQ(sum.Place(0.0), 0.0);
  EXPECT_NEAR(sum.Place(0.0625), 0.5, 1e-12);
  EXPECT_NEAR(sum.Place(0.125), 2.0, 1e-12);
  EXPECT_NEAR(sum.Place(0.125 + 0.625 * 0.3), 2.3, 1e-12);
  EXPECT_NEAR(sum.Place(0.875), 3.5, 1e-12);
  EXPECT_LT(sum.Place(1.0 - 0x1.0p-53), 4.0);
}

TEST(DomeSampler, TotalIsTheIntegralOfTheLuminance) {
  const DomeSampler sampler(
      DomeImage(257, [](const Vec3d& d) { return Rgb(Rgb::Constant(d.z())); }), 4);
  EXPECT_NEAR(sampler.Total(), kPi, 1e-3);
}

TEST(DomeSampler, DensityIntegratesToOneAndIsNeverZero) {
  // Light from one small place alone.
  const Vec3d bright = DirectionAt(30.0, 200.0);
  const DomeSampler sampler(
      DomeImage(257,
                [&](const Vec3d& direction) {
                  return Rgb(Rgb::Constant(direction.dot(bright) > 0.999 ? 9.0F : 0.0F));
                }),
      2);
  double least = 1.0;
  const double integral = IntegrateSphere([&](const Vec3d& direction) {
    const double pdf = direction.z() >= 0.0 ? sampler.Pdf(direction) : 0.0;
    least = direction.z() >= 0.0 ? std::min(least, pdf) : least;
    return pdf;
  });
  EXPECT_NEAR(integral, 1.0, 0.02);
  EXPECT_GT(least, 0.01 / (2.0 * kPi));
  int num_near = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3d sample = sampler.Sample({(i + 0.5) / 1000, std::fmod(i * 0.618034, 1.0)});
    ASSERT_GE(sample.z(), 0.0);
    num_near += sample.dot(bright) > 0.997 ? 1 : 0;
  }
  EXPECT_GT(num_near, 950);
}

}  // namespace
}  // namespace pfseq
