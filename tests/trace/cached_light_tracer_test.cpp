// SPDX-License-Identifier: Apache-2.0
// Radiance by stored light where it is known in closed form.
#include "renderer/trace/cached_light_tracer.h"

#include "tests/trace/gathered_scene.h"
#include "tests/trace/shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

LightStoreOptions StoreOptions() {
  LightStoreOptions options;
  options.spacing_m = 0.5F;
  return options;
}

struct TracedScene {
  TracedScene(Scene scene, Lighting lighting, int max_bounces = 6)
      : lit(std::move(scene), std::move(lighting), {1024, max_bounces, 0.0F, 1.5F, 2.0F}),
        store(lit.surfaces, lit.gatherer, StoreOptions()),
        tracer(lit.rays, lit.surfaces, lit.lighting, store, 0.0F, max_bounces) {}

  /// Mean of samples along a ray. The rays fill the packet's odd lanes alone.
  Rgb Mean(const Vec3f& origin_m, const Vec3f& direction, int num_samples) const {
    Rgb sum = Rgb::Zero();
    for (int first = 0; first < num_samples; first += kPacketSize / 2) {
      CameraPacket packet;
      std::array<Rgb, kPacketSize> radiance;
      radiance.fill(Rgb::Constant(-7.0F));
      for (int i = 1; i < kPacketSize; i += 2) {
        packet.rays.Set(i, origin_m, direction.normalized());
        packet.samplers[static_cast<size_t>(i)] =
            PixelSampler(1, 0, 0, 0, static_cast<uint32_t>(first + i / 2));
      }
      tracer.Radiance(packet, radiance);
      for (size_t lane = 0; lane < kPacketSize; ++lane) {
        if (lane % 2 == 1) {
          sum += radiance[lane];
        } else {
          EXPECT_EQ(radiance[lane][0], -7.0F) << "an inactive lane was written";
        }
      }
    }
    return sum / static_cast<float>((num_samples + 3) / 4 * 4);
  }

  GatheredScene lit;
  LightStore store;
  CachedLightTracer tracer;
};

Scene FloorOf(const Material& material) {
  Scene scene;
  scene.materials = {material};
  scene.meshes = {FloorMesh(20.0F, 0)};
  return scene;
}

TEST(CachedLightTracer, LambertianPlaneUnderSunAndSky) {
  // a (L + E cos t / pi).
  const Rgb albedo(0.9F, 0.5F, 0.2F);
  const Rgb sun_irradiance(80.0F, 70.0F, 50.0F);
  const Rgb sky(3.0F, 4.0F, 6.0F);
  for (const double elevation_rad : {1.4, 0.5}) {
    const Vec3d to_sun(std::cos(elevation_rad), 0.0, std::sin(elevation_rad));
    const TracedScene traced(FloorOf(LambertianMaterial(albedo)),
                             SunAndConstantSky(to_sun, sun_irradiance, sky));
    const Rgb expected =
        albedo * (sky + sun_irradiance * static_cast<float>(std::sin(elevation_rad)) / kPi);
    const Rgb radiance = traced.Mean({0.3F, 0.1F, 2.0F}, {0.3F, 0.2F, -1.0F}, 64);
    EXPECT_TRUE(radiance.isApprox(expected, 0.01F)) << radiance.transpose();
    // Seen from below: the sky of the other side alone.
    const Rgb below = traced.Mean({0.3F, 0.1F, -2.0F}, {0.3F, 0.2F, 1.0F}, 64);
    EXPECT_TRUE(below.isApprox(albedo * sky, 0.01F)) << below.transpose();
  }
}

TEST(CachedLightTracer, SkyAndSunAreSeenDirectly) {
  const TracedScene traced(
      FloorOf(LambertianMaterial(Rgb::Ones())),
      SunAndConstantSky({0.0, 0.6, 0.8}, Rgb::Constant(10.0F), Rgb::Constant(2.0F)));
  const Vec3f eye_m(0.0F, 0.0F, 1.0F);
  EXPECT_EQ(traced.Mean(eye_m, {0.6F, 0.0F, 0.8F}, 4)[1], 2.0F);
  const float sun_radiance = traced.lit.lighting.sun->Radiance()[1];
  EXPECT_NEAR(
      traced.Mean(eye_m, {0.0F, 0.6F, 0.8F}, 4)[1], 2.0F + sun_radiance, 1e-3F * sun_radiance);
}

