// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_reader.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "renderer/sequence/image_io.h"
#include "scenes/gltf/gltf_writer.h"
#include "tests/scenes/gltf/gltf_builder.h"
#include "tests/support/expect_error.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace pfseq {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

using Triangle = std::array<uint32_t, 3>;

std::string FaultOf(const GltfBuilder& builder) {
  return MessageOf<InputError>([&] { builder.Read(); });
}

/// The normal of a triangle by its winding.
Vec3f WindingNormal(const Mesh& mesh, size_t triangle_idx) {
  const Triangle& triangle = mesh.triangles[triangle_idx];
  const Vec3f& a = mesh.positions_m[triangle[0]];
  return (mesh.positions_m[triangle[1]] - a).cross(mesh.positions_m[triangle[2]] - a).normalized();
}

TEST(GltfReader, TurnsYUpIntoZUp) {
  const Scene scene = GltfBuilder().Read();
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_THAT(scene.meshes[0].positions_m,
              ElementsAre(Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 0, 1)));
  EXPECT_THAT(scene.meshes[0].triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(GltfReader, ReadsTheSameFromSeparateFiles) {
  const TempFolder folder;
  const Scene scene = ReadGltf(GltfBuilder().WriteSeparate(folder));
  EXPECT_EQ(scene.meshes[0].positions_m, GltfBuilder().Read().meshes[0].positions_m);
}

TEST(GltfReader, AppliesScaleThenRotationThenTranslation) {
  GltfBuilder builder;
  const double half = std::sqrt(0.5);
  // A quarter turn about Y takes X to -Z.
  builder.Node() = {{"mesh", 0},
                    {"translation", {10, 20, 30}},
                    {"rotation", {0, half, 0, half}},
                    {"scale", {2, 3, 4}}};
  const std::vector<Vec3f> positions_m = builder.Read().meshes[0].positions_m;
  // glTF: (1, 0, 0) -> (2, 0, 0) -> (0, 0, -2) -> (10, 20, 28), which is (10, -28, 20) in the
  // world.
  EXPECT_LT((positions_m[1] - Vec3f(10, -28, 20)).norm(), 1e-5F);
  EXPECT_LT((positions_m[2] - Vec3f(10, -30, 23)).norm(), 1e-5F);
}

TEST(GltfReader, ReadsMatricesByColumns) {
  GltfBuilder builder;
  builder.Node()["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1};
  EXPECT_EQ(builder.Read().meshes[0].positions_m[1], Vec3f(7, -7, 6));
}

TEST(GltfReader, MultipliesTransformsDownTheHierarchyInOrder) {
  GltfBuilder builder;
  builder.root["nodes"] = Json::parse(R"([
    {"name": "root", "scale": [2, 2, 2], "children": [2, 1]},
    {"name": "b", "mesh": 0, "translation": [0, 0, 1]},
    {"name": "a", "mesh": 0, "translation": [1, 0, 0], "children": [3]},
    {"name": "a.child", "mesh": 0, "translation": [0, 1, 0]}])");
  const Scene scene = builder.Read();
  ASSERT_EQ(scene.meshes.size(), 3U);
  EXPECT_EQ(scene.meshes[0].name, "a");
  EXPECT_EQ(scene.meshes[0].positions_m[0], Vec3f(2, 0, 0));
  EXPECT_EQ(scene.meshes[1].name, "a.child");
  EXPECT_EQ(scene.meshes[1].positions_m[0], Vec3f(2, 0, 2));
  EXPECT_EQ(scene.meshes[2].name, "b");
  EXPECT_EQ(scene.meshes[2].positions_m[0], Vec3f(0, -2, 0));
}

TEST(GltfReader, TakesTheDefaultSceneElseTheFirstElseAllRoots) {
  GltfBuilder builder;
  builder.root["nodes"] =
      Json::parse(R"([{"mesh": 0}, {"mesh": 0, "children": [2]}, {"mesh": 0}])");
  builder.root["scenes"] = Json::parse(R"([{"nodes": [0]}, {"nodes": [1]}])");
  builder.root["scene"] = 1;
  EXPECT_EQ(builder.Read().meshes.size(), 2U);
  builder.root.erase("scene");
  EXPECT_EQ(builder.Read().meshes.size(), 1U);
  builder.root.erase("scenes");
  EXPECT_EQ(builder.Read().meshes.size(), 3U);
}

TEST(GltfReader, FollowsIndices) {
  GltfBuilder builder;
  builder.Primitive()["indices"] = builder.AddAccessor<uint8_t>({2, 0, 1, 0, 2, 1}, 5121, "SCALAR");
  EXPECT_THAT(builder.Read().meshes[0].triangles,
              ElementsAre(Triangle{2, 0, 1}, Triangle{0, 2, 1}));
}

TEST(GltfReader, WindsStripsAlternately) {
  GltfBuilder builder;
  builder.Primitive()["attributes"]["POSITION"] =
      builder.AddAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, 5126, "VEC3");
  builder.Primitive()["mode"] = 5;
  const Mesh mesh = builder.Read().meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 3U);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(WindingNormal(mesh, i), WindingNormal(mesh, 0)) << i;
  }
}

