// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_material.h"

#include "renderer/core/error.h"
#include "renderer/sequence/image_io.h"
#include "tests/scenes/gltf/gltf_builder.h"
#include "tests/support/expect_error.h"

#include <numbers>
#include <string>

namespace pfseq {
namespace {

using Json = nlohmann::json;
using testing::EndsWith;
using testing::HasSubstr;

Bytes SmallPng() { return EncodePng(Image<uint8_t>(2, 1, 3, 99)); }

GltfMaterials MaterialsOf(const GltfBuilder& builder) {
  const TempFolder folder;
  WriteFileAtomically(folder / "a.glb", builder.Glb());
  return ReadGltfMaterials(ReadGltfDocument(folder / "a.glb"), "a.glb");
}

Material MaterialOf(const std::string& json) {
  GltfBuilder builder;
  builder.Material() = Json::parse(json);
  return MaterialsOf(builder).materials[0];
}

TEST(GltfMaterial, HasTheDefaultsOfTheSpecification) {
  const Material material = MaterialOf("{}");
  EXPECT_TRUE((material.base_color == 1.0F).all());
  EXPECT_EQ(material.metallic, 1.0F);
  EXPECT_EQ(material.roughness, 1.0F);
  EXPECT_TRUE((material.emission == 0.0F).all());
  EXPECT_EQ(material.ior, 1.5F);
  EXPECT_EQ(material.base_alpha, 1.0F);
  EXPECT_FALSE(material.alpha_cutoff.has_value());
}

TEST(GltfMaterial, ReadsAllFactors) {
  const Material material = MaterialOf(R"({"name": "tin",
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6},
    "emissiveFactor": [0.5, 0.25, 1], "alphaMode": "MASK", "alphaCutoff": 0.7,
    "extensions": {"KHR_materials_ior": {"ior": 1.33}, "KHR_materials_emissive_strength": {"emissiveStrength": 4}}})");
  EXPECT_EQ(material.name, "tin");
  EXPECT_TRUE((material.base_color == Rgb(0.1F, 0.2F, 0.3F)).all());
  EXPECT_EQ(material.base_alpha, 0.4F);
  EXPECT_EQ(material.metallic, 0.5F);
  EXPECT_EQ(material.roughness, 0.6F);
  EXPECT_TRUE((material.emission == Rgb(2.0F, 1.0F, 4.0F)).all());
  EXPECT_EQ(material.alpha_cutoff, 0.7F);
  EXPECT_EQ(material.ior, 1.33F);
}

TEST(GltfMaterial, TakesBlendForMaskAtOneHalf) {
  EXPECT_EQ(MaterialOf(R"({"alphaMode": "BLEND", "alphaCutoff": 0.1})").alpha_cutoff, 0.5F);
  EXPECT_EQ(MaterialOf(R"({"alphaMode": "MASK"})").alpha_cutoff, 0.5F);
}

TEST(GltfMaterial, ClampsMetallicAndRoughness) {
  const Material material =
      MaterialOf(R"({"pbrMetallicRoughness": {"metallicFactor": 1.5, "roughnessFactor": -0.4}})");
  EXPECT_EQ(material.metallic, 1.0F);
  EXPECT_EQ(material.roughness, 0.0F);
}

TEST(GltfMaterial, TakesUnlitForLambertian) {
  const Material material =
      MaterialOf(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 1]},
    "emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_unlit": {}}})");
  EXPECT_TRUE((material.base_color == Rgb(0.1F, 0.2F, 0.3F)).all());
  EXPECT_TRUE((material.emission == 0.0F).all());
  EXPECT_EQ(material.metallic, 0.0F);
  EXPECT_EQ(material.ior, 1.0F);
}

TEST(GltfMaterial, FindsEachTexture) {
  GltfBuilder builder;
  for (int i = 0; i < 4; ++i) {
    builder.AddTexture(SmallPng());
  }
  builder.Material() = Json::parse(R"({
    "pbrMetallicRoughness": {"baseColorTexture": {"index": 3}, "metallicRoughnessTexture": {"index": 1}},
    "normalTexture": {"index": 2, "scale": 0.5}, "emissiveTexture": {"index": 0}})");
  const GltfMaterials result = MaterialsOf(builder);
  const Material& material = result.materials[0];
  EXPECT_EQ(material.base_color_texture_idx, 3);
  EXPECT_EQ(material.metallic_roughness_texture_idx, 1);
  EXPECT_EQ(material.normal_texture_idx, 2);
  EXPECT_EQ(material.normal_scale, 0.5F);
  EXPECT_EQ(material.emission_texture_idx, 0);
  ASSERT_EQ(result.textures.size(), 4U);
  EXPECT_TRUE(result.textures[0].is_srgb);
  EXPECT_FALSE(result.textures[1].is_srgb);
  EXPECT_FALSE(result.textures[2].is_srgb);
  EXPECT_TRUE(result.textures[3].is_srgb);
  EXPECT_EQ(result.textures[3].texels.WidthPx(), 2);
  EXPECT_EQ(result.textures[3].texels.At(1, 0, 2), 99);
  EXPECT_EQ(result.textures[3].texels.At(1, 0, 3), 255);
}

