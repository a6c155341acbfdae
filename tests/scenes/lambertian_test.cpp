// SPDX-License-Identifier: Apache-2.0
#include "scenes/lambertian.h"

#include "renderer/trace/color.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Field;

/// Two texels side by side.
Texture TwoTexels(const char* name, std::array<uint8_t, 4> left, std::array<uint8_t, 4> right) {
  Texture texture;
  texture.name = name;
  texture.texels = Image<uint8_t>(2, 1, 4);
  for (int k = 0; k < 4; ++k) {
    texture.texels.At(0, 0, k) = left[static_cast<size_t>(k)];
    texture.texels.At(1, 0, k) = right[static_cast<size_t>(k)];
  }
  return texture;
}

constexpr int kShiny = 0;
constexpr int kFence = 1;
constexpr int kPlain = 2;

/// A shiny, glowing material that uses every texture, a fence with holes, and a plain colour.
Scene SceneOfAllMaterials() {
  Scene scene;
  scene.textures = {TwoTexels("normals", {128, 128, 255, 255}, {128, 128, 255, 255}),
                    TwoTexels("bricks", {0, 100, 255, 255}, {255, 200, 255, 255}),
                    TwoTexels("glow", {9, 9, 9, 255}, {9, 9, 9, 255}),
                    TwoTexels("roughness", {0, 50, 200, 255}, {0, 60, 210, 255}),
                    TwoTexels("pickets", {40, 40, 40, 0}, {40, 40, 40, 255})};
  scene.textures[0].is_srgb = false;
  scene.textures[3].is_srgb = false;
  scene.materials.resize(3);
  Material& shiny = scene.materials[kShiny];
  shiny.base_color = Rgb(0.5F, 0.5F, 0.25F);
  shiny.base_color_texture_idx = 1;
  shiny.metallic = 0.7F;
  shiny.roughness = 0.2F;
  shiny.metallic_roughness_texture_idx = 3;
  shiny.normal_texture_idx = 0;
  shiny.normal_scale = 2.0F;
  shiny.emission = Rgb(3.0F, 2.0F, 1.0F);
  shiny.emission_texture_idx = 2;
  shiny.ior = 1.6F;
  Material& fence = scene.materials[kFence];
  fence.base_color = Rgb::Ones();
  fence.base_color_texture_idx = 4;
  fence.alpha_cutoff = 0.3F;
  fence.base_alpha = 0.9F;
  scene.materials[kPlain].base_color = Rgb(0.1F, 0.2F, 0.3F);
  Mesh mesh;
  mesh.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh};
  scene.sun = Sun{};
  return scene;
}

TEST(LambertianScene, KeepsOnlyTheBaseColour) {
  const Scene scene = LambertianScene(SceneOfAllMaterials());
  scene.Validate("scene");
  EXPECT_THAT(scene.materials,
              Each(AllOf(Field(&Material::ior, 1.0F),
                         Field(&Material::metallic, 0.0F),
                         Field(&Material::roughness, 1.0F),
                         Field(&Material::metallic_roughness_texture_idx, -1),
                         Field(&Material::normal_texture_idx, -1),
                         Field(&Material::normal_scale, 1.0F),
                         Field(&Material::emission_texture_idx, -1))));
  EXPECT_EQ(scene.materials[kShiny].emission.maxCoeff(), 0.0F);
  EXPECT_TRUE((scene.materials[kShiny].base_color == Rgb(0.5F, 0.5F, 0.25F)).all());
  EXPECT_EQ(scene.NumTriangles(), 1U);
  EXPECT_TRUE(scene.sun.has_value());
}

TEST(LambertianScene, DropsTheOtherTexturesAndRefersToTheRightOnes) {
  const Scene scene = LambertianScene(SceneOfAllMaterials());
  ASSERT_EQ(scene.textures.size(), 2U);
  const auto name_of_base_color = [&](int material_idx) {
    const Material& material = scene.materials[static_cast<size_t>(material_idx)];
    return scene.textures[static_cast<size_t>(material.base_color_texture_idx)].name;
  };
  EXPECT_EQ(name_of_base_color(kShiny), "bricks");
  EXPECT_EQ(name_of_base_color(kFence), "pickets");
  EXPECT_EQ(scene.materials[kPlain].base_color_texture_idx, -1);
  EXPECT_EQ(scene.textures[0].texels.At(1, 0, 1), 200);
}

TEST(LambertianScene, KeepsHoles) {
  const Scene scene = LambertianScene(SceneOfAllMaterials());
  EXPECT_EQ(scene.materials[kFence].alpha_cutoff, 0.3F);
  EXPECT_EQ(scene.materials[kFence].base_alpha, 0.9F);
  EXPECT_FALSE(scene.materials[kShiny].alpha_cutoff.has_value());
}

TEST(UntexturedScene, TakesTheMeanOfLinearValues) {
  const Scene scene = UntexturedScene(SceneOfAllMaterials());
  scene.Validate("scene");
  const Material& shiny = scene.materials[kShiny];
  EXPECT_EQ(shiny.base_color_texture_idx, -1);
  // Half black and half white is half of the light, not what the encoded value 127.5 would be.
  EXPECT_NEAR(shiny.base_color[0], 0.5 * 0.5, 1e-6);
  EXPECT_NEAR(shiny.base_color[1],
              0.5 * 0.5 * (LinearFromSrgb(100.0F / 255.0F) + LinearFromSrgb(200.0F / 255.0F)),
              1e-6);
  EXPECT_NEAR(shiny.base_color[2], 0.25, 1e-6);
  EXPECT_TRUE((scene.materials[kPlain].base_color == Rgb(0.1F, 0.2F, 0.3F)).all());
}

TEST(UntexturedScene, TakesLinearTexturesAsTheyAre) {
  Scene scene = SceneOfAllMaterials();
  scene.textures[1].is_srgb = false;
  const Scene plain = UntexturedScene(scene);
  EXPECT_NEAR(plain.materials[kShiny].base_color[1], 0.5 * 150.0 / 255.0, 1e-6);
}

TEST(UntexturedScene, KeepsHolesInOneColour) {
  const Scene scene = UntexturedScene(SceneOfAllMaterials());
  ASSERT_EQ(scene.textures.size(), 1U);
  const Texture& pickets = scene.textures[0];
  EXPECT_THAT(pickets.texels.Values(), testing::ElementsAre(255, 255, 255, 0, 255, 255, 255, 255));
  const Material& fence = scene.materials[kFence];
  EXPECT_EQ(fence.base_color_texture_idx, 0);
  EXPECT_EQ(fence.alpha_cutoff, 0.3F);
  EXPECT_NEAR(fence.base_color[0], LinearFromSrgb(40.0F / 255.0F), 1e-6);
}

}  // namespace
}  // namespace pfseq
