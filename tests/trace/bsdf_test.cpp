// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/bsdf.h"

#include "renderer/core/random.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3d FromAngles(double polar_rad, double azimuth_rad) {
  return {std::sin(polar_rad) * std::cos(azimuth_rad),
          std::sin(polar_rad) * std::sin(azimuth_rad),
          std::cos(polar_rad)};
}

struct Case {
  const char* name;
  BsdfParameters parameters;
};

std::vector<Case> Cases() {
  const Rgb white = Rgb::Ones();
  const Rgb brown(0.5F, 0.3F, 0.2F);
  return {{"lambertian", {white, 0.0F, 0.7F, 1.0F}},
          {"rough_white_dielectric", {white, 0.0F, 1.0F, 1.5F}},
          {"satin_white_dielectric", {white, 0.0F, 0.5F, 1.5F}},
          {"glossy_brown_dielectric", {brown, 0.0F, 0.3F, 1.5F}},
          {"rough_white_metal", {white, 1.0F, 0.8F, 1.5F}},
          {"satin_brown_metal", {brown, 1.0F, 0.4F, 1.5F}},
          {"half_metal", {brown, 0.5F, 0.45F, 1.4F}}};
}

class BsdfOf : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Materials,
                         BsdfOf,
                         testing::ValuesIn(Cases()),
                         [](const testing::TestParamInfo<Case>& param_info) {
                           return std::string(param_info.param.name);
                         });

TEST_P(BsdfOf, SamplesHaveTheStatedDensity) {
  // Chi-square test of 16 x 8 cells of equal solid angle; what falls below the surface has a cell
  // of its own.
  constexpr int kNumColumns = 16;
  constexpr int kNumRows = 8;
  constexpr int kNumSamples = 200000;
  constexpr int kNumSteps = 40;
  for (const double polar_rad : {0.2, 1.2}) {
    const Bsdf bsdf(GetParam().parameters, FromAngles(polar_rad, 0.7));
    std::vector<double> expected(kNumColumns * kNumRows, 0.0);
    double total = 0.0;
    for (int i = 0; i < kNumRows * kNumSteps; ++i) {
      for (int j = 0; j < kNumColumns * kNumSteps; ++j) {
        const double z = (i + 0.5) / (kNumRows * kNumSteps);
        const double azimuth_rad = 2.0 * kPi * (j + 0.5) / (kNumColumns * kNumSteps);
        const double probability = bsdf.Evaluate(FromAngles(std::acos(z), azimuth_rad)).pdf * 2.0 *
                                   kPi / (kNumRows * kNumSteps * kNumColumns * kNumSteps);
        expected[static_cast<size_t>(i / kNumSteps * kNumColumns + j / kNumSteps)] +=
            probability * kNumSamples;
        total += probability;
      }
    }
    EXPECT_LT(total, 1.0 + 2e-3);
    std::vector<double> observed(kNumColumns * kNumRows, 0.0);
    int num_below = 0;
    RandomStream random({17});
    for (int i = 0; i < kNumSamples; ++i) {
      const double lobe = random.Uniform();
      const double first = random.Uniform();
      const std::optional<BsdfSample> sample = bsdf.Sample(lobe, {first, random.Uniform()});
      if (!sample.has_value()) {
        ++num_below;
        continue;
      }
      const double turn = std::atan2(sample->to_light.y(), sample->to_light.x()) / (2.0 * kPi);
      const int column =
          std::min(static_cast<int>((turn - std::floor(turn)) * kNumColumns), kNumColumns - 1);
      const int row = std::min(static_cast<int>(sample->to_light.z() * kNumRows), kNumRows - 1);
      observed[static_cast<size_t>(row * kNumColumns + column)] += 1.0;
    }
    double chi_square = std::pow(num_below - (1.0 - total) * kNumSamples, 2) /
                        std::max(50.0, (1.0 - total) * kNumSamples);
    int num_cells = 0;
    for (size_t cell = 0; cell < expected.size(); ++cell) {
      if (expected[cell] >= 10.0) {
        chi_square += std::pow(observed[cell] - expected[cell], 2) / expected[cell];
        ++num_cells;
      }
    }
    // Mean n and standard deviation sqrt(2 n): five deviations are beyond chance.
    EXPECT_GE(num_cells, 20);
    EXPECT_LT(chi_square, num_cells + 5.0 * std::sqrt(2.0 * num_cells))
        << "polar angle " << polar_rad;
  }
}

