// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_schema.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <algorithm>
#include <cctype>
#include <ostream>
#include <string>

#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

using Json = nlohmann::json;

/// A document with one of everything that is checked.
Json FullDocument() {
  return Json::parse(R"({
    "asset": {"version": "2.0"},
    "extensionsRequired": ["KHR_texture_transform"],
    "buffers": [{"byteLength": 120}],
    "bufferViews": [{"buffer": 0, "byteLength": 72, "byteStride": 12}, {"buffer": 0, "byteOffset": 72, "byteLength": 48}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 6},
      {"bufferView": 1, "byteOffset": 4, "componentType": 5123, "type": "SCALAR", "count": 6},
      {"componentType": 5126, "type": "VEC3", "count": 3, "sparse": {"count": 1,
        "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 1, "byteOffset": 4}}}],
    "images": [{"uri": "a.png"}, {"bufferView": 1, "mimeType": "image/png"}],
    "textures": [{"source": 0}, {}],
    "materials": [{
      "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "baseColorTexture": {"index": 0, "extensions": {
        "KHR_texture_transform": {"offset": [0, 1], "scale": [2, 2], "rotation": 0.1, "texCoord": 1}}}},
      "normalTexture": {"index": 1, "scale": 0.5}, "emissiveFactor": [0, 0, 0], "alphaMode": "MASK", "alphaCutoff": 0.3,
      "extensions": {"KHR_materials_ior": {"ior": 1.4}, "KHR_materials_emissive_strength": {"emissiveStrength": 2.0}}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "mode": 4}]}],
    "nodes": [{"mesh": 0, "children": [1, 2]}, {"translation": [1, 2, 3], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]},
      {"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "color": [1, 1, 1], "intensity": 3}]}},
    "scenes": [{"nodes": [0]}],
    "scene": 0})");
}

TEST(GltfSchema, AcceptsADocumentWithOneOfEverything) {
  EXPECT_NO_THROW(CheckGltfJson(FullDocument(), true, "a.glb"));
}

TEST(GltfSchema, AcceptsAViewThatEndsWithItsLastElement) {
  Json root = FullDocument();
  // Five strides and one element: the padding behind the last element need not be there.
  root["bufferViews"][0] = Json::parse(R"({"buffer": 0, "byteLength": 92, "byteStride": 16})");
  EXPECT_NO_THROW(CheckGltfJson(root, true, "a.glb"));
  root["bufferViews"][0]["byteLength"] = 91U;
  EXPECT_EQ(MessageOf<InputError>([&] { CheckGltfJson(root, true, "a.glb"); }),
            "a.glb: accessors[0]: 6 elements of 12 bytes from byte 0 on exceed bufferViews[0], "
            "which has 91 bytes");
}

TEST(GltfSchema, AFileOfItsOwnNeedsAUriForEachBuffer) {
  EXPECT_EQ(MessageOf<InputError>([] { CheckGltfJson(FullDocument(), false, "a.gltf"); }),
            "a.gltf: buffers[0]: 'uri' is missing");
}

TEST(GltfSchema, KnowsTheSizesOfComponents) {
  EXPECT_EQ(ComponentSizeBytes(5120), 1U);
  EXPECT_EQ(ComponentSizeBytes(5121), 1U);
  EXPECT_EQ(ComponentSizeBytes(5122), 2U);
  EXPECT_EQ(ComponentSizeBytes(5123), 2U);
  EXPECT_EQ(ComponentSizeBytes(5124), 0U);
  EXPECT_EQ(ComponentSizeBytes(5125), 4U);
  EXPECT_EQ(ComponentSizeBytes(5126), 4U);
}

/// One value of the document replaced, and the fault that must be told.
struct Break {
  const char* pointer;
  const char* value;
  const char* fault;

  friend void PrintTo(const Break& broken, std::ostream* out) {
    *out << broken.pointer << " = " << broken.value;
  }
};

class GltfSchemaBreakTest : public testing::TestWithParam<Break> {};

