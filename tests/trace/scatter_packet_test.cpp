// SPDX-License-Identifier: Apache-2.0
// Eight lanes in single precision against the scattering model in double.
#include "renderer/trace/scatter_packet.h"

#include "renderer/core/random.h"
#include "renderer/trace/material.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr uint32_t kActive = 0b11011111;

Vec3d RandomDirection(RandomStream& random) {
  Vec3d direction;
  do {
    const double x = 2.0 * random.Uniform() - 1.0;
    const double y = 2.0 * random.Uniform() - 1.0;
    direction = {x, y, 2.0 * random.Uniform() - 1.0};
  } while (direction.norm() < 0.1);
  return direction.normalized();
}

/// One not less than this above the plane of the normal.
Vec3d RandomDirectionAbove(const Vec3d& normal, double cosine, RandomStream& random) {
  for (;;) {
    const Vec3d direction = RandomDirection(random);
    if (direction.dot(normal) > cosine) {
      return direction;
    }
  }
}

/// Eight random surfaces seen from random sides; lane 5 is not active, lanes 0 and 1 are
/// Lambertian and a metal.
struct RandomPacket {
  explicit RandomPacket(uint64_t seed) {
    RandomStream random(seed);
    rays.active = kActive;
    for (int i = 0; i < kPacketSize; ++i) {
      ShadingPoint& point = points[static_cast<size_t>(i)];
      const Vec3d normal = RandomDirection(random);
      point.normal = normal.cast<float>();
      point.geometric_normal = point.normal;
      point.position_m = Vec3f(1.0F, -200.0F, 30.0F) * static_cast<float>(random.Uniform());
      point.emission = Rgb::Constant(static_cast<float>(i));
      point.parameters.base_color = Rgb(0.9F, 0.5F, 0.2F) * static_cast<float>(random.Uniform());
      point.parameters.roughness = static_cast<float>(random.Uniform());
      point.parameters.metallic = i == 1 ? 1.0F : 0.3F * static_cast<float>(random.Uniform());
      if (i == 0) {
        point.parameters.metallic = 0.0F;
        point.parameters.ior = 1.0F;
      }
      const Vec3d to_viewer = RandomDirectionAbove(normal, 0.05, random);
      rays.Set(i, point.position_m, Vec3f(-to_viewer.cast<float>()));
    }
    rays.active = kActive;
  }

  ScatterPacket Scatter() const { return {points, kActive, rays}; }

  Vec3d Normal(size_t lane) const { return points[lane].normal.cast<double>().normalized(); }
  /// The same in double.
  Bsdf BsdfOf(size_t lane) const {
    const ShadingFrame frame(Normal(lane));
    return {points[lane].parameters,
            frame.ToLocal(-rays.Direction(static_cast<int>(lane)).cast<double>().normalized())};
  }

  std::array<ShadingPoint, kPacketSize> points;
  RayPacket rays;
};

void ExpectNear(const Rgb& value, const Rgb& expected, float tolerance) {
  EXPECT_LE((value - expected).abs().maxCoeff(), tolerance * std::max(1.0F, expected.maxCoeff()))
      << value.transpose() << " instead of " << expected.transpose();
}

class ScatterPacketOf : public testing::TestWithParam<uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, ScatterPacketOf, testing::Range<uint64_t>(0, 20));

TEST_P(ScatterPacketOf, ReflectancesAreTheModels) {
  const RandomPacket packet(GetParam());
  const ScatterPacket scatter = packet.Scatter();
  const std::array<Rgb, kPacketSize> diffuse = Transposed(scatter.DiffuseReflectance());
  const std::array<Rgb, kPacketSize> specular = Transposed(scatter.SpecularReflectance());
  const std::array<Rgb, kPacketSize> emission = Transposed(scatter.emission);
  for (const size_t lane : {0U, 1U, 2U, 3U, 4U, 6U, 7U}) {
    const Bsdf bsdf = packet.BsdfOf(lane);
    ExpectNear(diffuse[lane], bsdf.DiffuseReflectance(), 1e-5F);
    ExpectNear(specular[lane], bsdf.SpecularReflectance(), 1e-5F);
    EXPECT_EQ(emission[lane][0], static_cast<float>(lane));
  }
  EXPECT_EQ(scatter.is_specular.Bits() & kActive, kActive & ~1U);
}

