// SPDX-License-Identifier: Apache-2.0
// Scenes whose radiance is known in closed form.
#include "renderer/trace/path_tracer.h"

#include "renderer/core/random.h"
#include "renderer/core/units.h"
#include "tests/trace/shapes.h"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kPi = std::numbers::pi;

Lighting ConstantLight(float radiance) {
  return {std::nullopt, Sky::Constant(Rgb::Constant(radiance))};
}

/// Mean and the variance of the mean of independent values.
struct Statistics {
  void Add(double value) {
    ++count;
    sum += value;
    sum_of_squares += value * value;
  }
  double Mean() const { return sum / count; }
  double VarianceOfMean() const {
    return (sum_of_squares / count - Mean() * Mean()) / (count - 1.0);
  }

  int count = 0;
  double sum = 0.0;
  double sum_of_squares = 0.0;
};

/// A scene, its lights and the mean of many samples along a ray.
class Tracer {
 public:
  Tracer(Scene scene,
         const Lighting& lighting,
         int max_bounces,
         float min_indirect_roughness = 0.0F)
      : ray_scene_(std::make_shared<const Scene>(std::move(scene))),
        textures_(ray_scene_.PlainScene()),
        lighting_(lighting),
        tracer_(ray_scene_, textures_, lighting_, {max_bounces, min_indirect_roughness}) {}

  Rgb Mean(const Vec3d& origin_m,
           const Vec3d& direction,
           int num_samples,
           uint64_t pixel = 0) const {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (int i = 0; i < num_samples; ++i) {
      PixelSampler sampler(1, 0, 0, pixel, static_cast<uint32_t>(i));
      sum += tracer_.Radiance(origin_m, direction.normalized(), sampler).cast<double>();
    }
    return (sum / num_samples).cast<float>();
  }

 private:
  RayScene ray_scene_;
  TextureSet textures_;
  Lighting lighting_;
  PathTracer tracer_;
};

Scene OneMeshScene(Mesh mesh, const Material& material) {
  mesh.material_idx = 0;
  Scene scene;
  scene.materials = {material};
  scene.meshes = {std::move(mesh)};
  return scene;
}

TEST(PathTracer, FurnaceHidesALambertianSphere) {
  const Tracer tracer(
      OneMeshScene(SphereMesh(Vec3f::Zero(), 1.0F, 0), LambertianMaterial(Rgb::Ones())),
      ConstantLight(1.0F),
      4);
  for (int i = 0; i < 24; ++i) {
    const Vec3d target(
        0.98 * std::cos(i * 1.7) * (i / 24.0), 0.98 * std::sin(i * 1.7) * (i / 24.0), 0.0);
    const Rgb radiance = tracer.Mean(
        target + Vec3d(0.0, 0.0, 5.0), {0.0, 0.0, -1.0}, 2048, static_cast<uint64_t>(i));
    EXPECT_NEAR(radiance[0], 1.0F, 0.005F) << i;
    EXPECT_NEAR(radiance[2], 1.0F, 0.005F) << i;
  }
}

TEST(PathTracer, FurnaceNeverGainsLightOnGlossySurfaces) {
  for (const auto& [metallic, roughness] :
       {std::pair(0.0F, 0.2F), {0.0F, 0.6F}, {1.0F, 0.3F}, {1.0F, 0.9F}}) {
    Material material;
    material.base_color = Rgb::Ones();
    material.metallic = metallic;
    material.roughness = roughness;
    const Tracer tracer(
        OneMeshScene(SphereMesh(Vec3f::Zero(), 1.0F, 0), material), ConstantLight(1.0F), 4);
    for (const double offset : {0.0, 0.5, 0.9, 0.97}) {
      const float radiance = tracer.Mean({offset, 0.1, 5.0}, {0.0, 0.0, -1.0}, 2048)[1];
      EXPECT_LE(radiance, 1.005F) << metallic << " " << roughness << " " << offset;
      EXPECT_GE(radiance, metallic == 0.0F ? 0.99F : 0.4F)
          << metallic << " " << roughness << " " << offset;
    }
  }
}