TEST(CachedLightTracer, WallShadowsTheSun) {
  Scene scene = FloorOf(LambertianMaterial(Rgb::Constant(0.5F)));
  scene.materials.push_back(LambertianMaterial(Rgb::Zero()));
  scene.meshes.push_back(
      ParallelogramMesh({2.0F, -5.0F, 0.0F}, {0.0F, 10.0F, 0.0F}, {0.0F, 0.0F, 3.0F}, 1));
  const TracedScene traced(scene,
                           SunAndConstantSky({1.0, 0.0, 1.0}, Rgb::Constant(100.0F), Rgb::Zero()));
  // The shadow reaches from x = 2 to x = -1. Neither black wall nor sky give any other light.
  EXPECT_LT(traced.Mean({0.0F, 0.0F, 2.0F}, {0.0F, 0.0F, -1.0F}, 8)[0], 1e-3F);
  EXPECT_NEAR(traced.Mean({-2.0F, 0.0F, 2.0F}, {0.0F, 0.0F, -1.0F}, 8)[0],
              0.5F * 100.0F * std::sqrt(0.5F) / kPi,
              0.1F);
}

TEST(CachedLightTracer, WithoutBouncesThereIsEmissionAlone) {
  Material material = LambertianMaterial(Rgb::Constant(0.5F));
  material.emission = Rgb(1.0F, 2.0F, 3.0F);
  const Lighting lighting =
      SunAndConstantSky({1.0, 0.0, 1.0}, Rgb::Constant(100.0F), Rgb::Constant(5.0F));
  const TracedScene none(FloorOf(material), lighting, 0);
  EXPECT_TRUE((none.Mean({0.0F, 0.0F, 2.0F}, {0.0F, 0.0F, -1.0F}, 4) == material.emission).all());
  const TracedScene one(FloorOf(material), ConstantSkyLight(Rgb::Constant(5.0F)), 1);
  EXPECT_TRUE(one.Mean({0.0F, 0.0F, 2.0F}, {0.0F, 0.0F, -1.0F}, 4)
                  .isApprox(material.emission + 2.5F, 0.01F));
}

TEST(CachedLightTracer, WhiteSurfacesVanishInAUniformSky) {
  // A white dielectric returns the sky; a metal loses a little to its own roughness.
  for (const auto& [metallic, roughness] :
       {std::pair(0.0F, 0.1F), {0.0F, 0.45F}, {0.0F, 0.9F}, {1.0F, 0.1F}, {1.0F, 0.3F}}) {
    Material material;
    material.base_color = Rgb::Ones();
    material.metallic = metallic;
    material.roughness = roughness;
    const TracedScene traced(FloorOf(material), ConstantSkyLight(Rgb::Constant(2.0F)));
    for (const float slant : {0.1F, 1.0F, 3.0F}) {
      const Rgb radiance = traced.Mean({0.3F, 0.1F, 2.0F}, {slant, 0.2F, -1.0F}, 256);
      const Bsdf bsdf({Rgb::Ones(), metallic, roughness, 1.5F},
                      -Vec3d(slant, 0.2, -1.0).normalized());
      const float share = (bsdf.DiffuseReflectance() + bsdf.SpecularReflectance())[1];
      EXPECT_GT(share, 0.9F);
      EXPECT_NEAR(radiance[1], 2.0F * share, 0.04F) << metallic << " " << roughness << " " << slant;
    }
  }
}

TEST(CachedLightTracer, MirrorShowsTheColouredWall) {
  Scene scene;
  Material mirror;
  mirror.base_color = Rgb(1.0F, 0.9F, 0.8F);
  mirror.metallic = 1.0F;
  mirror.roughness = 0.02F;
  scene.materials = {mirror, LambertianMaterial(Rgb(0.8F, 0.1F, 0.3F))};
  // The wall stands before x = 4 and looks back.
  scene.meshes = {
      FloorMesh(10.0F, 0),
      ParallelogramMesh({4.0F, -5.0F, 0.5F}, {0.0F, 0.0F, 4.0F}, {0.0F, 10.0F, 0.0F}, 1)};
  // Without a sun, whose image in the mirror few of a record's rays would find.
  const TracedScene traced(scene, ConstantSkyLight(Rgb::Ones()));
  for (const float height_m : {1.0F, 2.0F, 3.0F}) {
    // Toward the wall's mirror image, and at the wall itself, which looks the same from anywhere.
    const Vec3f wall_m(4.0F, 0.7F, height_m);
    const Vec3f eye_m(-1.0F, 0.0F, 2.0F);
    const Vec3f mirrored_wall_m(4.0F, 0.7F, -height_m);
    const Rgb reflected = traced.Mean(eye_m, mirrored_wall_m - eye_m, 64);
    const Rgb direct = traced.Mean(eye_m, wall_m - eye_m, 64);
    EXPECT_GT(direct[0], 2.0F * direct[2]);
    // Schlick's term brings the metal's colour nearer to white.
    const Vec3f direction = (mirrored_wall_m - eye_m).normalized();
    const float weight = std::pow(1.0F + direction.z(), 5.0F);
    const Rgb reflectance = mirror.base_color + (1.0F - mirror.base_color) * weight;
    EXPECT_TRUE(reflected.isApprox(reflectance * direct, 0.03F))
        << height_m << ": " << reflected.transpose() << " and " << direct.transpose();
  }
  // What the mirror shows beside the wall is the sky.
  const Rgb sky = traced.Mean({-1.0F, 0.0F, 2.0F}, {-0.2F, -1.0F, -1.0F}, 64);
  EXPECT_NEAR(sky[0], 1.0F, 0.02F);
}

