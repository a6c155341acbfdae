// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_writer.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/random.h"
#include "scenes/gltf/gltf_reader.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

template <typename T>
std::vector<std::byte> BitsOf(const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

void ExpectSameMaterial(const Material& a, const Material& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_TRUE((a.base_color == b.base_color).all());
  EXPECT_EQ(a.base_color_texture_idx, b.base_color_texture_idx);
  EXPECT_EQ(a.metallic, b.metallic);
  EXPECT_EQ(a.roughness, b.roughness);
  EXPECT_EQ(a.metallic_roughness_texture_idx, b.metallic_roughness_texture_idx);
  EXPECT_EQ(a.normal_texture_idx, b.normal_texture_idx);
  EXPECT_EQ(a.normal_scale, b.normal_scale);
  EXPECT_TRUE((a.emission == b.emission).all())
      << a.emission.transpose() << " and " << b.emission.transpose();
  EXPECT_EQ(a.emission_texture_idx, b.emission_texture_idx);
  EXPECT_EQ(a.ior, b.ior);
  EXPECT_EQ(a.alpha_cutoff, b.alpha_cutoff);
  EXPECT_EQ(a.base_alpha, b.base_alpha);
}

/// In every bit.
void ExpectSameScene(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(a.meshes[i].name, b.meshes[i].name);
    EXPECT_TRUE(BitsOf(a.meshes[i].positions_m) == BitsOf(b.meshes[i].positions_m));
    EXPECT_TRUE(BitsOf(a.meshes[i].normals) == BitsOf(b.meshes[i].normals));
    EXPECT_TRUE(BitsOf(a.meshes[i].texcoords) == BitsOf(b.meshes[i].texcoords));
    EXPECT_EQ(a.meshes[i].triangles, b.meshes[i].triangles);
    EXPECT_EQ(a.meshes[i].material_idx, b.meshes[i].material_idx);
  }
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (size_t i = 0; i < a.materials.size(); ++i) {
    ExpectSameMaterial(a.materials[i], b.materials[i]);
  }
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (size_t i = 0; i < a.textures.size(); ++i) {
    EXPECT_EQ(a.textures[i].name, b.textures[i].name);
    EXPECT_TRUE(a.textures[i].texels == b.textures[i].texels);
    EXPECT_EQ(a.textures[i].is_srgb, b.textures[i].is_srgb) << i;
  }
  ASSERT_EQ(a.sun.has_value(), b.sun.has_value());
  if (a.sun) {
    EXPECT_EQ(a.sun->direction_to_sun, b.sun->direction_to_sun);
    EXPECT_TRUE((a.sun->irradiance == b.sun->irradiance).all());
  }
}

Texture RandomTexture(
    const std::string& name, int width_px, int height_px, bool is_srgb, RandomStream& random) {
  Texture texture{name, Image<uint8_t>(width_px, height_px, 4), is_srgb};
  for (uint8_t& value : texture.texels.Values()) {
    value = static_cast<uint8_t>(random.Bits());
  }
  return texture;
}

Mesh RandomMesh(const std::string& name, size_t num_vertices, RandomStream& random) {
  const auto number = [&] { return static_cast<float>(random.Uniform(-100.0, 100.0)); };
  Mesh mesh;
  mesh.name = name;
  for (size_t i = 0; i < num_vertices; ++i) {
    mesh.positions_m.emplace_back(number(), number(), number());
    mesh.normals.push_back(Vec3f(number(), number(), number()).normalized());
    mesh.texcoords.emplace_back(number(), number());
  }
  for (uint32_t i = 0; i + 2 < num_vertices; ++i) {
    mesh.triangles.push_back({i + 2, i, i + 1});
  }
  return mesh;
}

/// Materials whose numbers are easily lost on the way.
std::vector<Material> AwkwardMaterials() {
  std::vector<Material> materials(5);
  materials[0].name = "plain";
  materials[1].name = "odd \"quoted\" \\ \xc3\xa9";
  materials[1].base_color = Rgb(0.1F, 1.0F / 3.0F, std::numeric_limits<float>::denorm_min());
  materials[1].base_alpha = 0.123456789F;
  materials[1].alpha_cutoff = std::nextafter(0.5F, 1.0F);
  materials[1].metallic = std::nextafter(1.0F, 0.0F);
  materials[1].roughness = 0.1F;
  materials[2].emission = Rgb(12345.678F, 0.1F, 3.0F);
  materials[2].ior = 1.0F;
  materials[3].emission = Rgb(1e-20F, 3e-21F, 0.0F);
  materials[3].ior = 1.4999999F;
  materials[4].alpha_cutoff = 0.5F;
  materials[4].base_color = Rgb::Ones();
  materials[4].metallic = 1.0F;
  return materials;
}

Scene RichScene() {
  RandomStream random({7, 7});
  Scene scene;
  scene.materials = AwkwardMaterials();
  scene.textures = {RandomTexture("facade", 5, 3, true, random),
                    RandomTexture("roughness", 2, 2, false, random),
                    RandomTexture("", 1, 7, false, random),
                    RandomTexture("unused", 2, 1, true, random),
                    RandomTexture("unused data", 2, 1, false, random),
                    RandomTexture("both", 3, 3, true, random)};
  scene.materials[0].base_color_texture_idx = 0;
  scene.materials[0].metallic_roughness_texture_idx = 1;
  scene.materials[0].normal_texture_idx = 2;
  scene.materials[0].normal_scale = 0.7F;
  scene.materials[2].emission_texture_idx = 5;
  scene.materials[2].normal_texture_idx = 5;
  scene.meshes = {
      RandomMesh("street", 20, random), RandomMesh("", 3, random), RandomMesh("street", 4, random)};
  scene.meshes[0].positions_m[3] = Vec3f(-0.0F, 0.0F, -0.0F);
  scene.meshes[1].normals.clear();
  scene.meshes[1].material_idx = 3;
  scene.meshes[2].texcoords.clear();
  scene.meshes[2].material_idx = 1;
  scene.sun = Sun{Vec3f(0.31F, -0.52F, 0.79F).normalized(), Rgb(98.7F, 91.2F, 80.1F)};
  return scene;
}