TEST(PathTracer, ClosedSphereGathersAllBounces) {
  // L = E + albedo L everywhere inside.
  Material material = LambertianMaterial(Rgb(0.7F, 0.5F, 0.0F));
  material.emission = Rgb(1.0F, 2.0F, 3.0F);
  const Tracer tracer(
      OneMeshScene(SphereMesh({3.0F, 2.0F, 1.0F}, 2.0F, 0), material), ConstantLight(0.0F), 1000);
  const Rgb radiance = tracer.Mean({3.2, 2.1, 0.8}, {0.3, -0.2, 0.8}, 200000);
  EXPECT_NEAR(radiance[0], 1.0F / 0.3F, 0.005F / 0.3F);
  EXPECT_NEAR(radiance[1], 4.0F, 0.02F);
  EXPECT_NEAR(radiance[2], 3.0F, 0.001F);
}

TEST(PathTracer, ClosedSphereWithFewBouncesIsThePartialSum) {
  Material material = LambertianMaterial(Rgb::Constant(0.8F));
  material.emission = Rgb::Ones();
  const Scene scene = OneMeshScene(SphereMesh(Vec3f::Zero(), 2.0F, 0), material);
  float expected = 0.0F;
  for (int max_bounces = 0; max_bounces < 3; ++max_bounces) {
    expected += std::pow(0.8F, static_cast<float>(max_bounces));
    const Tracer tracer(scene, ConstantLight(5.0F), max_bounces);
    EXPECT_NEAR(tracer.Mean(Vec3d::Zero(), Vec3d::UnitX(), 16)[0], expected, 1e-5F);
  }
}

TEST(PathTracer, PlaneUnderSunAndSky) {
  // Lambertian: a (L + E cos t / pi), for any turn of the sun.
  const Rgb albedo(0.9F, 0.5F, 0.2F);
  const Rgb sun_irradiance(80.0F, 70.0F, 50.0F);
  for (const double elevation_deg : {80.0, 30.0}) {
    for (const double diameter_deg : {0.53, 10.0}) {
      const Vec3d to_sun(
          std::cos(RadFromDeg(elevation_deg)), 0.0, std::sin(RadFromDeg(elevation_deg)));
      const Lighting lighting = {SunDisc(to_sun, sun_irradiance, RadFromDeg(diameter_deg)),
                                 Sky::Constant(Rgb(5.0F, 6.0F, 9.0F))};
      const Tracer tracer(
          OneMeshScene(FloorMesh(10.0F, 0), LambertianMaterial(albedo)), lighting, 6);
      const Rgb expected =
          albedo * (Rgb(5.0F, 6.0F, 9.0F) +
                    sun_irradiance * static_cast<float>(std::sin(RadFromDeg(elevation_deg)) / kPi));
      const Rgb radiance = tracer.Mean({0.0, 0.0, 2.0}, {0.3, 0.1, -1.0}, 8192);
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(radiance[channel], expected[channel], 0.003F * expected[channel])
            << elevation_deg << " " << diameter_deg;
      }
    }
  }
}

TEST(PathTracer, SunBelowTheSurfaceGivesNothing) {
  const Lighting lighting = {SunDisc(Vec3d(0.5, 0.0, -0.5), Rgb::Constant(80.0F), 0.01),
                             Sky::Constant(Rgb::Zero())};
  const Tracer tracer(OneMeshScene(FloorMesh(10.0F, 0), Material{}), lighting, 6);
  EXPECT_EQ(tracer.Mean({0.0, 0.0, 2.0}, {0.1, 0.0, -1.0}, 256).maxCoeff(), 0.0F);
  EXPECT_GT(tracer.Mean({0.0, 0.0, -2.0}, {0.1, 0.0, 1.0}, 256).minCoeff(), 0.0F);
}

TEST(PathTracer, SunAndSkyAreSeenDirectly) {
  const Vec3d to_sun = Vec3d(0.3, 0.4, 0.8).normalized();
  const SunDisc sun(to_sun, Rgb::Constant(80.0F), RadFromDeg(0.53));
  const Tracer tracer(
      OneMeshScene(FloorMesh(1.0F, 0), Material{}), {sun, Sky::Constant(Rgb::Constant(2.0F))}, 6);
  EXPECT_NEAR(tracer.Mean({0.0, 0.0, 5.0}, to_sun, 1)[0], sun.Radiance()[0] + 2.0F, 1.0F);
  EXPECT_EQ(tracer.Mean({0.0, 0.0, 5.0}, -to_sun + Vec3d(3.0, 0.0, 0.0), 1)[0], 2.0F);
}