TEST(GltfMaterial, TexturesOfOneImageAreOne) {
  GltfBuilder builder;
  builder.AddTexture(SmallPng());
  builder.root["textures"].push_back({{"source", 0}});
  builder.Material() = Json::parse(
      R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "emissiveTexture": {"index": 1}})");
  const GltfMaterials result = MaterialsOf(builder);
  EXPECT_EQ(result.textures.size(), 1U);
  EXPECT_EQ(result.materials[0].emission_texture_idx, 0);
}

TEST(GltfMaterial, AnImageUsedAsColourAndAsDataBecomesTwo) {
  GltfBuilder builder;
  builder.AddTexture(SmallPng());
  builder.Material() = Json::parse(
      R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}}})");
  const GltfMaterials result = MaterialsOf(builder);
  ASSERT_EQ(result.textures.size(), 2U);
  EXPECT_EQ(result.materials[0].base_color_texture_idx, 0);
  EXPECT_EQ(result.materials[0].metallic_roughness_texture_idx, 1);
  EXPECT_TRUE(result.textures[0].is_srgb);
  EXPECT_FALSE(result.textures[1].is_srgb);
}

TEST(GltfMaterial, AddsTheDefaultForPrimitivesWithoutMaterial) {
  const GltfMaterials result = MaterialsOf(GltfBuilder());
  ASSERT_EQ(result.materials.size(), 1U);
  EXPECT_EQ(result.default_material_idx, 0);
  EXPECT_TRUE((result.materials[0].base_color == 1.0F).all());
  GltfBuilder builder;
  builder.Material();
  EXPECT_EQ(MaterialsOf(builder).default_material_idx, -1);
}

TEST(GltfMaterial, RefusesADamagedImage) {
  GltfBuilder builder;
  Bytes png = SmallPng();
  png.resize(png.size() / 2);
  builder.AddTexture(png);
  EXPECT_THAT(MessageOf<InputError>([&] { MaterialsOf(builder); }), HasSubstr("a.glb: images[0]"));
}

TEST(GltfMaterial, LeavesImagesAloneThatNoTextureShows) {
  GltfBuilder builder;
  builder.AddTexture(SmallPng());
  builder.AddTexture({std::byte{1}, std::byte{2}});
  builder.root["textures"].erase(1);
  EXPECT_EQ(MaterialsOf(builder).textures.size(), 1U);
}

TEST(GltfMaterial, RefusesATextureWithoutImage) {
  GltfBuilder builder;
  builder.root["textures"] = {Json::object()};
  builder.Material() = Json::parse(R"({"name": "m", "emissiveTexture": {"index": 0}})");
  EXPECT_EQ(MessageOf<InputError>([&] { MaterialsOf(builder); }),
            "a.glb: materials[0] 'm': textures[0] has no image of a supported kind");
}

TEST(GltfMaterial, TransformsTexcoordsAsTheTestModelOfKhronosDoes) {
  // TextureTransformTest.gltf, panel "Rotation": what lies at (0.7778, 0.7778) in the texture is
  // seen, turned by 22.5 degrees, where the panel's own coordinates are (0.4210, 1.0163).
  GltfBuilder builder;
  builder.AddTexture(SmallPng());
  builder.Material() = Json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
    "extensions": {"KHR_texture_transform": {"rotation": 0.39269908169872414}}}}})");
  const TexcoordMapping rotation = MaterialsOf(builder).texcoords[0];
  const Vec2d texture = rotation.scale_rotation * Vec2d(0.42095, 1.01627) + rotation.offset;
  EXPECT_NEAR(texture.x(), 0.7778, 1e-4);
  EXPECT_NEAR(texture.y(), 0.7778, 1e-4);
}

TEST(GltfMaterial, ScalesThenRotatesThenShiftsTexcoords) {
  GltfBuilder builder;
  builder.AddTexture(SmallPng());
  builder.Material()["emissiveTexture"] = {{"index", 0},
                                           {"texCoord", 2},
                                           {"extensions",
                                            {{"KHR_texture_transform",
                                              {{"offset", {10, 20}},
                                               {"rotation", std::numbers::pi / 2},
                                               {"scale", {2, 3}},
                                               {"texCoord", 1}}}}}};
  const TexcoordMapping mapping = MaterialsOf(builder).texcoords[0];
  EXPECT_EQ(mapping.set, 1);
  // (1, 1) -> (2, 3) -> (3, -2) -> (13, 18)
  const Vec2d mapped = mapping.scale_rotation * Vec2d(1, 1) + mapping.offset;
  EXPECT_NEAR(mapped.x(), 13.0, 1e-12);
  EXPECT_NEAR(mapped.y(), 18.0, 1e-12);
}

TEST(GltfMaterial, RefusesTexturesWithDifferentTexcoords) {
  GltfBuilder builder;
  builder.AddTexture(SmallPng());
  builder.Material() = Json::parse(
      R"({"emissiveTexture": {"index": 0}, "normalTexture": {"index": 0, "texCoord": 1}})");
  EXPECT_THAT(MessageOf<InputError>([&] { MaterialsOf(builder); }),
              EndsWith("which is not supported"));
}

}  // namespace
}  // namespace pfseq