Scene ReadBytes(const std::string& bytes) {
  const TempFolder folder;
  WriteFileAtomically(folder / "a.glb", bytes);
  return ReadGltf(folder / "a.glb");
}

nlohmann::json JsonOf(const std::string& glb) {
  uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, sizeof(length));
  return nlohmann::json::parse(glb.substr(20, length));
}

TEST(GltfWriter, WritesWhatIsReadAgainBitForBit) {
  const Scene scene = RichScene();
  ExpectSameScene(ReadBytes(GlbBytes(scene)), scene);
}

TEST(GltfWriter, WritesTheSameBytesAgain) {
  const std::string bytes = GlbBytes(RichScene());
  EXPECT_TRUE(GlbBytes(RichScene()) == bytes);
  EXPECT_TRUE(GlbBytes(ReadBytes(bytes)) == bytes);
}

TEST(GltfWriter, SeparateFilesHoldTheSameScene) {
  const TempFolder folder;
  // A name that must be escaped in a URI.
  const std::filesystem::path path = folder / "my 100% scene+1.gltf";
  WriteGltf(RichScene(), path);
  EXPECT_TRUE(std::filesystem::exists(folder / "my 100% scene+1.bin"));
  EXPECT_TRUE(std::filesystem::exists(folder / "my 100% scene+1_5.png"));
  ExpectSameScene(ReadGltf(path), RichScene());
}

TEST(GltfWriter, LeavesOutMeshesWithoutTriangles) {
  Scene scene = RichScene();
  scene.meshes[1].triangles.clear();
  const Scene again = ReadBytes(GlbBytes(scene));
  scene.meshes.erase(scene.meshes.begin() + 1);
  ExpectSameScene(again, scene);
}

TEST(GltfWriter, AlignsAllPartsAndTellsTheLengths) {
  const std::string glb = GlbBytes(RichScene());
  EXPECT_EQ(glb.size() % 4, 0U);
  std::array<uint32_t, 5> header{};
  std::memcpy(header.data(), glb.data(), sizeof(header));
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(header[1], 2U);
  EXPECT_EQ(header[2], glb.size());
  EXPECT_EQ(header[3] % 4, 0U);
  const nlohmann::json root = JsonOf(glb);
  for (const nlohmann::json& view : root["bufferViews"]) {
    EXPECT_EQ(view.value("byteOffset", 0) % 4, 0);
  }
}

TEST(GltfWriter, WritesTheBoundsOfPositionsInTheAxesOfGltf) {
  Scene scene;
  scene.materials.resize(1);
  Mesh mesh;
  mesh.positions_m = {{1, 2, 3}, {4, -5, 6}, {-7, 8, 9}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh};
  const nlohmann::json root = JsonOf(GlbBytes(scene));
  const nlohmann::json& accessor =
      root["accessors"][root["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<size_t>()];
  EXPECT_EQ(accessor["min"], nlohmann::json({-7.0, 3.0, -8.0}));
  EXPECT_EQ(accessor["max"], nlohmann::json({4.0, 9.0, 5.0}));
}

TEST(GltfWriter, TellsOthersThatAnIorOfOneMeansNoGloss) {
  Scene scene = RichScene();
  scene.materials.resize(2);
  scene.materials[0].ior = 1.0F;
  scene.materials[1].ior = 1.3F;
  for (Mesh& mesh : scene.meshes) {
    mesh.material_idx = 0;
  }
  const nlohmann::json root = JsonOf(GlbBytes(scene));
  const nlohmann::json& matt = root["materials"][0]["extensions"];
  EXPECT_EQ(matt["KHR_materials_specular"]["specularFactor"], 0.0);
  EXPECT_FALSE(root["materials"][1]["extensions"].contains("KHR_materials_specular"));
}

TEST(GltfWriter, NamesTheExtensionsThatItUses) {
  const nlohmann::json root = JsonOf(GlbBytes(RichScene()));
  EXPECT_THAT(root["extensionsUsed"].get<std::vector<std::string>>(),
              testing::UnorderedElementsAre("KHR_materials_ior",
                                            "KHR_materials_specular",
                                            "KHR_materials_emissive_strength",
                                            "KHR_lights_punctual"));
  EXPECT_FALSE(root.contains("extensionsRequired"));
  for (const nlohmann::json& material : root["materials"]) {
    for (const nlohmann::json& channel :
         material.value("emissiveFactor", nlohmann::json::array())) {
      EXPECT_LE(channel.get<double>(), 1.0);
    }
  }
}

TEST(GltfWriter, RefusesAnInvalidScene) {
  EXPECT_EQ(MessageOf<InputError>([] { GlbBytes(Scene{}); }), "scene: the scene holds no triangle");
}

TEST(GltfWriter, TellsWhenTheDiskRefuses) {
  EXPECT_THAT(MessageOf<SystemError>([] { WriteGltf(RichScene(), "/proc/none/scene.gltf"); }),
              testing::HasSubstr("/proc/none"));
}

}  // namespace
}  // namespace pfseq
