// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/microfacet.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Vec3d FromAngles(double polar_rad, double azimuth_rad) {
  return {std::sin(polar_rad) * std::cos(azimuth_rad),
          std::sin(polar_rad) * std::sin(azimuth_rad),
          std::cos(polar_rad)};
}

/// Integral over the hemisphere by solid angle; the polar angle is stretched toward the pole, where
/// narrow lobes are.
template <typename Function>
double IntegrateHemisphere(const Function& function) {
  constexpr int kNumPolar = 4000;
  constexpr int kNumAzimuth = 256;
  double sum = 0.0;
  for (int i = 0; i < kNumPolar; ++i) {
    const double t = (i + 0.5) / kNumPolar;
    const double polar_rad = 0.5 * std::numbers::pi * t * t * t;
    const double width_rad = 0.5 * std::numbers::pi * 3.0 * t * t / kNumPolar;
    for (int j = 0; j < kNumAzimuth; ++j) {
      sum += function(FromAngles(polar_rad, 2.0 * std::numbers::pi * (j + 0.5) / kNumAzimuth)) *
             std::sin(polar_rad) * width_rad;
    }
  }
  return sum * 2.0 * std::numbers::pi / kNumAzimuth;
}

TEST(Ggx, ProjectedAreaOfTheFacetsIsOne) {
  for (const double alpha : {0.02, 0.1, 0.5, 1.0}) {
    const Ggx ggx(alpha);
    EXPECT_NEAR(
        IntegrateHemisphere([&](const Vec3d& h) { return ggx.Density(h) * h.z(); }), 1.0, 1e-3)
        << alpha;
  }
}

TEST(Ggx, VisibleFacetsFillTheViewersProjectedArea) {
  // Heitz 2014, equation (15): the integral of D G1 max(0, v.h) is v_z.
  for (const double alpha : {0.1, 0.5, 1.0}) {
    const Ggx ggx(alpha);
    for (const double polar_rad : {0.0, 0.7, 1.4}) {
      const Vec3d viewer = FromAngles(polar_rad, 0.3);
      const double area = IntegrateHemisphere([&](const Vec3d& h) {
        return ggx.Density(h) * std::max(0.0, viewer.dot(h)) / (1.0 + ggx.Lambda(viewer));
      });
      EXPECT_NEAR(area, viewer.z(), 2e-3) << alpha << " " << polar_rad;
    }
  }
}

TEST(Ggx, SampledNormalsHaveTheVisibleDistribution) {
  // Means of functions of the normal: by samples and by quadrature.
  for (const double alpha : {0.1, 0.5, 1.0}) {
    const Ggx ggx(alpha);
    const Vec3d viewer = FromAngles(1.2, 0.5);
    Vec3d sampled = Vec3d::Zero();
    double sampled_square = 0.0;
    constexpr int kNumSide = 400;
    for (int i = 0; i < kNumSide; ++i) {
      for (int j = 0; j < kNumSide; ++j) {
        const Vec3d h = ggx.SampleVisibleNormal(viewer, Vec2d(i + 0.5, j + 0.5) / kNumSide);
        EXPECT_NEAR(h.norm(), 1.0, 1e-12);
        EXPECT_GE(h.z(), 0.0);
        sampled += h;
        sampled_square += h.x() * h.x();
      }
    }
    const auto density = [&](const Vec3d& h) {
      return ggx.Density(h) * std::max(0.0, viewer.dot(h)) / (1.0 + ggx.Lambda(viewer)) /
             viewer.z();
    };
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(sampled[axis] / (kNumSide * kNumSide),
                  IntegrateHemisphere([&](const Vec3d& h) { return density(h) * h[axis]; }),
                  2e-3)
          << alpha << " axis " << axis;
    }
    EXPECT_NEAR(sampled_square / (kNumSide * kNumSide),
                IntegrateHemisphere([&](const Vec3d& h) { return density(h) * h.x() * h.x(); }),
                2e-3);
  }
}

TEST(Ggx, NarrowestLobeIsFinite) {
  const Ggx ggx(0.0);
  EXPECT_NEAR(ggx.Density(Vec3d::UnitZ()), 1.0 / (std::numbers::pi * kMinAlpha * kMinAlpha), 1.0);
  const Vec3d viewer = FromAngles(0.5 * std::numbers::pi - 1e-6, 1.0);
  EXPECT_TRUE(ggx.SampleVisibleNormal(viewer, {0.3, 0.999999}).allFinite());
}

TEST(SchlickWeight, IsOneAtGrazingAndZeroAtNormalIncidence) {
  EXPECT_EQ(SchlickWeight(0.0), 1.0);
  EXPECT_EQ(SchlickWeight(1.0), 0.0);
  EXPECT_DOUBLE_EQ(SchlickWeight(0.5), 1.0 / 32.0);
  EXPECT_EQ(SchlickWeight(1.0 + 1e-15), 0.0);
}

}  // namespace
}  // namespace pfseq
