// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/specular_albedo.h"

#include "renderer/trace/microfacet.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

struct LobeIntegrals {
  SpecularAlbedo::Scales albedo;
  SpecularAlbedo::Scales forward;
};

/// By quadrature over the light's direction, independent of the sampling of normals.
LobeIntegrals ByQuadrature(double cosine, double roughness) {
  const Ggx ggx(roughness * roughness);
  const Vec3d viewer(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  constexpr int kNumSteps = 600;
  LobeIntegrals sum;
  for (int i = 0; i < kNumSteps; ++i) {
    const double z = (i + 0.5) / kNumSteps;
    const double radius = std::sqrt(1.0 - z * z);
    for (int j = 0; j < kNumSteps; ++j) {
      const double azimuth_rad = std::numbers::pi * (j + 0.5) / kNumSteps;
      const Vec3d light(radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), z);
      const Vec3d half = (viewer + light).normalized();
      const double value = ggx.Density(half) / (1.0 + ggx.Lambda(viewer) + ggx.Lambda(light)) /
                           (4.0 * cosine) * 2.0 * std::numbers::pi / (kNumSteps * kNumSteps);
      const double weight = std::pow(1.0 - viewer.dot(half), 5.0);
      sum.albedo.f0_scale += value * (1.0 - weight);
      sum.albedo.f90_scale += value * weight;
      sum.forward.f0_scale += value * (1.0 - weight) * -light.x();
      sum.forward.f90_scale += value * weight * -light.x();
    }
  }
  return sum;
}

TEST(SpecularAlbedo, MirrorReflectsByFresnelsTermAlone) {
  for (const double cosine : {0.1, 0.33, 0.7, 1.0}) {
    const SpecularAlbedo::Scales scales = SpecularAlbedo::Table().Directional(cosine, 0.0);
    EXPECT_NEAR(scales.f90_scale, std::pow(1.0 - cosine, 5.0), 1e-3);
    EXPECT_NEAR(scales.f0_scale + scales.f90_scale, 1.0, 1e-3);
  }
  // The mean of (1 - c)^5, weighted with 2 c, is 1 / 21.
  EXPECT_NEAR(SpecularAlbedo::Table().Mean(0.0).f90_scale, 1.0 / 21.0, 2e-4);
}

TEST(SpecularAlbedo, MatchesQuadratureOverTheLight) {
  for (const double roughness : {0.4, 0.55, 0.77, 1.0}) {
    for (const double cosine : {0.05, 0.21, 0.5, 0.93}) {
      const SpecularAlbedo::Scales scales = SpecularAlbedo::Table().Directional(cosine, roughness);
      const SpecularAlbedo::Scales expected = ByQuadrature(cosine, roughness).albedo;
      EXPECT_NEAR(scales.f0_scale, expected.f0_scale, 4e-3) << roughness << " " << cosine;
      EXPECT_NEAR(scales.f90_scale, expected.f90_scale, 1e-3) << roughness << " " << cosine;
    }
  }
}

TEST(SpecularAlbedo, LeansForwardAsQuadratureOverTheLightSays) {
  for (const float roughness : {0.4F, 0.55F, 0.77F, 1.0F}) {
    for (const float cosine : {0.05F, 0.21F, 0.5F, 0.93F}) {
      const SpecularAlbedo::Scales8 scales = SpecularAlbedo::Table().Forward(cosine, roughness);
      const SpecularAlbedo::Scales expected = ByQuadrature(cosine, roughness).forward;
      EXPECT_NEAR(scales.f0_scale.Values()[3], expected.f0_scale, 4e-3)
          << roughness << " " << cosine;
      EXPECT_NEAR(scales.f90_scale.Values()[3], expected.f90_scale, 1e-3)
          << roughness << " " << cosine;
    }
  }
}

}  // namespace
}  // namespace pfseq
