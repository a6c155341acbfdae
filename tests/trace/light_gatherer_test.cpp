// SPDX-License-Identifier: Apache-2.0
// Places whose irradiance is known in closed form.
#include "renderer/trace/light_gatherer.h"

#include "tests/trace/gathered_scene.h"
#include "tests/trace/shapes.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Nothing is near, so that the coarse light is asked; or everything, so that paths are followed.
constexpr float kNothing_m = 0.0F;
constexpr float kEverything_m = std::numeric_limits<float>::infinity();

GatherOptions Options(int max_bounces, float near_m) {
  GatherOptions options;
  options.max_bounces = max_bounces;
  options.near_m = near_m;
  return options;
}

/// Mean of the records of some keys.
VectorIrradiance MeanLight(const GatheredScene& lit,
                           const Vec3f& origin_m,
                           const Vec3f& normal,
                           int num_keys = 16) {
  VectorIrradiance mean;
  for (int key = 0; key < num_keys; ++key) {
    const GatheredLight gathered =
        lit.gatherer.Gather(origin_m, normal, static_cast<uint64_t>(key));
    mean.x += gathered.light.x / static_cast<float>(num_keys);
    mean.y += gathered.light.y / static_cast<float>(num_keys);
    mean.z += gathered.light.z / static_cast<float>(num_keys);
  }
  return mean;
}

Scene SceneOf(std::vector<Mesh> meshes, std::vector<Material> materials) {
  Scene scene;
  scene.meshes = std::move(meshes);
  scene.materials = std::move(materials);
  return scene;
}

/// Faces look inward.
Scene Furnace(float albedo, float emission) {
  Material material = LambertianMaterial(Rgb::Constant(albedo));
  material.emission = Rgb::Constant(emission);
  Mesh mesh = BoxScene({-2.0F, -1.5F, 0.0F}, {2.0F, 1.5F, 2.5F})->meshes[0];
  return SceneOf({mesh}, {material});
}

TEST(LightGatherer, OpenPlaneUnderAConstantSkyGetsPiAlongItsNormal) {
  const Rgb radiance(3.0F, 2.0F, 0.5F);
  // With a sun as well: its own disc is left out.
  for (const bool has_sun : {false, true}) {
    const GatheredScene lit(
        SceneOf({FloorMesh(10.0F, 0)}, {LambertianMaterial(Rgb::Ones())}),
        has_sun ? SunAndConstantSky({1.0, 0.5, 1.0}, Rgb::Constant(100.0F), radiance)
                : ConstantSkyLight(radiance));
    const VectorIrradiance light = MeanLight(lit, {0.3F, -0.2F, 1e-4F}, Vec3f::UnitZ());
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(light.z[channel], kPi * radiance[channel], 0.01F * kPi * radiance[channel]);
      EXPECT_NEAR(light.x[channel], 0.0F, 0.01F * kPi * radiance[channel]);
      EXPECT_NEAR(light.y[channel], 0.0F, 0.01F * kPi * radiance[channel]);
    }
    // A normal tilted by 30 degrees: the vector's component.
    const Vec3f tilted(0.5F, 0.0F, std::sqrt(0.75F));
    EXPECT_NEAR(light.Along(tilted)[0], kPi * 3.0F * tilted.z(), 0.1F);
  }
}

TEST(LightGatherer, OneRecordIsGoodToTwoPercentUnderAConstantSky) {
  const GatheredScene lit(SceneOf({FloorMesh(10.0F, 0)}, {LambertianMaterial(Rgb::Ones())}),
                          ConstantSkyLight(Rgb::Ones()));
  // Normals in all directions: each octant has a frame of its own.
  for (int i = 0; i < 32; ++i) {
    const Vec3f normal = Vec3f(std::sin(1.3F * static_cast<float>(i)),
                               std::cos(2.1F * static_cast<float>(i)),
                               std::sin(0.7F * static_cast<float>(i) + 1.0F))
                             .normalized();
    // Far above the floor, which hides a hundred-thousandth of the directions.
    const VectorIrradiance light =
        lit.gatherer.Gather({0.0F, 0.0F, 3000.0F}, normal, static_cast<uint64_t>(i)).light;
    EXPECT_NEAR(light.Along(normal)[0], kPi, 0.02F * kPi) << normal.transpose();
    EXPECT_LT((Vec3f(light.x[0], light.y[0], light.z[0]) - kPi * normal).norm(), 0.1F * kPi)
        << normal.transpose();
  }
}