TEST_P(BsdfOf, WeightIsValueOverDensity) {
  const Bsdf bsdf(GetParam().parameters, FromAngles(0.9, 2.0));
  RandomStream random({3});
  for (int i = 0; i < 1000; ++i) {
    const double lobe = random.Uniform();
    const double first = random.Uniform();
    const std::optional<BsdfSample> sample = bsdf.Sample(lobe, {first, random.Uniform()});
    if (sample.has_value()) {
      const BsdfValue value = bsdf.Evaluate(sample->to_light);
      EXPECT_NEAR(sample->pdf, value.pdf, 1e-9 * value.pdf);
      EXPECT_TRUE(
          sample->weight.isApprox(value.value_cosine / static_cast<float>(value.pdf), 1e-5F));
    }
  }
}

TEST_P(BsdfOf, IsReciprocal) {
  RandomStream random({5});
  for (int i = 0; i < 300; ++i) {
    const Vec3d first = FromAngles(random.Uniform(0.0, 1.5), random.Uniform(0.0, 6.0));
    const Vec3d second = FromAngles(random.Uniform(0.0, 1.5), random.Uniform(0.0, 6.0));
    const Rgb forward = Bsdf(GetParam().parameters, first).Evaluate(second).value_cosine /
                        static_cast<float>(second.z());
    const Rgb backward = Bsdf(GetParam().parameters, second).Evaluate(first).value_cosine /
                         static_cast<float>(first.z());
    EXPECT_TRUE(forward.isApprox(backward, 1e-4F)) << forward << " and " << backward;
  }
}

/// The light returned from a white surrounding.
Rgb Albedo(const BsdfParameters& parameters, double polar_rad) {
  const Bsdf bsdf(parameters, FromAngles(polar_rad, 0.3));
  constexpr int kNumSide = 300;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int i = 0; i < kNumSide; ++i) {
    for (int j = 0; j < kNumSide; ++j) {
      // The lobe's number from a third, golden-ratio dimension.
      const double lobe = std::fmod((i * kNumSide + j) * 0.6180339887498949, 1.0);
      const std::optional<BsdfSample> sample =
          bsdf.Sample(lobe, Vec2d(i + 0.5, j + 0.5) / kNumSide);
      if (sample.has_value()) {
        sum += sample->weight.cast<double>();
      }
    }
  }
  return (sum / (kNumSide * kNumSide)).cast<float>();
}

TEST_P(BsdfOf, ReturnsNoMoreLightThanItGets) {
  for (const double polar_rad : {0.0, 0.5, 1.0, 1.3, 1.5}) {
    EXPECT_LE(Albedo(GetParam().parameters, polar_rad).maxCoeff(), 1.005F) << polar_rad;
  }
}

TEST_P(BsdfOf, GivesNothingFromBelow) {
  const Bsdf bsdf(GetParam().parameters, FromAngles(0.4, 0.0));
  EXPECT_EQ(bsdf.Evaluate(FromAngles(1.6, 1.0)).value_cosine.maxCoeff(), 0.0F);
  EXPECT_EQ(bsdf.Evaluate(FromAngles(1.6, 1.0)).pdf, 0.0);
}

TEST_P(BsdfOf, DiffuseAndSpecularPartsAddUp) {
  RandomStream random({7});
  for (int i = 0; i < 300; ++i) {
    const Bsdf bsdf(GetParam().parameters,
                    FromAngles(random.Uniform(0.0, 1.5), random.Uniform(0.0, 6.0)));
    // Now and then from below.
    const Vec3d light = FromAngles(random.Uniform(0.0, 1.7), random.Uniform(0.0, 6.0));
    const Rgb diffuse = bsdf.EvaluateDiffuse(light);
    const BsdfValue specular = bsdf.EvaluateSpecular(light);
    const Rgb whole = bsdf.Evaluate(light).value_cosine;
    EXPECT_LE((diffuse + specular.value_cosine - whole).abs().maxCoeff(), 1e-5F * whole.maxCoeff());
    EXPECT_GE(diffuse.minCoeff(), 0.0F);
    EXPECT_GE(specular.value_cosine.minCoeff(), 0.0F);
    if (light.z() <= 0.0) {
      EXPECT_EQ(diffuse.maxCoeff(), 0.0F);
      EXPECT_EQ(specular.pdf, 0.0);
    }
  }
}