TEST(GltfReader, WindsFansAboutTheirFirstVertex) {
  GltfBuilder builder;
  builder.Primitive()["attributes"]["POSITION"] =
      builder.AddAccessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 5126, "VEC3");
  builder.Primitive()["mode"] = 6;
  const Mesh mesh = builder.Read().meshes[0];
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{1, 2, 0}, Triangle{2, 3, 0}));
  EXPECT_EQ(WindingNormal(mesh, 0), WindingNormal(mesh, 1));
}

TEST(GltfReader, LeavesPointsAndLinesOut) {
  for (int mode = 0; mode < 4; ++mode) {
    GltfBuilder builder;
    Json lines = builder.Primitive();
    lines["mode"] = mode;
    builder.root["meshes"][0]["primitives"].push_back(lines);
    EXPECT_EQ(builder.Read().meshes.size(), 1U) << mode;
    builder.Primitive()["mode"] = mode;
    EXPECT_THAT(FaultOf(builder), HasSubstr("holds no triangle"));
  }
}

TEST(GltfReader, MirroringTurnsTheWinding) {
  GltfBuilder builder;
  builder.Primitive()["attributes"]["NORMAL"] =
      builder.AddAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3");
  builder.Node()["scale"] = {-1, 1, 1};
  const Mesh mesh = builder.Read().meshes[0];
  EXPECT_LT((WindingNormal(mesh, 0) - mesh.normals[0]).norm(), 1e-6F);
  EXPECT_EQ(mesh.normals[0], Vec3f(0, -1, 0));
}

TEST(GltfReader, TurnsNormalsByTheInverseTranspose) {
  GltfBuilder builder;
  const float half = std::sqrt(0.5F);
  builder.Primitive()["attributes"]["NORMAL"] =
      builder.AddAccessor<float>({half, half, 0, half, half, 0, half, half, 0}, 5126, "VEC3");
  builder.Node()["scale"] = {2, 1, 1};
  // The plane x + y = c becomes x / 2 + y = c: its normal is (1, 2, 0) / sqrt 5, which is (1, 0, 2)
  // in the world.
  EXPECT_LT((builder.Read().meshes[0].normals[0] - Vec3f(1, 0, 2).normalized()).norm(), 1e-6F);
}

TEST(GltfReader, KeepsUnitNormalsBitForBitAndMendsOthers) {
  GltfBuilder builder;
  const Vec3f unit = Vec3f(0.1F, 0.7F, 0.3F).normalized();
  builder.Primitive()["attributes"]["NORMAL"] =
      builder.AddAccessor<float>({unit.x(), unit.y(), unit.z(), 0, 0, 5, 3, 0, 4}, 5126, "VEC3");
  const std::vector<Vec3f> normals = builder.Read().meshes[0].normals;
  EXPECT_EQ(normals[0], Vec3f(unit.x(), -unit.z(), unit.y()));
  EXPECT_EQ(normals[1], Vec3f(0, -1, 0));
  EXPECT_LT((normals[2] - Vec3f(0.6F, -0.8F, 0)).norm(), 1e-6F);
}