TEST(LightGatherer, FewerRaysAreNoisierButRightInTheMean) {
  const GatheredScene lit(SceneOf({FloorMesh(10.0F, 0)}, {LambertianMaterial(Rgb::Ones())}),
                          ConstantSkyLight(Rgb::Ones()));
  constexpr int kNumRecords = 400;
  float less_noise = 0.0F;
  for (const ShareOfRays share :
       {ShareOfRays::kAll, ShareOfRays::kQuarter, ShareOfRays::kSixteenth}) {
    float sum = 0.0F;
    float sum_of_squares = 0.0F;
    for (int key = 0; key < kNumRecords; ++key) {
      const float error =
          lit.gatherer
              .Gather({0.0F, 0.0F, 3000.0F}, Vec3f::UnitZ(), static_cast<uint64_t>(key), share)
              .light.z[0] -
          kPi;
      sum += error;
      sum_of_squares += error * error;
    }
    const float noise = std::sqrt(sum_of_squares / kNumRecords);
    EXPECT_GT(noise, 1.5F * less_noise);
    EXPECT_NEAR(sum / kNumRecords, 0.0F, 4.0F * noise / std::sqrt(1.0F * kNumRecords));
    less_noise = noise;
  }
}

TEST(LightGatherer, EdgesAlongHeightsCostLittleNoise) {
  // A round black roof of 40 degrees, seen from the middle of a bright ground: in each column of
  // rays the edge cuts a cell. Rays at random in their cells have a noise of .8 percent.
  Mesh roof;
  constexpr int kNumCorners = 64;
  roof.positions_m.emplace_back(0.0F, 0.0F, 10.0F);
  for (int i = 0; i < kNumCorners; ++i) {
    const float angle_rad = 2.0F * kPi * static_cast<float>(i) / kNumCorners;
    const float radius_m = 10.0F * std::tan(40.0F * kPi / 180.0F);
    roof.positions_m.emplace_back(
        radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), 10.0F);
    const auto corner = static_cast<uint32_t>(i);
    roof.triangles.push_back({0, 1 + (corner + 1) % kNumCorners, 1 + corner});
  }
  const GatheredScene lit(
      SceneOf({FloorMesh(10.0F, 0), std::move(roof)}, {LambertianMaterial(Rgb::Zero())}),
      ConstantSkyLight(Rgb::Ones()));
  constexpr int kNumRecords = 400;
  float sum = 0.0F;
  float sum_of_squares = 0.0F;
  for (int key = 0; key < kNumRecords; ++key) {
    const float value =
        lit.gatherer.Gather({0.0F, 0.0F, 1e-4F}, Vec3f::UnitZ(), static_cast<uint64_t>(key))
            .light.z[0];
    sum += value;
    sum_of_squares += value * value;
  }
  const float mean = sum / kNumRecords;
  const float noise = std::sqrt(sum_of_squares / kNumRecords - mean * mean);
  const float cosine = std::cos(40.0F * kPi / 180.0F);
  EXPECT_NEAR(mean, kPi * cosine * cosine, 0.01F * kPi);
  EXPECT_LT(noise, 0.004F * mean);
}

TEST(LightGatherer, WallOnBlackGroundGetsHalfTheSky) {
  // A quarter of the sphere: pi / 2 along the wall's normal, and as much upward.
  const GatheredScene lit(
      SceneOf({FloorMesh(2000.0F, 0),
               ParallelogramMesh({0.0F, -5.0F, 0.0F}, {0.0F, 10.0F, 0.0F}, {0.0F, 0.0F, 4.0F}, 0)},
              {LambertianMaterial(Rgb::Zero())}),
      ConstantSkyLight(Rgb::Ones()));
  const VectorIrradiance light = MeanLight(lit, {1e-4F, 0.4F, 1.5F}, Vec3f::UnitX());
  EXPECT_NEAR(light.x[1], 0.5F * kPi, 0.02F * kPi);
  EXPECT_NEAR(light.z[1], 0.5F * kPi, 0.02F * kPi);
  EXPECT_NEAR(light.y[1], 0.0F, 0.02F * kPi);
}

TEST(LightGatherer, FurnaceWithFewBouncesIsThePartialSum) {
  // Each surface sends e (1 + a + a^2 + ...), as many terms as a path may scatter. The camera's
  // surface is the first.
  constexpr float kAlbedo = 0.8F;
  for (const float near_m : {kNothing_m, kEverything_m}) {
    float radiosity = 0.0F;
    for (int max_bounces = 1; max_bounces <= 4; ++max_bounces) {
      radiosity += 1.5F * std::pow(kAlbedo, static_cast<float>(max_bounces - 1));
      const GatheredScene lit(
          Furnace(kAlbedo, 1.5F), ConstantSkyLight(Rgb::Ones()), Options(max_bounces, near_m));
      const VectorIrradiance light = MeanLight(lit, {0.3F, 0.2F, 1e-4F}, Vec3f::UnitZ(), 4);
      EXPECT_NEAR(light.z[1], kPi * radiosity, 0.02F * kPi * radiosity)
          << max_bounces << " bounces, near " << near_m;
    }
  }
}

TEST(LightGatherer, FurnaceWithManyBouncesGathersThemAll) {
  constexpr float kAlbedo = 0.7F;
  constexpr float kRadiosity = 2.0F / (1.0F - kAlbedo);
  for (const float near_m : {kNothing_m, 2.0F, kEverything_m}) {
    const GatheredScene lit(
        Furnace(kAlbedo, 2.0F), ConstantSkyLight(Rgb::Ones()), Options(200, near_m));
    const VectorIrradiance light = MeanLight(lit, {-1.3F, 0.7F, 1e-4F}, Vec3f::UnitZ());
    EXPECT_NEAR(light.z[0], kPi * kRadiosity, 0.03F * kPi * kRadiosity) << near_m;
  }
}