/// Integrals over the hemisphere of the two parts times a function that tells directions apart.
struct PartIntegrals {
  Eigen::Array3d diffuse = Eigen::Array3d::Zero();
  Eigen::Array3d specular = Eigen::Array3d::Zero();
  /// Of the specular part times 1 + x / 2.
  Eigen::Array3d slanted_specular = Eigen::Array3d::Zero();
  double specular_pdf = 0.0;
};

PartIntegrals IntegrateParts(const Bsdf& bsdf) {
  constexpr int kNumRows = 400;
  constexpr int kNumColumns = 400;
  PartIntegrals sums;
  const double solid_angle = 2.0 * kPi / (kNumRows * kNumColumns);
  for (int i = 0; i < kNumRows; ++i) {
    for (int j = 0; j < kNumColumns; ++j) {
      const double azimuth_rad = 2.0 * kPi * (j + 0.5) / kNumColumns;
      const Vec3d light = FromAngles(std::acos((i + 0.5) / kNumRows), azimuth_rad);
      const BsdfValue specular = bsdf.EvaluateSpecular(light);
      const Eigen::Array3d value = specular.value_cosine.cast<double>() * solid_angle;
      sums.diffuse += bsdf.EvaluateDiffuse(light).cast<double>() * solid_angle;
      sums.specular += value;
      sums.slanted_specular += value * (1.0 + 0.5 * light.x());
      sums.specular_pdf += specular.pdf * solid_angle;
    }
  }
  return sums;
}

TEST_P(BsdfOf, ReflectancesAreTheIntegralsOfTheParts) {
  for (const double polar_rad : {0.1, 0.7, 1.2, 1.45}) {
    const Bsdf bsdf(GetParam().parameters, FromAngles(polar_rad, 0.2));
    const PartIntegrals integrals = IntegrateParts(bsdf);
    // The albedo table is interpolated.
    const double tolerance = 0.01;
    EXPECT_LT((bsdf.DiffuseReflectance().cast<double>() - integrals.diffuse).abs().maxCoeff(),
              tolerance)
        << polar_rad;
    EXPECT_LT((bsdf.SpecularReflectance().cast<double>() - integrals.specular).abs().maxCoeff(),
              tolerance)
        << polar_rad << ": " << bsdf.SpecularReflectance().transpose() << " and "
        << integrals.specular.transpose();
  }
}

TEST_P(BsdfOf, SpecularSamplesGiveTheSpecularIntegral) {
  constexpr int kNumSide = 300;
  for (const double polar_rad : {0.3, 1.2}) {
    const Bsdf bsdf(GetParam().parameters, FromAngles(polar_rad, 0.0));
    const PartIntegrals integrals = IntegrateParts(bsdf);
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    Eigen::Array3d slanted_sum = Eigen::Array3d::Zero();
    int num_samples = 0;
    for (int i = 0; i < kNumSide; ++i) {
      for (int j = 0; j < kNumSide; ++j) {
        const std::optional<BsdfSample> sample =
            bsdf.SampleSpecular(Vec2d(i + 0.5, j + 0.5) / kNumSide);
        if (!sample.has_value()) {
          continue;
        }
        ++num_samples;
        sum += sample->weight.cast<double>();
        slanted_sum += sample->weight.cast<double>() * (1.0 + 0.5 * sample->to_light.x());
        const BsdfValue value = bsdf.EvaluateSpecular(sample->to_light);
        ASSERT_NEAR(sample->pdf, value.pdf, 1e-9 * value.pdf);
      }
    }
    constexpr double kNumSamples = double{kNumSide} * kNumSide;
    EXPECT_LT((sum / kNumSamples - integrals.specular).abs().maxCoeff(), 0.003) << polar_rad;
    EXPECT_LT((slanted_sum / kNumSamples - integrals.slanted_specular).abs().maxCoeff(), 0.003)
        << polar_rad;
    // What the density lacks to 1 are the directions below the surface.
    EXPECT_NEAR(num_samples / kNumSamples, integrals.specular_pdf, 0.003) << polar_rad;
  }
}

TEST(Bsdf, LambertianHasNoSpecularPart) {
  const Bsdf bsdf({Rgb::Ones(), 0.0F, 0.3F, 1.0F}, FromAngles(1.0, 0.0));
  EXPECT_FALSE(bsdf.SampleSpecular({0.3, 0.4}).has_value());
  EXPECT_EQ(bsdf.SpecularReflectance().maxCoeff(), 0.0F);
  EXPECT_NEAR(bsdf.DiffuseReflectance().minCoeff(), 1.0F, 1e-6F);
}