TEST(GltfReader, GivesUpNormalsWithoutDirection) {
  GltfBuilder builder;
  builder.Primitive()["attributes"]["NORMAL"] =
      builder.AddAccessor<float>({0, 0, 1, 0, 0, 0, 0, 0, 1}, 5126, "VEC3");
  EXPECT_TRUE(builder.Read().meshes[0].normals.empty());
}

TEST(GltfReader, ReadsTheTexcoordsThatTheMaterialAsksForAndTransformsThem) {
  GltfBuilder builder;
  builder.AddTexture(EncodePng(Image<uint8_t>(1, 1, 3)));
  builder.Primitive()["attributes"]["TEXCOORD_0"] =
      builder.AddAccessor<float>({9, 9, 9, 9, 9, 9}, 5126, "VEC2");
  builder.Primitive()["attributes"]["TEXCOORD_1"] =
      builder.AddAccessor<float>({0, 0, 1, 0, 0, 1}, 5126, "VEC2");
  builder.Material()["emissiveTexture"] = {
      {"index", 0},
      {"texCoord", 1},
      {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"scale", {2, 4}}}}}}};
  EXPECT_THAT(builder.Read().meshes[0].texcoords,
              ElementsAre(Vec2f(0.5F, 0.25F), Vec2f(2.5F, 0.25F), Vec2f(0.5F, 4.25F)));
}

TEST(GltfReader, TakesTheFirstDirectionalLightForTheSun) {
  GltfBuilder builder;
  builder.root["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([
    {"type": "point", "intensity": 7}, {"type": "directional", "intensity": 2000}, {"type": "directional"}])");
  builder.root["nodes"] = Json::parse(R"([{"mesh": 0, "children": [1, 2, 3]},
    {"extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"extensions": {"KHR_lights_punctual": {"light": 1}}, "rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476]},
    {"extensions": {"KHR_lights_punctual": {"light": 2}}}])");
  const Scene scene = builder.Read();
  ASSERT_TRUE(scene.sun.has_value());
  EXPECT_LT((scene.sun->direction_to_sun - Vec3f(0, 0, 1)).norm(), 1e-7F);
  EXPECT_TRUE((scene.sun->irradiance == 2.0F).all());
}

TEST(GltfReader, TellsWhatIsWrongWithAPrimitive) {
  GltfBuilder too_large;
  too_large.Primitive()["indices"] = too_large.AddAccessor<uint16_t>({0, 1, 3}, 5123, "SCALAR");
  EXPECT_THAT(FaultOf(too_large),
              testing::EndsWith("meshes[0].primitives[0].indices: vertex 3 of 3"));

  GltfBuilder uneven;
  uneven.Primitive()["indices"] = uneven.AddAccessor<uint16_t>({0, 1, 2, 0}, 5123, "SCALAR");
  EXPECT_THAT(FaultOf(uneven), HasSubstr("4 corners of triangles, expected a multiple of 3"));

  GltfBuilder few_normals;
  few_normals.Primitive()["attributes"]["NORMAL"] =
      few_normals.AddAccessor<float>({0, 0, 1}, 5126, "VEC3");
  EXPECT_THAT(FaultOf(few_normals), HasSubstr("1 normals for 3 positions"));

  GltfBuilder few_texcoords;
  few_texcoords.Primitive()["attributes"]["TEXCOORD_0"] =
      few_texcoords.AddAccessor<float>({0, 0}, 5126, "VEC2");
  EXPECT_THAT(FaultOf(few_texcoords), HasSubstr("1 texture coordinates for 3 positions"));
}