TEST(LightGatherer, SunlitGroundLightsWhatFacesIt) {
  // Of infinite ground with albedo a, what looks down gets a E sin(elevation).
  const Rgb albedo(0.5F, 0.4F, 0.1F);
  const Vec3d to_sun = Vec3d(0.6, 0.0, 0.8);
  for (const float near_m : {kNothing_m, kEverything_m}) {
    const GatheredScene lit(SceneOf({FloorMesh(2000.0F, 0)}, {LambertianMaterial(albedo)}),
                            SunAndConstantSky(to_sun, Rgb::Constant(100.0F), Rgb::Zero()),
                            Options(2, near_m));
    const VectorIrradiance light = MeanLight(lit, {0.1F, 0.2F, 2.0F}, -Vec3f::UnitZ());
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(-light.z[channel], 80.0F * albedo[channel], 0.02F * 80.0F * albedo[channel])
          << near_m;
    }
  }
}

TEST(LightGatherer, ShadedGroundLightsNothing) {
  // A black canopy keeps the sun off the white ground that the point sees.
  Mesh canopy = FloorMesh(10.0F, 1);
  for (Vec3f& position_m : canopy.positions_m) {
    position_m.z() = 5.0F;
  }
  for (const float near_m : {kNothing_m, kEverything_m}) {
    const GatheredScene lit(
        SceneOf({FloorMesh(3.0F, 0), canopy},
                {LambertianMaterial(Rgb::Ones()), LambertianMaterial(Rgb::Zero())}),
        SunAndConstantSky({0.1, 0.0, 1.0}, Rgb::Constant(100.0F), Rgb::Zero()),
        Options(6, near_m));
    const VectorIrradiance light = MeanLight(lit, {0.0F, 0.0F, 2.0F}, -Vec3f::UnitZ());
    EXPECT_EQ(light.z[0], 0.0F) << near_m;
  }
}

TEST(LightGatherer, GlossyWhiteWallsReflectAsMuchAsMattOnes) {
  // Of a uniform surrounding a white dielectric returns what it gets, whatever its roughness.
  for (const float roughness : {0.2F, 0.6F}) {
    for (const float near_m : {kNothing_m, kEverything_m}) {
      Scene scene = Furnace(0.0F, 0.0F);
      scene.materials[0] = Material{};
      scene.materials[0].base_color = Rgb::Constant(1.0F);
      scene.materials[0].roughness = roughness;
      scene.materials[0].emission = Rgb::Ones();
      const GatheredScene lit(std::move(scene), ConstantSkyLight(Rgb::Zero()), Options(3, near_m));
      const VectorIrradiance light = MeanLight(lit, {0.1F, 0.2F, 1e-4F}, Vec3f::UnitZ(), 8);
      EXPECT_NEAR(light.z[1], 3.0F * kPi, 0.05F * 3.0F * kPi) << roughness << " " << near_m;
    }
  }
}

TEST(LightGatherer, TellsPlacesWithinABody) {
  std::vector<Mesh> meshes = {FloorMesh(10.0F, 0)};
  AddBox({-1.0F, -1.0F, 0.0F}, {2.0F, 2.0F, 2.0F}, 0, &meshes);
  const GatheredScene lit(SceneOf(meshes, {LambertianMaterial(Rgb::Constant(0.5F))}),
                          ConstantSkyLight(Rgb::Ones()));
  EXPECT_TRUE(lit.gatherer.Gather({0.2F, 0.1F, 1e-4F}, Vec3f::UnitZ(), 1).is_buried);
  EXPECT_FALSE(lit.gatherer.Gather({3.0F, 0.1F, 1e-4F}, Vec3f::UnitZ(), 1).is_buried);
  EXPECT_FALSE(lit.gatherer.Gather({1.0001F, 0.1F, 1.0F}, Vec3f::UnitX(), 1).is_buried);
}

TEST(LightGatherer, DependsOnTheKeyAlone) {
  const auto gather = [](const GatheredScene& lit, uint64_t key) {
    return lit.gatherer.Gather({0.3F, 0.2F, 1e-4F}, Vec3f::UnitZ(), key).light;
  };
  const Lighting lighting = SunAndConstantSky({1.0, 0.5, 1.0}, Rgb::Ones(), Rgb::Ones());
  const GatheredScene first(Furnace(0.5F, 1.0F), lighting);
  const GatheredScene second(Furnace(0.5F, 1.0F), lighting);
  // Another place first: the coarse light is filled in another order.
  gather(second, 9);
  EXPECT_TRUE((gather(first, 1).z == gather(second, 1).z).all());
  EXPECT_TRUE((gather(first, 1).x == gather(second, 1).x).all());
  EXPECT_FALSE((gather(first, 1).z == gather(first, 2).z).all());
}

}  // namespace
}  // namespace pfseq
