// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/material.h"

#include "renderer/core/random.h"
#include "tests/trace/shapes.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Texture UniformTexture(uint8_t red, uint8_t green, uint8_t blue, bool is_srgb) {
  Texture texture;
  texture.texels = Image<uint8_t>(2, 2, 4, 255);
  texture.is_srgb = is_srgb;
  for (int i = 0; i < 4; ++i) {
    texture.texels.At(i % 2, i / 2, 0) = red;
    texture.texels.At(i % 2, i / 2, 1) = green;
    texture.texels.At(i % 2, i / 2, 2) = blue;
  }
  return texture;
}

/// A scene with what is needed to ask for the point that a ray sees.
class Seen {
 public:
  explicit Seen(Scene scene)
      : scene_(std::make_shared<const Scene>(std::move(scene))),
        ray_scene_(scene_),
        textures_(*scene_) {}

  SurfacePoint Along(const Vec3d& origin_m, const Vec3d& direction) const {
    const std::optional<RayHit> hit = ray_scene_.Intersect(origin_m, direction.normalized());
    return SurfacePoint(*scene_, textures_, hit.value(), direction.normalized());
  }

 private:
  std::shared_ptr<const Scene> scene_;
  RayScene ray_scene_;
  TextureSet textures_;
};

Scene FloorScene(const Material& material) {
  Scene scene;
  scene.materials = {material};
  scene.meshes = {FloorMesh(1.0F, 0)};
  return scene;
}

TEST(ShadingFrame, IsOrthonormalAndRightHanded) {
  RandomStream random({1});
  for (int i = 0; i < 100; ++i) {
    Vec3d normal(random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0));
    normal = i == 0 ? Vec3d(-Vec3d::UnitZ()) : Vec3d(normal.normalized());
    const ShadingFrame frame(normal);
    EXPECT_NEAR(frame.tangent.norm(), 1.0, 1e-12);
    EXPECT_NEAR(frame.tangent.dot(normal), 0.0, 1e-12);
    EXPECT_LT((frame.tangent.cross(frame.bitangent) - normal).norm(), 1e-12);
    EXPECT_LT((frame.ToWorld(frame.ToLocal({1.0, 2.0, 3.0})) - Vec3d(1.0, 2.0, 3.0)).norm(), 1e-12);
    EXPECT_LT((frame.ToLocal(normal) - Vec3d::UnitZ()).norm(), 1e-12);
  }
}

TEST(SurfacePoint, LiesWhereTheRayMeetsTheTriangle) {
  const Seen seen(FloorScene(Material{}));
  const Vec3d direction = Vec3d(0.1, 0.2, -1.0).normalized();
  const SurfacePoint point = seen.Along({0.3, -0.4, 2.0}, direction);
  EXPECT_LT((point.PositionM() - Vec3d(0.5, 0.0, 0.0)).norm(), 1e-9);
}