TEST(PathTracer, BlackWallBlocksItsShareOfTheSky) {
  // A long wall of height h at distance d of a horizontal point takes (1 - cos g) / 2 of the
  // irradiance of an even sky, with tan g = h / d (the form factor of an endless strip).
  const Material white = LambertianMaterial(Rgb::Ones());
  const Material black = LambertianMaterial(Rgb::Zero());
  for (const float height_m : {3.0F, 10.0F, 4000.0F}) {
    Scene scene;
    scene.materials = {white, black};
    scene.meshes = {
        FloorMesh(50.0F, 0),
        ParallelogramMesh(
            {10.0F, -4000.0F, -10.0F}, {0.0F, 8000.0F, 0.0F}, {0.0F, 0.0F, 10.0F + height_m}, 1)};
    const Tracer tracer(scene, ConstantLight(1.0F), 6);
    const float expected = 0.5F * (1.0F + std::cos(std::atan(height_m / 10.0F)));
    EXPECT_NEAR(
        tracer.Mean({0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}, 16384)[1], expected, 0.004F * expected)
        << height_m;
  }
}

TEST(PathTracer, SurfacesFarFromTheOriginDoNotShadeThemselves) {
  for (const float offset_m : {0.0F, 100.0F, 500.0F}) {
    for (const float half_size_m : {0.05F, 20.0F, 500.0F}) {
      Mesh mesh = FloorMesh(half_size_m, 0);
      const Eigen::AngleAxisf tilt(0.4F, Vec3f(0.6F, -0.8F, 0.0F));
      const Vec3f shift_m(offset_m, -offset_m, offset_m);
      for (Vec3f& position_m : mesh.positions_m) {
        position_m = tilt * position_m + shift_m;
      }
      const Tracer tracer(
          OneMeshScene(mesh, LambertianMaterial(Rgb::Constant(0.5F))), ConstantLight(1.0F), 6);
      const Vec3d normal = (tilt * Vec3f::UnitZ()).cast<double>();
      for (uint64_t pixel = 0; pixel < 8; ++pixel) {
        const double along_m = 0.6 * half_size_m * (static_cast<double>(pixel) / 8.0 - 0.5);
        const Vec3d target_m =
            shift_m.cast<double>() + along_m * (tilt * Vec3f::UnitX()).cast<double>();
        EXPECT_NEAR(tracer.Mean(target_m + 2.0 * normal, -normal, 1024, pixel)[0], 0.5F, 0.003F)
            << offset_m << " " << half_size_m;
      }
    }
  }
}

TEST(PathTracer, HolesOfMaskedMaterialsLetLightThrough) {
  Material mask;
  mask.base_alpha = 0.2F;
  mask.alpha_cutoff = 0.5F;
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb::Ones()), mask};
  Mesh roof = FloorMesh(50.0F, 1);
  for (Vec3f& position_m : roof.positions_m) {
    position_m.z() = 1.0F;
  }
  scene.meshes = {FloorMesh(10.0F, 0), roof};
  const Tracer tracer(scene, ConstantLight(1.0F), 6);
  EXPECT_NEAR(tracer.Mean({0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}, 4096)[0], 1.0F, 0.004F);
}

TEST(PathTracer, SameSamplerGivesTheSameBits) {
  Material material;
  material.roughness = 0.4F;
  Scene scene = OneMeshScene(SphereMesh({0.0F, 0.0F, 1.0F}, 1.0F, 0), material);
  scene.meshes.push_back(FloorMesh(5.0F, 0));
  const Lighting lighting = MakeLighting(LightSpec{}, std::nullopt);
  const Tracer first(scene, lighting, 6);
  const Tracer second(scene, lighting, 6);
  const Vec3d origin_m(4.0, 1.0, 1.5);
  const Rgb value = first.Mean(origin_m, {-1.0, -0.2, -0.3}, 33, 5);
  first.Mean(origin_m, {-1.0, -0.1, -0.3}, 10, 6);
  EXPECT_TRUE((first.Mean(origin_m, {-1.0, -0.2, -0.3}, 33, 5) == value).all());
  EXPECT_TRUE((second.Mean(origin_m, {-1.0, -0.2, -0.3}, 33, 5) == value).all());
  EXPECT_FALSE((first.Mean(origin_m, {-1.0, -0.2, -0.3}, 33, 6) == value).all());
}