TEST(GltfReader, TellsWhatIsWrongWithANode) {
  GltfBuilder rotation;
  rotation.Node()["rotation"] = {0, 0, 0, 0};
  EXPECT_THAT(FaultOf(rotation), HasSubstr("nodes[0] '': the rotation is not a quaternion"));

  GltfBuilder projective;
  projective.Node()["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_THAT(FaultOf(projective), HasSubstr("the matrix is not affine"));

  GltfBuilder far_away;
  far_away.root["nodes"] = Json::parse(
      R"([{"scale": [1e30, 1, 1], "children": [1]}, {"scale": [1e30, 1, 1], "mesh": 0}])");
  EXPECT_THAT(FaultOf(far_away), HasSubstr("beyond all bounds"));
}

TEST(GltfReader, RefusesAFileThatUnfoldsBeyondMemory) {
  GltfBuilder builder;
  builder.root["accessors"].push_back(
      {{"componentType", 5126}, {"type", "VEC3"}, {"count", 16777216}});
  const Json primitive = {{"attributes", {{"POSITION", 1}}}, {"mode", 5}};
  builder.root["meshes"][0]["primitives"] = std::vector<Json>(100, primitive);
  builder.root["nodes"] = std::vector<Json>(1000, Json{{"mesh", 0}});
  builder.root.erase("scene");
  builder.root.erase("scenes");
  EXPECT_THAT(FaultOf(builder), HasSubstr("more than 268435456 vertices"));
}

/// A document with textures, hierarchy, sun and sparse values, to be damaged.
std::string RichGlb() {
  GltfBuilder builder;
  builder.AddTexture(EncodePng(Image<uint8_t>(4, 4, 4, 200)));
  builder.Material() = Json::parse(
      R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "alphaMode": "MASK"})");
  builder.Primitive()["attributes"]["NORMAL"] =
      builder.AddAccessor<float>({0, 0, 1, 0, 1, 0, 1, 0, 0}, 5126, "VEC3");
  builder.Primitive()["attributes"]["TEXCOORD_0"] =
      builder.AddAccessor<float>({0, 0, 1, 0, 0, 1}, 5126, "VEC2");
  builder.Primitive()["indices"] =
      builder.AddAccessor<uint16_t>({0, 1, 2, 2, 1, 0}, 5123, "SCALAR");
  const std::vector<uint8_t> indices = {1};
  builder.root["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", builder.AddView(indices.data(), 1)}, {"componentType", 5121}}},
      {"values", {{"bufferView", 0}}}};
  builder.root["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::parse(R"([{"type": "directional"}])");
  builder.root["nodes"] =
      Json::parse(R"([{"mesh": 0, "children": [1], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 1,2,3,1]},
    {"extensions": {"KHR_lights_punctual": {"light": 0}}, "rotation": [0, 0, 0, 1], "children": [2]}, {"mesh": 0}])");
  return builder.Glb();
}

/// Reads damaged bytes: a valid scene or one line of InputError, never anything else.
void ReadDamaged(const TempFolder& folder, const std::string& bytes, size_t& num_scenes) {
  WriteFileAtomically(folder / "a.glb", bytes);
  try {
    const Scene scene = ReadGltf(folder / "a.glb");
    scene.Validate("damaged");
    ++num_scenes;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

TEST(GltfReader, SurvivesTruncationAnywhere) {
  const TempFolder folder;
  const std::string good = RichGlb();
  size_t num_scenes = 0;
  for (size_t size = 0; size < good.size(); size += 5) {
    ReadDamaged(folder, good.substr(0, size), num_scenes);
  }
  EXPECT_EQ(num_scenes, 0U);
}

TEST(GltfReader, SurvivesAnyDamage) {
  const TempFolder folder;
  const std::string good = RichGlb();
  RandomStream random({2026, 11});
  size_t num_scenes = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string bytes = good;
    const int num_flips = 1 + static_cast<int>(random.Uniform(0.0, 4.0));
    for (int i = 0; i < num_flips; ++i) {
      bytes[random.Bits() % bytes.size()] = static_cast<char>(random.Bits());
    }
    ReadDamaged(folder, bytes, num_scenes);
  }
  EXPECT_GT(num_scenes, 10U);
}

TEST(GltfReader, SurvivesAnyChangeOfADigit) {
  const TempFolder folder;
  const std::string good = RichGlb();
  size_t num_scenes = 0;
  for (size_t i = 20; i < good.size(); ++i) {
    for (const char digit : {'9', '-'}) {
      if (good[i] >= '0' && good[i] <= '9' && good[i] != digit) {
        std::string bytes = good;
        bytes[i] = digit;
        ReadDamaged(folder, bytes, num_scenes);
      }
    }
  }
  EXPECT_GT(num_scenes, 10U);
}

}  // namespace
}  // namespace pfseq