TEST_P(ScatterPacketOf, ValuesAreTheModels) {
  const RandomPacket packet(GetParam());
  const ScatterPacket scatter = packet.Scatter();
  RandomStream random(GetParam() + 1000);
  for (int i = 0; i < 20; ++i) {
    const Vec3d to_light = RandomDirection(random);
    const Vec3x8 to_light8 = Broadcast(Vec3f(to_light.cast<float>()));
    const std::array<Rgb, kPacketSize> diffuse = Transposed(scatter.EvaluateDiffuse(to_light8));
    const ScatterPacket::Specular specular = scatter.EvaluateSpecular(to_light8);
    const std::array<Rgb, kPacketSize> values = Transposed(specular.value_cosine);
    for (const size_t lane : {0U, 1U, 2U, 3U, 4U, 6U, 7U}) {
      const Bsdf bsdf = packet.BsdfOf(lane);
      const Vec3d local = ShadingFrame(packet.Normal(lane)).ToLocal(to_light);
      ExpectNear(diffuse[lane], bsdf.EvaluateDiffuse(local), 1e-5F);
      const BsdfValue expected = bsdf.EvaluateSpecular(local);
      ExpectNear(values[lane], expected.value_cosine, 2e-4F);
      EXPECT_NEAR(specular.pdf.Values()[lane], expected.pdf, 2e-4 * std::max(1.0, expected.pdf));
    }
  }
}

TEST_P(ScatterPacketOf, SamplesAreTheModels) {
  const RandomPacket packet(GetParam());
  const ScatterPacket scatter = packet.Scatter();
  RandomStream random(GetParam() + 2000);
  for (int i = 0; i < 20; ++i) {
    const double first = static_cast<float>(random.Uniform());
    const double second = static_cast<float>(random.Uniform());
    const ScatterPacket::SpecularSample sample =
        scatter.SampleSpecular(static_cast<float>(first), static_cast<float>(second));
    const std::array<Rgb, kPacketSize> weights = Transposed(sample.weight);
    EXPECT_EQ(sample.is_valid.Bits() & 1U, 0U) << "a Lambertian surface has no lobe";
    for (const size_t lane : {1U, 2U, 3U, 4U, 6U, 7U}) {
      const std::optional<BsdfSample> expected =
          packet.BsdfOf(lane).SampleSpecular({first, second});
      const bool is_valid = (sample.is_valid.Bits() >> lane & 1U) != 0;
      const Vec3f to_light(sample.to_light.x.Values()[lane],
                           sample.to_light.y.Values()[lane],
                           sample.to_light.z.Values()[lane]);
      if (!expected.has_value() || !is_valid) {
        // Both agree but where the direction grazes the surface.
        EXPECT_TRUE(expected.has_value() == is_valid ||
                    std::abs(to_light.dot(packet.points[lane].normal)) < 1e-4F);
        continue;
      }
      const Vec3d world = ShadingFrame(packet.Normal(lane)).ToWorld(expected->to_light);
      EXPECT_LT((to_light.cast<double>() - world).norm(), 1e-4);
      ExpectNear(weights[lane], expected->weight, 1e-3F);
      EXPECT_NEAR(sample.pdf.Values()[lane] / expected->pdf, 1.0, 0.01);
    }
  }
}

TEST_P(ScatterPacketOf, RaysStartWhereTheSingleOnesDo) {
  const RandomPacket packet(GetParam());
  const Vec3x8 origins_m = packet.Scatter().RayOriginM();
  for (const size_t lane : {0U, 1U, 2U, 3U, 4U, 6U, 7U}) {
    const Vec3f origin_m(
        origins_m.x.Values()[lane], origins_m.y.Values()[lane], origins_m.z.Values()[lane]);
    EXPECT_EQ(origin_m, packet.points[lane].RayOriginM());
  }
}