TEST_P(GltfSchemaBreakTest, IsToldWithItsPlace) {
  Json root = FullDocument();
  root[Json::json_pointer(GetParam().pointer)] = Json::parse(GetParam().value);
  EXPECT_EQ(MessageOf<InputError>([&] { CheckGltfJson(root, true, "a.glb"); }),
            std::string("a.glb: ") + GetParam().fault);
}

constexpr Break kBreaks[] = {
    {"/asset", "{}", "asset: 'version' is missing"},
    {"/asset/version", "\"1.0\"", "asset: glTF version 1.0, expected 2.0"},
    {"/asset/minVersion", "\"2.1\"", "asset: glTF version 2.1, expected 2.0"},
    {"/extensionsRequired/0",
     "\"KHR_draco_mesh_compression\"",
     "extensionsRequired: KHR_draco_mesh_compression is not supported"},
    {"/buffers", "{}", "buffers: expected an array, got object"},
    {"/buffers/0", "3", "buffers[0]: expected an object, got 3"},
    {"/buffers/0/byteLength",
     "0",
     "buffers[0].byteLength: expected an integer from 1 to 281474976710656, got 0"},
    {"/buffers/0/uri", "\"\"", "buffers[0].uri: is not a file name"},
    {"/buffers/0/uri",
     "\"data:text/html,x\"",
     "buffers[0].uri: only base64 data is supported, got 'data:text/html,x'"},
    {"/bufferViews/0/buffer",
     "1",
     "bufferViews[0].buffer: 1, expected less than 1 (the number of buffers)"},
    {"/bufferViews/1/byteOffset",
     "73",
     "bufferViews[1]: ends at byte 121 of buffers[0], which has 120"},
    {"/bufferViews/1/byteOffset",
     "-4",
     "bufferViews[1].byteOffset: expected an integer from 0 to 281474976710656, got -4"},
    {"/bufferViews/0/byteStride", "14", "bufferViews[0].byteStride: 14 is not a multiple of 4"},
    {"/bufferViews/0/byteStride", "8", "accessors[0]: elements of 12 bytes in a view of stride 8"},
    {"/accessors/0/bufferView",
     "2",
     "accessors[0].bufferView: 2, expected less than 2 (the number of bufferViews)"},
    {"/accessors/0/count",
     "7",
     "accessors[0]: 7 elements of 12 bytes from byte 0 on exceed bufferViews[0], which has 72 "
     "bytes"},
    {"/accessors/0/count",
     "281474976710656",
     "accessors[0]: 281474976710656 elements of 12 bytes from byte 0 on exceed bufferViews[0], "
     "which has 72 bytes"},
    {"/accessors/0/byteOffset",
     "1",
     "accessors[0]: 6 elements of 12 bytes from byte 1 on exceed bufferViews[0], which has 72 "
     "bytes"},
    {"/accessors/0/componentType",
     "5130",
     "accessors[0].componentType: 5130 is not a component type"},
    {"/accessors/0/type", "\"VEC5\"", "accessors[0].type: 'VEC5' is not an accessor type"},
    {"/accessors/0/type", "\"MAT4\"", "accessors[0]: elements of 64 bytes in a view of stride 12"},
    {"/accessors/2/count",
     "100000000000",
     "accessors[2].count: expected an integer from 1 to 16777216, got 100000000000"},
    {"/accessors/2/sparse/count",
     "4",
     "accessors[2].sparse.count: expected an integer from 1 to 3, got 4"},
    {"/accessors/2/sparse/indices/byteOffset",
     "48",
     "accessors[2].sparse.indices: 1 elements of 1 bytes from byte 48 on exceed bufferViews[1], "
     "which has 48 bytes"},
    {"/accessors/2/sparse/values/bufferView",
     "9",
     "accessors[2].sparse.values.bufferView: 9, expected less than 2 (the number of bufferViews)"},
    {"/images/1/uri", "\"b.png\"", "images[1]: expected either 'uri' or 'bufferView'"},
    {"/images/0", "{}", "images[0]: expected either 'uri' or 'bufferView'"},
    {"/textures/0/source",
     "2",
     "textures[0].source: 2, expected less than 2 (the number of images)"},
    {"/textures/0/name", "42", "textures[0].name: expected a string, got 42"},
    {"/materials/0/normalTexture/index",
     "2",
     "materials[0].normalTexture.index: 2, expected less than 2 (the number of textures)"},
    {"/materials/0/pbrMetallicRoughness",
     "[]",
     "materials[0].pbrMetallicRoughness: expected an object, got array"},
    {"/materials/0/pbrMetallicRoughness/baseColorFactor",
     "[1, 1, 1]",
     "materials[0].pbrMetallicRoughness.baseColorFactor: 3 numbers, expected 4"},
    {"/materials/0/pbrMetallicRoughness/metallicFactor",
     "\"full\"",
     "materials[0].pbrMetallicRoughness.metallicFactor: expected a number, got string"},
    {"/materials/0/emissiveFactor/1", "-0.5", "materials[0].emissiveFactor: -0.5 is out of range"},
    {"/materials/0/alphaMode",
     "\"GLASS\"",
     "materials[0].alphaMode: expected OPAQUE, MASK or BLEND, got 'GLASS'"},
    {"/materials/0/extensions/KHR_materials_ior/ior",
     "1e40",
     "materials[0].extensions.KHR_materials_ior.ior: 1e+40 is out of range"},
    {"/meshes/0/primitives", "{}", "meshes[0].primitives: expected an array, got object"},
    {"/meshes/0/primitives/0/attributes",
     "{}",
     "meshes[0].primitives[0].attributes: 'POSITION' is missing"},
    {"/meshes/0/primitives/0/attributes/NORMAL",
     "3",
     "meshes[0].primitives[0].attributes.NORMAL: 3, expected less than 3 (the number of "
     "accessors)"},
    {"/meshes/0/primitives/0/indices",
     "-1",
     "meshes[0].primitives[0].indices: expected an index into accessors, got -1"},
    {"/meshes/0/primitives/0/material",
     "1",
     "meshes[0].primitives[0].material: 1, expected less than 1 (the number of materials)"},
    {"/meshes/0/primitives/0/mode",
     "7",
     "meshes[0].primitives[0].mode: expected an integer from 0 to 6, got 7"},
    {"/nodes/0/mesh", "1", "nodes[0].mesh: 1, expected less than 1 (the number of meshes)"},
    {"/nodes/1/matrix",
     "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]",
     "nodes[1]: has both a matrix and a translation, rotation or scale"},
    {"/nodes/2/matrix", "[1,0,0,0]", "nodes[2].matrix: 4 numbers, expected 16"},
    {"/nodes/0/children/0",
     "3",
     "nodes[0].children[0]: 3, expected less than 3 (the number of nodes)"},
    {"/nodes/1/children", "[2]", "nodes[2]: is a child of nodes[0] and of nodes[1]"},
    {"/nodes/2/children", "[0]", "nodes[2]: is its own ancestor"},
    {"/nodes/0/children", "[0]", "nodes[0]: is its own ancestor"},
    {"/nodes/2/extensions/KHR_lights_punctual/light",
     "1",
     "nodes[2].extensions.KHR_lights_punctual.light: 1, expected less than 1 (the number of "
     "lights)"},
    {"/scenes/0/nodes", "[0, 0]", "scenes[0].nodes[1]: nodes[0] is listed twice"},
    {"/scenes/0/nodes", "[1]", "scenes[0].nodes[0]: nodes[1] is not a root node"},
    {"/scene", "1", "scene: 1, expected less than 1 (the number of scenes)"},
    {"/scene", "\"first\"", "scene: expected an index into scenes, got string"},
};

std::string NameOf(const testing::TestParamInfo<Break>& test) {
  std::string name = std::to_string(test.index) + test.param.pointer;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, GltfSchemaBreakTest, testing::ValuesIn(kBreaks), &NameOf);

}  // namespace
}  // namespace pfseq