TEST(SurfacePoint, NormalsFaceTheViewerOnBothSides) {
  const Seen seen(FloorScene(Material{}));
  const SurfacePoint above = seen.Along({0.1, 0.2, 1.0}, {0.0, 0.0, -1.0});
  const SurfacePoint below = seen.Along({0.1, 0.2, -1.0}, {0.0, 0.0, 1.0});
  EXPECT_LT((above.GeometricNormal() - Vec3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((above.ShadingNormal() - Vec3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((below.GeometricNormal() + Vec3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((below.ShadingNormal() + Vec3d::UnitZ()).norm(), 1e-9);
  EXPECT_GT(above.RayOriginM().z(), 5e-5);
  EXPECT_LT(above.RayOriginM().z(), 5e-4);
  EXPECT_LT(below.RayOriginM().z(), -5e-5);
}

TEST(SurfacePoint, InterpolatesVertexNormalsAndTurnsThemWithTheViewer) {
  Scene scene = FloorScene(Material{});
  const Vec3f left = Vec3f(-1.0F, 0.0F, 1.0F).normalized();
  const Vec3f right = Vec3f(1.0F, 0.0F, 1.0F).normalized();
  scene.meshes[0].normals = {left, right, right, left};
  const Seen seen(scene);
  EXPECT_LT((seen.Along({0.0, 0.3, 1.0}, {0.0, 0.0, -1.0}).ShadingNormal() - Vec3d::UnitZ()).norm(),
            1e-6);
  const Vec3d expected = Vec3d(0.5, 0.0, 1.0).normalized();
  EXPECT_LT((seen.Along({0.5, 0.3, 1.0}, {0.0, 0.0, -1.0}).ShadingNormal() - expected).norm(),
            1e-6);
  EXPECT_LT((seen.Along({0.5, 0.3, -1.0}, {0.0, 0.0, 1.0}).ShadingNormal() + expected).norm(),
            1e-6);
}

TEST(SurfacePoint, InwardVertexNormalsAreTurnedTowardTheViewerToo) {
  Scene scene = FloorScene(Material{});
  scene.meshes[0].normals.assign(4, -Vec3f::UnitZ());
  const Seen seen(scene);
  EXPECT_LT((seen.Along({0.1, 0.2, 1.0}, {0.0, 0.0, -1.0}).ShadingNormal() - Vec3d::UnitZ()).norm(),
            1e-9);
}

TEST(SurfacePoint, ShadingNormalThatTheViewerCannotSeeIsBentUntilHeJustCan) {
  Scene scene = FloorScene(Material{});
  scene.meshes[0].normals.assign(4, Vec3f(1.0F, 0.0F, 0.3F).normalized());
  const Seen seen(scene);
  const Vec3d direction = Vec3d(1.0, 0.0, -0.2).normalized();
  const SurfacePoint point = seen.Along({-0.5, 0.1, 0.1}, direction);
  EXPECT_GT(point.ShadingNormal().dot(-direction), 0.0);
  EXPECT_LT(point.ShadingNormal().dot(-direction), 1e-3);
  EXPECT_GT(point.ShadingNormal().x(), 0.0);
}

TEST(SurfacePoint, LightDoesNotLeakThroughShadingNormals) {
  Scene scene = FloorScene(LambertianMaterial(Rgb::Ones()));
  scene.meshes[0].normals.assign(4, Vec3f(1.0F, 0.0F, 0.5F).normalized());
  const Seen seen(scene);
  const SurfacePoint point = seen.Along({0.0, 0.1, 1.0}, {0.0, 0.0, -1.0});
  // Above the shading normal's horizon, but from below the floor; then the other way round.
  EXPECT_EQ(point.Evaluate(Vec3d(1.0, 0.0, -0.1).normalized()).value_cosine.maxCoeff(), 0.0F);
  EXPECT_EQ(point.Evaluate(Vec3d(-1.0, 0.0, 0.1).normalized()).value_cosine.maxCoeff(), 0.0F);
  EXPECT_GT(point.Evaluate(Vec3d(1.0, 0.0, 0.1).normalized()).value_cosine.maxCoeff(), 0.0F);
  RandomStream random({2});
  for (int i = 0; i < 1000; ++i) {
    const double first = random.Uniform();
    const std::optional<BsdfSample> sample = point.Sample(0.5, {first, random.Uniform()});
    if (sample.has_value()) {
      EXPECT_GT(sample->to_light.z(), 0.0);
      EXPECT_NEAR(point.Evaluate(sample->to_light).pdf, sample->pdf, 1e-9);
    }
  }
}

/// The shading normal of a floor, its texture coordinates along +X and (turned by `v_sign`) +Y,
/// under a normal map.
Vec3d MappedNormal(
    uint8_t red, uint8_t green, uint8_t blue, float u_sign, float v_sign, double viewer_side) {
  Material material;
  material.normal_texture_idx = 0;
  Scene scene = FloorScene(material);
  for (Vec2f& texcoord : scene.meshes[0].texcoords) {
    texcoord = {u_sign * texcoord.x(), v_sign * texcoord.y()};
  }
  scene.textures = {UniformTexture(red, green, blue, false)};
  return Seen(scene).Along({0.1, 0.2, viewer_side}, {0.0, 0.0, -viewer_side}).ShadingNormal();
}

TEST(NormalMap, RedTiltsAlongGrowingU) {
  // Red 255: x = 1, blue 255: z = 1, green 127.5 is about 0.
  EXPECT_LT(
      (MappedNormal(255, 128, 255, 1.0F, 1.0F, 1.0) - Vec3d(1.0, 0.0, 1.0).normalized()).norm(),
      0.005);
  EXPECT_LT(
      (MappedNormal(0, 128, 255, 1.0F, 1.0F, 1.0) - Vec3d(-1.0, 0.0, 1.0).normalized()).norm(),
      0.005);
  EXPECT_LT(
      (MappedNormal(255, 128, 255, -1.0F, 1.0F, 1.0) - Vec3d(-1.0, 0.0, 1.0).normalized()).norm(),
      0.005);
}

TEST(NormalMap, GreenTiltsTowardTheImagesUpperEdgeWhichIsFallingV) {
  EXPECT_LT(
      (MappedNormal(128, 255, 255, 1.0F, 1.0F, 1.0) - Vec3d(0.0, -1.0, 1.0).normalized()).norm(),
      0.005);
  EXPECT_LT(
      (MappedNormal(128, 255, 255, 1.0F, -1.0F, 1.0) - Vec3d(0.0, 1.0, 1.0).normalized()).norm(),
      0.005);
  EXPECT_LT(
      (MappedNormal(128, 255, 255, -1.0F, 1.0F, 1.0) - Vec3d(0.0, -1.0, 1.0).normalized()).norm(),
      0.005);
}

TEST(NormalMap, SeenFromBehindTheWholeNormalTurns) {
  EXPECT_LT(
      (MappedNormal(255, 128, 255, 1.0F, 1.0F, -1.0) + Vec3d(1.0, 0.0, 1.0).normalized()).norm(),
      0.005);
}

TEST(NormalMap, ScaleAndDegenerateCoordinates) {
  Material material;
  material.normal_texture_idx = 0;
  material.normal_scale = 0.5F;
  Scene scene = FloorScene(material);
  scene.textures = {UniformTexture(255, 128, 255, false)};
  const Vec3d half = Seen(scene).Along({0.1, 0.2, 1.0}, {0.0, 0.0, -1.0}).ShadingNormal();
  EXPECT_LT((half - Vec3d(0.5, 0.0, 1.0).normalized()).norm(), 0.005);
  scene.meshes[0].texcoords.assign(4, Vec2f(0.5F, 0.5F));
  EXPECT_LT((Seen(scene).Along({0.1, 0.2, 1.0}, {0.0, 0.0, -1.0}).ShadingNormal() - Vec3d::UnitZ())
                .norm(),
            1e-9);
}

TEST(NormalMap, BumpIsBrighterOnTheSideOfTheLight) {
  // A wall in the plane y = 0 that faces -Y, with its picture upright: u along +X, v down.
  Material material = LambertianMaterial(Rgb::Ones());
  material.normal_texture_idx = 0;
  Scene scene;
  scene.materials = {material};
  scene.meshes = {
      ParallelogramMesh({-1.0F, 0.0F, -1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 2.0F}, 0)};
  scene.meshes[0].texcoords = {{0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}};
  const auto brightness = [&](uint8_t red, uint8_t green, const Vec3d& to_light) {
    scene.textures = {UniformTexture(red, green, 230, false)};
    return Seen(scene)
        .Along({0.1, -1.0, 0.2}, {0.0, 1.0, 0.0})
        .Evaluate(to_light.normalized())
        .value_cosine[0];
  };
  const Vec3d from_left(-1.0, -1.0, 0.0);
  const Vec3d from_above(0.0, -1.0, 1.0);
  EXPECT_GT(brightness(60, 128, from_left), brightness(190, 128, from_left));
  EXPECT_GT(brightness(128, 190, from_above), brightness(128, 60, from_above));
}

TEST(SurfacePoint, ReadsTexturesByTheirChannels) {
  Material material;
  material.base_color = Rgb(0.5F, 1.0F, 1.0F);
  material.base_color_texture_idx = 0;
  material.roughness = 0.8F;
  material.metallic = 0.5F;
  material.metallic_roughness_texture_idx = 1;
  material.emission = Rgb(2.0F, 2.0F, 2.0F);
  material.emission_texture_idx = 2;
  material.ior = 1.3F;
  Scene scene = FloorScene(material);
  scene.textures = {UniformTexture(255, 188, 0, true),
                    UniformTexture(255, 51, 102, false),
                    UniformTexture(0, 255, 0, true)};
  const SurfacePoint point = Seen(scene).Along({0.1, 0.2, 1.0}, {0.0, 0.0, -1.0});
  EXPECT_NEAR(point.Parameters().base_color[0], 0.5F, 1e-5F);
  EXPECT_NEAR(point.Parameters().base_color[1], 0.50289F, 1e-4F);
  EXPECT_EQ(point.Parameters().base_color[2], 0.0F);
  EXPECT_NEAR(point.Parameters().roughness, 0.8F * 0.2F, 1e-6F);
  EXPECT_NEAR(point.Parameters().metallic, 0.5F * 0.4F, 1e-6F);
  EXPECT_EQ(point.Parameters().ior, 1.3F);
  EXPECT_TRUE(point.Emission().isApprox(Rgb(0.0F, 2.0F, 0.0F), 1e-5F));
}

TEST(SurfacePoint, TextureFollowsTheCoordinatesOfTheHit) {
  Material material;
  material.base_color = Rgb::Ones();
  material.base_color_texture_idx = 0;
  Scene scene = FloorScene(material);
  Texture texture;
  texture.is_srgb = false;
  texture.texels = Image<uint8_t>(2, 2, 4, 0);
  texture.texels.At(1, 0, 0) = 255;  // right column, first row: v near 0, which is -Y here
  scene.textures = {texture};
  const Seen seen(scene);
  EXPECT_NEAR(
      seen.Along({0.5, -0.5, 1.0}, {0.0, 0.0, -1.0}).Parameters().base_color[0], 1.0F, 1e-5F);
  EXPECT_NEAR(
      seen.Along({-0.5, -0.5, 1.0}, {0.0, 0.0, -1.0}).Parameters().base_color[0], 0.0F, 1e-5F);
  EXPECT_NEAR(
      seen.Along({0.5, 0.5, 1.0}, {0.0, 0.0, -1.0}).Parameters().base_color[0], 0.0F, 1e-5F);
}

TEST(SurfacePoint, WithoutTexcoordsTexturesAreIgnored) {
  Material material;
  material.base_color_texture_idx = 0;
  material.normal_texture_idx = 0;
  material.emission_texture_idx = 0;
  material.metallic_roughness_texture_idx = 0;
  Scene scene = FloorScene(material);
  scene.textures = {UniformTexture(10, 20, 30, true)};
  scene.meshes[0].texcoords.clear();
  const SurfacePoint point = Seen(scene).Along({0.1, 0.2, 1.0}, {0.0, 0.0, -1.0});
  EXPECT_EQ(point.Parameters().base_color[0], 0.8F);
  EXPECT_EQ(point.Parameters().roughness, 1.0F);
  EXPECT_LT((point.ShadingNormal() - Vec3d::UnitZ()).norm(), 1e-9);
}

}  // namespace
}  // namespace pfseq