/// The mean cosine to a light that stands `cosine` above the mean normal.
float MeanCosineAt(double cosine, float normal_length) {
  std::array<ShadingPoint, kPacketSize> points;
  points[0].normal = points[0].geometric_normal = Vec3f::UnitZ();
  points[0].normal_length = normal_length;
  RayPacket rays;
  rays.Set(0, Vec3f::Zero(), -Vec3f::UnitZ());
  rays.active = 1;
  const Vec3f to_light =
      Vec3d(std::sqrt(1.0 - cosine * cosine), 0.0, cosine).cast<float>().normalized();
  return ScatterPacket(points, 1, rays).MeanCosine(Broadcast(to_light)).Values()[0];
}

TEST(ScatterPacket, OneNormalHasItsOwnCosine) {
  for (const double cosine : {-0.7, -0.01, 0.0, 0.01, 0.4, 1.0}) {
    EXPECT_NEAR(MeanCosineAt(cosine, 1.0F), std::max(0.0, cosine), 1e-6) << cosine;
  }
}

TEST(ScatterPacket, NormalsThatSpreadAreLitInPart) {
  // Normals spread over a spherical cap: by height above the mean normal's horizon all are equally
  // likely, from 1 down to `least`.
  for (const double least : {0.9, 0.7}) {
    const auto mean_length = static_cast<float>(0.5 * (1.0 + least));
    for (const double cosine : {-0.6, -0.1, 0.0, 0.1, 0.3, 0.6, 1.0}) {
      const double sine = std::sqrt(1.0 - cosine * cosine);
      constexpr int kSteps = 400;
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double z = least + (1.0 - least) * (i + 0.5) / kSteps;
        for (int k = 0; k < kSteps; ++k) {
          const double azimuth_rad = 2.0 * std::numbers::pi * (k + 0.5) / kSteps;
          const double x = std::sqrt(1.0 - z * z) * std::cos(azimuth_rad);
          sum += std::max(0.0, sine * x + cosine * z);
        }
      }
      const double expected = sum / (kSteps * kSteps);
      EXPECT_NEAR(MeanCosineAt(cosine, mean_length), expected, 0.012) << least << ' ' << cosine;
    }
  }
}

TEST(ScatterPacket, TheDiffuseLobeTakesTheMeanCosine) {
  std::array<ShadingPoint, kPacketSize> points;
  points[0].normal = points[0].geometric_normal = Vec3f::UnitZ();
  points[0].normal_length = 0.95F;
  points[0].parameters = {Rgb::Constant(0.5F), 0.0F, 1.0F, 1.0F};
  RayPacket rays;
  rays.Set(0, Vec3f::Zero(), -Vec3f::UnitZ());
  rays.active = 1;
  const ScatterPacket surface(points, 1, rays);
  const Vec3x8 grazing = Broadcast(Vec3f(1.0F, 0.0F, 0.0F));
  const float mean = surface.MeanCosine(grazing).Values()[0];
  EXPECT_GT(mean, 0.05F);
  EXPECT_NEAR(surface.EvaluateDiffuse(grazing).r.Values()[0],
              0.5F * std::numbers::inv_pi_v<float> * mean,
              1e-6F);
}

/// One rough dielectric whose normals' mean is z, seen from -x at this cosine.
ScatterPacket RoughSurface(float roughness, float normal_length, float viewer_cosine) {
  std::array<ShadingPoint, kPacketSize> points;
  points[0].normal = points[0].geometric_normal = Vec3f::UnitZ();
  points[0].normal_length = normal_length;
  points[0].parameters = {Rgb::Constant(0.5F), 0.0F, roughness, 1.5F};
  RayPacket rays;
  rays.Set(
      0, Vec3f::Zero(), {std::sqrt(1.0F - viewer_cosine * viewer_cosine), 0.0F, -viewer_cosine});
  rays.active = 1;
  return {points, 1, rays};
}