TEST(Bsdf, WhiteDielectricReturnsJustWhatItGets) {
  for (const float roughness : {0.1F, 0.3F, 0.6F, 1.0F}) {
    for (const double polar_rad : {0.0, 0.8, 1.2, 1.45}) {
      const float albedo = Albedo({Rgb::Ones(), 0.0F, roughness, 1.5F}, polar_rad).mean();
      EXPECT_NEAR(albedo, 1.0F, 0.005F) << roughness << " " << polar_rad;
    }
  }
}

TEST(Bsdf, LambertianIsBaseColourOverPi) {
  const Rgb base(0.9F, 0.5F, 0.1F);
  const Bsdf bsdf({base, 0.0F, 0.3F, 1.0F}, FromAngles(1.0, 0.0));
  const Vec3d light = FromAngles(0.6, 2.0);
  EXPECT_TRUE(bsdf.Evaluate(light).value_cosine.isApprox(base * static_cast<float>(light.z() / kPi),
                                                         1e-6F));
  EXPECT_NEAR(bsdf.Evaluate(light).pdf, light.z() / kPi, 1e-12);
}

TEST(Bsdf, MetalMatchesTheClosedFormAtRetroReflection) {
  // Viewer and light in one direction: the half vector is that direction, the Fresnel term its
  // value at normal incidence, the base colour.
  const Rgb base(0.9F, 0.6F, 0.3F);
  for (const double roughness : {0.3, 0.7, 1.0}) {
    for (const double polar_rad : {0.0, 0.6, 1.2}) {
      const Vec3d direction = FromAngles(polar_rad, 1.0);
      const double squared_alpha = std::pow(roughness, 4.0);
      const double squared_cosine = std::pow(std::cos(polar_rad), 2.0);
      const double d =
          squared_alpha / (kPi * std::pow(squared_cosine * (squared_alpha - 1.0) + 1.0, 2.0));
      // Heitz 2014, equation (99) with both Lambdas alike: G2 = 1 / (1 + 2 Lambda) = 1 / sqrt(1 +
      // alpha^2 tan^2).
      const double g2 = 1.0 / std::sqrt(1.0 + squared_alpha * std::pow(std::tan(polar_rad), 2.0));
      const double expected = d * g2 / (4.0 * std::cos(polar_rad));
      const Bsdf bsdf({base, 1.0F, static_cast<float>(roughness), 1.5F}, direction);
      EXPECT_TRUE(bsdf.Evaluate(direction).value_cosine.isApprox(
          base * static_cast<float>(expected), 1e-4F))
          << roughness << " " << polar_rad;
    }
  }
}

TEST(Bsdf, BlackDielectricReflectsFourPercentStraightOnAndAllAtGrazing) {
  const BsdfParameters black = {Rgb::Zero(), 0.0F, 0.05F, 1.5F};
  EXPECT_NEAR(Albedo(black, 0.0).mean(), 0.04F, 1e-4F);
  EXPECT_NEAR(
      Albedo(black, 1.0).mean(), 0.04F + 0.96F * std::pow(1.0F - std::cos(1.0F), 5.0F), 1e-3F);
  EXPECT_GT(Albedo(black, 1.56).mean(), 0.9F);
}

TEST(Bsdf, NarrowLobePointsTheMirrorsWay) {
  const Bsdf bsdf({Rgb::Ones(), 1.0F, 0.0F, 1.5F}, FromAngles(0.7, 0.4));
  const std::optional<BsdfSample> sample = bsdf.Sample(0.5, {0.3, 0.6});
  ASSERT_TRUE(sample.has_value());
  EXPECT_NEAR(sample->to_light.dot(FromAngles(0.7, 0.4 + kPi)), 1.0, 1e-4);
  EXPECT_NEAR(sample->weight.mean(), 1.0F, 1e-3F);
}

TEST(Bsdf, BlackSurfaceGivesNoSample) {
  EXPECT_FALSE(
      Bsdf({Rgb::Zero(), 0.0F, 0.5F, 1.0F}, Vec3d::UnitZ()).Sample(0.5, {0.5, 0.5}).has_value());
}

}  // namespace
}  // namespace pfseq