TEST(PathTracer, WhatIsNotFiniteNeverLeavesIt) {
  Material material;
  material.emission = Rgb::Constant(std::numeric_limits<float>::infinity());
  const Tracer tracer(OneMeshScene(FloorMesh(5.0F, 0), material), ConstantLight(1.0F), 6);
  EXPECT_TRUE(tracer.Mean({0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}, 4).isFinite().all());
}

TEST(PathTracer, LeastIndirectRoughnessActsAfterTheFirstSurfaceAlone) {
  // A smooth metal wall beside a matt floor, under the sun.
  Material metal;
  metal.metallic = 1.0F;
  metal.roughness = 0.25F;
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb::Constant(0.5F)), metal};
  scene.meshes = {
      FloorMesh(20.0F, 0),
      ParallelogramMesh({3.0F, -20.0F, 0.0F}, {0.0F, 40.0F, 0.0F}, {0.0F, 0.0F, 8.0F}, 1)};
  const Vec3d to_sun = Vec3d(-0.6, 0.1, 0.7).normalized();
  const Lighting lighting = {SunDisc(to_sun, Rgb::Constant(80.0F), RadFromDeg(5.0)),
                             Sky::Constant(Rgb::Ones())};
  const auto estimate = [&](float min_indirect_roughness, const Vec3d& direction) {
    const Tracer tracer(scene, lighting, 4, min_indirect_roughness);
    Statistics statistics;
    for (uint64_t i = 0; i < 16384; ++i) {
      statistics.Add(tracer.Mean({0.0, 0.0, 2.0}, direction, 1, i)[1]);
    }
    return statistics;
  };
  // The floor near the wall: the wall's reflection of the sun is an indirect one. Its noise falls,
  // its mean stays near.
  const Vec3d to_floor(0.5, 0.0, -2.0);
  const Statistics exact = estimate(0.0F, to_floor);
  const Statistics blurred = estimate(0.4F, to_floor);
  EXPECT_LT(blurred.VarianceOfMean(), 0.3 * exact.VarianceOfMean());
  EXPECT_NEAR(blurred.Mean(), exact.Mean(), 0.15 * exact.Mean());
  // The wall seen itself, in a place that mirrors the sky: as rough as it is.
  const Vec3d to_wall(1.0, 0.0, 0.6);
  const double wall = estimate(0.0F, to_wall).Mean();
  EXPECT_NEAR(estimate(0.4F, to_wall).Mean(), wall, 0.005 * wall);
}

// ---- Against an independent estimator ----

/// A street between boxes: matt, glossy and metallic, with a mirror-like plate.
Scene StreetScene() {
  Material glossy;
  glossy.base_color = Rgb(0.2F, 0.3F, 0.6F);
  glossy.roughness = 0.4F;
  Material metal;
  metal.base_color = Rgb(0.9F, 0.7F, 0.4F);
  metal.metallic = 1.0F;
  metal.roughness = 0.3F;
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb::Constant(0.4F)),
                     LambertianMaterial(Rgb(0.8F, 0.4F, 0.3F)),
                     glossy,
                     metal};
  scene.meshes = {FloorMesh(60.0F, 0)};
  AddBox({-20.0F, 6.0F, 0.0F}, {18.0F, 10.0F, 12.0F}, 1, &scene.meshes);
  AddBox({1.0F, 6.0F, 0.0F}, {15.0F, 10.0F, 18.0F}, 2, &scene.meshes);
  AddBox({-20.0F, -16.0F, 0.0F}, {22.0F, 10.0F, 15.0F}, 3, &scene.meshes);
  AddBox({5.0F, -15.0F, 0.0F}, {12.0F, 10.0F, 9.0F}, 1, &scene.meshes);
  return scene;
}