TEST(ScatterPacket, TheRoughLobeLeansForward) {
  const ScatterPacket grazing = RoughSurface(0.9F, 1.0F, 0.3F);
  EXPECT_NEAR(grazing.Forward().x.Values()[0], 1.0F, 1e-5F);
  EXPECT_NEAR(grazing.Forward().z.Values()[0], 0.0F, 1e-5F);
  // By samples of the lobe: what they weigh by their component forward.
  double sum = 0.0;
  constexpr int kStrata = 64;
  for (int i = 0; i < kStrata * kStrata; ++i) {
    const float first = (static_cast<float>(i % kStrata) + 0.5F) / kStrata;
    const float second = (static_cast<float>(i / kStrata) + 0.5F) / kStrata;
    const ScatterPacket::SpecularSample sample = grazing.SampleSpecular(first, second);
    if ((sample.is_valid.Bits() & 1U) != 0) {
      sum += sample.weight.r.Values()[0] * sample.to_light.x.Values()[0];
    }
  }
  EXPECT_NEAR(grazing.SpecularForward().r.Values()[0], sum / (kStrata * kStrata), 2e-4);
  // A third of what it reflects: it is far from even about the normal.
  EXPECT_GT(sum / (kStrata * kStrata), 0.3 * grazing.SpecularReflectance().r.Values()[0]);
  const ScatterPacket steep = RoughSurface(0.9F, 1.0F, 1.0F);
  EXPECT_NEAR(steep.SpecularForward().r.Values()[0], 0.0F, 1e-4F);
}

TEST(ScatterPacket, SpreadNormalsGlintAsTheirMean) {
  // Normals with slopes of a normal distribution, and the mean of the glints of each.
  constexpr float kRoughness = 0.6F;
  constexpr int kSteps = 60;
  for (const double deviation : {0.1, 0.2}) {
    for (const double elevation : {0.15, 0.3, 0.6}) {
      const Vec3d to_viewer(-std::sqrt(1.0 - 0.09), 0.0, 0.3);
      const Vec3d to_light = Vec3d(0.6, 0.8, 0.0) * std::sqrt(1.0 - elevation * elevation) +
                             elevation * Vec3d::UnitZ();
      const BsdfParameters parameters{Rgb::Zero(), 0.0F, kRoughness, 1.5F};
      double sum = 0.0;
      double weights = 0.0;
      Vec3d mean = Vec3d::Zero();
      for (int i = 0; i < kSteps * kSteps; ++i) {
        const double x = 8.0 * ((i % kSteps + 0.5) / kSteps - 0.5);
        const double y = 8.0 * ((i / kSteps + 0.5) / kSteps - 0.5);
        const double weight = std::exp(-0.5 * (x * x + y * y));
        const Vec3d normal = Vec3d(deviation * x, deviation * y, 1.0).normalized();
        weights += weight;
        mean += weight * normal;
        if (normal.dot(to_viewer) > 0.0 && normal.dot(to_light) > 0.0) {
          const ShadingFrame frame(normal);
          const Bsdf bsdf(parameters, frame.ToLocal(to_viewer));
          sum += weight * bsdf.EvaluateSpecular(frame.ToLocal(to_light)).value_cosine[0];
        }
      }
      const double expected = sum / weights;
      const double length = mean.norm() / weights;
      // The surface's roughness is widened already.
      const double alpha = kRoughness * kRoughness;
      const auto widened =
          static_cast<float>(std::sqrt(std::sqrt(alpha * alpha + 2.0 * (1.0 - length))));
      const ScatterPacket surface = RoughSurface(widened, static_cast<float>(length), 0.3F);
      const float value = surface.EvaluateSpecular(Broadcast(Vec3f(to_light.cast<float>())))
                              .value_cosine.r.Values()[0];
      // What spreads far in grazing light is not as the model has it.
      EXPECT_NEAR(value, expected, 2.0 * deviation * expected) << deviation << " " << elevation;
    }
  }
}

TEST(ScatterPacket, DirectionsBelowTheTriangleAreNoSamples) {
  RandomPacket packet(3);
  for (ShadingPoint& point : packet.points) {
    point.geometric_normal = -point.normal;
  }
  EXPECT_EQ(packet.Scatter().SampleSpecular(0.3F, 0.2F).is_valid.Bits() & kActive, 0U);
}

}  // namespace
}  // namespace pfseq