TEST(CachedLightTracer, MirrorsInMirrorsShowTheGlowingWall) {
  // Between a floor and a ceiling that mirror, closed by a wall.
  Material mirror;
  mirror.base_color = Rgb::Ones();
  mirror.metallic = 1.0F;
  mirror.roughness = 0.02F;
  Material glowing = LambertianMaterial(Rgb::Zero());
  glowing.emission = Rgb(1.0F, 2.0F, 3.0F);
  for (const float wall_m : {4.0F, 6.0F}) {
    Scene scene = FloorOf(mirror);
    scene.materials.push_back(glowing);
    scene.meshes.push_back(
        ParallelogramMesh({-20.0F, -20.0F, 2.0F}, {0.0F, 40.0F, 0.0F}, {40.0F, 0.0F, 0.0F}, 0));
    scene.meshes.push_back(
        ParallelogramMesh({wall_m, -20.0F, 0.0F}, {0.0F, 0.0F, 2.0F}, {0.0F, 40.0F, 0.0F}, 1));
    const TracedScene traced(scene, ConstantSkyLight(Rgb::Zero()));
    // By floor and ceiling, and by the floor once more. A little is lost where the mirrors count as
    // rougher than they are.
    const Rgb seen = traced.Mean({0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, -1.0F}, 1024);
    EXPECT_TRUE(seen.isApprox(0.97F * glowing.emission, 0.03F))
        << wall_m << ": " << seen.transpose();
  }
}

/// A mirroring floor before a wall.
Scene FloorBeforeWall(const Material& floor) {
  Scene scene = FloorOf(floor);
  scene.materials.push_back(LambertianMaterial(Rgb(0.8F, 0.1F, 0.3F)));
  scene.meshes.push_back(
      ParallelogramMesh({4.0F, -5.0F, 0.5F}, {0.0F, 0.0F, 4.0F}, {0.0F, 10.0F, 0.0F}, 1));
  return scene;
}

TEST(CachedLightTracer, WantsWhatItLooksUp) {
  Material mirror;
  mirror.metallic = 1.0F;
  mirror.roughness = 0.02F;
  for (const Material& floor : {LambertianMaterial(Rgb::Constant(0.5F)), mirror}) {
    const TracedScene traced(FloorBeforeWall(floor), ConstantSkyLight(Rgb::Ones()));
    CameraPacket packet;
    for (int i = 0; i < kPacketSize; ++i) {
      packet.rays.Set(
          i, {0.0F, 0.0F, 2.0F}, Vec3f(0.3F * static_cast<float>(i), 0.2F, -1.0F).normalized());
    }
    // The last does not count, the sky needs no record.
    packet.rays.Set(6, {0.0F, 0.0F, 2.0F}, Vec3f::UnitZ());
    packet.rays.active &= 0x7FU;
    CameraPacket same = packet;
    std::vector<LightStore::RecordId> missing;
    traced.tracer.WantRecords(packet, missing);
    const auto num_reflected =
        std::count_if(missing.begin(), missing.end(), [](const LightStore::RecordId& id) {
          return id.detail == LightDetail::kReflected;
        });
    EXPECT_EQ(num_reflected > 0, floor.metallic > 0.0F);
    EXPECT_LT(num_reflected, static_cast<std::ptrdiff_t>(missing.size()));
    std::array<Rgb, kPacketSize> radiance;
    traced.tracer.Radiance(same, radiance);
    EXPECT_EQ(traced.store.NumRecords(), static_cast<int64_t>(missing.size()));
  }
}

}  // namespace
}  // namespace pfseq