/// Brute force: scatters by the BSDF alone and adds what the paths run into, with random numbers of
/// its own.
Rgb BruteForceRadiance(const RayScene& scene,
                       const TextureSet& textures,
                       const Lighting& lighting,
                       int max_bounces,
                       Vec3d origin_m,
                       Vec3d direction,
                       RandomStream& random) {
  Rgb throughput = Rgb::Ones();
  for (int bounce = 0;; ++bounce) {
    const std::optional<RayHit> hit = scene.Intersect(origin_m, direction);
    if (!hit.has_value()) {
      Rgb light = lighting.sky.Radiance(direction);
      if (lighting.sun->Contains(direction)) {
        light += lighting.sun->Radiance();
      }
      return throughput * light;
    }
    if (bounce == max_bounces) {
      return Rgb::Zero();
    }
    const SurfacePoint point(scene.PlainScene(), textures, *hit, direction);
    const double lobe = random.Uniform();
    const double first = random.Uniform();
    const std::optional<BsdfSample> sample = point.Sample(lobe, {first, random.Uniform()});
    if (!sample.has_value()) {
      return Rgb::Zero();
    }
    throughput *= sample->weight;
    origin_m = point.RayOriginM();
    direction = sample->to_light;
  }
}

TEST(SlowPathTracer, AgreesWithBruteForceInEachPixel) {
  constexpr int kSizePx = 16;
  constexpr int kNumSamples = 4096;
  constexpr int kMaxBounces = 5;
  const auto scene = std::make_shared<const Scene>(StreetScene());
  const RayScene ray_scene(scene);
  const TextureSet textures(*scene);
  // A wide sun, which brute force finds too; its irradiance is that of a weak one.
  const Vec3d to_sun = Vec3d(0.3, 0.35, 0.8).normalized();
  const Lighting lighting = {SunDisc(to_sun, Rgb(20.0F, 18.0F, 15.0F), RadFromDeg(40.0)),
                             Sky::Clear(to_sun, 3.0, 1.0)};
  const PathTracer tracer(ray_scene, textures, lighting, {kMaxBounces, 0.0F});
  const Vec3d origin_m(-15.0, 0.3, 1.6);
  double worst_z = 0.0;
  double sum_z = 0.0;
  int num_tested = 0;
  for (int y = 0; y < kSizePx; ++y) {
    for (int x = 0; x < kSizePx; ++x) {
      const Vec3d direction =
          Vec3d(1.0, 1.6 * (0.5 - (x + 0.5) / kSizePx), 1.6 * (0.55 - (y + 0.5) / kSizePx))
              .normalized();
      if (!ray_scene.Intersect(origin_m, direction).has_value()) {
        continue;
      }
      const auto pixel = static_cast<uint64_t>(y * kSizePx + x);
      RandomStream random({77, pixel});
      Statistics traced;
      Statistics brute;
      for (int i = 0; i < kNumSamples; ++i) {
        // A seed for each sample: stratified samples are not independent of each other.
        PixelSampler sampler(static_cast<uint64_t>(i), 0, 0, pixel, 0);
        traced.Add(Luminance(tracer.Radiance(origin_m, direction, sampler)));
        brute.Add(Luminance(BruteForceRadiance(
            ray_scene, textures, lighting, kMaxBounces, origin_m, direction, random)));
      }
      const double z = (traced.Mean() - brute.Mean()) /
                       std::sqrt(traced.VarianceOfMean() + brute.VarianceOfMean());
      worst_z = std::max(worst_z, std::abs(z));
      sum_z += z;
      ++num_tested;
    }
  }
  EXPECT_GT(num_tested, 200);
  // Sidak: with n tests at 1 % in all, each is at 1 - 0.99^(1/n).
  const double p_of_worst = std::erfc(worst_z / std::numbers::sqrt2);
  EXPECT_GT(p_of_worst, 1.0 - std::pow(0.99, 1.0 / num_tested)) << "largest z " << worst_z;
  // A small bias of one sign in all pixels shows in the sum.
  EXPECT_LT(std::abs(sum_z) / std::sqrt(num_tested), 3.3);
  RecordProperty("worst_z", std::to_string(worst_z));
}

}  // namespace
}  // namespace pfseq
