// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_accessor.h"

#include "renderer/core/error.h"
#include "tests/scenes/gltf/gltf_builder.h"
#include "tests/support/expect_error.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

tinygltf::Model ModelOf(const GltfBuilder& builder) {
  const TempFolder folder;
  WriteFileAtomically(folder / "a.glb", builder.Glb());
  return ReadGltfDocument(folder / "a.glb");
}

std::vector<Vec3f> Vectors(const GltfBuilder& builder,
                           int accessor_idx,
                           VertexAttribute attribute) {
  return ReadVec3Accessor(ModelOf(builder), accessor_idx, attribute, "here");
}

std::vector<uint32_t> Indices(const GltfBuilder& builder, int accessor_idx) {
  return ReadIndexAccessor(ModelOf(builder), accessor_idx, "here");
}

TEST(GltfAccessor, ReadsFloats) {
  EXPECT_THAT(Vectors(GltfBuilder(), 0, VertexAttribute::kPosition),
              ElementsAre(Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)));
}

TEST(GltfAccessor, FollowsStrideAndOffset) {
  GltfBuilder builder;
  const int idx = builder.AddAccessor<float>({9, 9, 1, 2, 3, 9, 9, 9, 4, 5, 6, 9}, 5126, "VEC3");
  builder.root["bufferViews"][1]["byteStride"] = 24;
  builder.root["accessors"][1]["byteOffset"] = 8;
  builder.root["accessors"][1]["count"] = 2;
  EXPECT_THAT(Vectors(builder, idx, VertexAttribute::kPosition),
              ElementsAre(Vec3f(1, 2, 3), Vec3f(4, 5, 6)));
}

TEST(GltfAccessor, ReadsIndicesOfAllWidths) {
  GltfBuilder builder;
  const int bytes = builder.AddAccessor<uint8_t>({0, 200, 255}, 5121, "SCALAR");
  const int shorts = builder.AddAccessor<uint16_t>({0, 300, 65535}, 5123, "SCALAR");
  const int ints = builder.AddAccessor<uint32_t>({0, 70000, 4000000000U}, 5125, "SCALAR");
  EXPECT_THAT(Indices(builder, bytes), ElementsAre(0U, 200U, 255U));
  EXPECT_THAT(Indices(builder, shorts), ElementsAre(0U, 300U, 65535U));
  EXPECT_THAT(Indices(builder, ints), ElementsAre(0U, 70000U, 4000000000U));
}

TEST(GltfAccessor, RefusesOtherIndices) {
  GltfBuilder builder;
  const int floats = builder.AddAccessor<float>({0, 1, 2}, 5126, "SCALAR");
  const int shorts = builder.AddAccessor<int16_t>({0, 1, 2}, 5122, "SCALAR");
  const int pairs = builder.AddAccessor<uint16_t>({0, 1, 2, 3}, 5123, "VEC2");
  for (const int idx : {floats, shorts, pairs}) {
    EXPECT_THAT(MessageOf<InputError>([&] { Indices(builder, idx); }),
                EndsWith("expected unsigned integers as indices"));
  }
}

TEST(GltfAccessor, NormalisesIntegers) {
  GltfBuilder builder;
  builder.root["extensionsUsed"] = {"KHR_mesh_quantization"};
  const int bytes = builder.AddAccessor<int8_t>({127, -127, -128, 0, 64, 1}, 5120, "VEC3");
  const int shorts = builder.AddAccessor<int16_t>({32767, -32767, -32768}, 5122, "VEC3");
  const int unsigned_bytes = builder.AddAccessor<uint8_t>({0, 255}, 5121, "VEC2");
  const int unsigned_shorts = builder.AddAccessor<uint16_t>({0, 65535}, 5123, "VEC2");
  for (size_t i = 1; i <= 4; ++i) {
    builder.root["accessors"][i]["normalized"] = true;
  }
  EXPECT_THAT(Vectors(builder, bytes, VertexAttribute::kNormal),
              ElementsAre(Vec3f(1, -1, -1), Vec3f(0, 64.0F / 127.0F, 1.0F / 127.0F)));
  EXPECT_THAT(Vectors(builder, shorts, VertexAttribute::kNormal), ElementsAre(Vec3f(1, -1, -1)));
  const tinygltf::Model model = ModelOf(builder);
  for (const int idx : {unsigned_bytes, unsigned_shorts}) {
    EXPECT_THAT(ReadVec2Accessor(model, idx, VertexAttribute::kTexcoord, "here"),
                ElementsAre(Vec2f(0, 1)));
  }
}

TEST(GltfAccessor, QuantisedPositionsNeedTheExtension) {
  GltfBuilder builder;
  const int idx = builder.AddAccessor<int16_t>({-300, 0, 300}, 5122, "VEC3");
  EXPECT_THAT(MessageOf<InputError>([&] { Vectors(builder, idx, VertexAttribute::kPosition); }),
              EndsWith("has 3 components of type 5122, which this attribute must not have"));
  builder.root["extensionsUsed"] = {"KHR_mesh_quantization"};
  EXPECT_THAT(Vectors(builder, idx, VertexAttribute::kPosition), ElementsAre(Vec3f(-300, 0, 300)));
}

TEST(GltfAccessor, RefusesTypesThatDoNotFit) {
  GltfBuilder builder;
  builder.root["extensionsUsed"] = {"KHR_mesh_quantization"};
  const int ints = builder.AddAccessor<uint32_t>({1, 2, 3}, 5125, "VEC3");
  const int pairs = builder.AddAccessor<float>({1, 2}, 5126, "VEC2");
  const int plain_bytes = builder.AddAccessor<int8_t>({1, 2, 3}, 5120, "VEC3");
  EXPECT_THAT(MessageOf<InputError>([&] { Vectors(builder, ints, VertexAttribute::kPosition); }),
              HasSubstr("3 components of type 5125"));
  EXPECT_THAT(MessageOf<InputError>([&] { Vectors(builder, pairs, VertexAttribute::kPosition); }),
              HasSubstr("2 components of type 5126"));
  EXPECT_THAT(
      MessageOf<InputError>([&] { Vectors(builder, plain_bytes, VertexAttribute::kNormal); }),
      HasSubstr("3 components of type 5120"));
}

TEST(GltfAccessor, RefusesWhatIsNotFinite) {
  for (const float bad : {std::numeric_limits<float>::infinity(), std::nanf("")}) {
    GltfBuilder builder;
    const int idx = builder.AddAccessor<float>({1, 2, 3, 4, bad, 6}, 5126, "VEC3");
    EXPECT_EQ(MessageOf<InputError>([&] { Vectors(builder, idx, VertexAttribute::kPosition); }),
              "here: element 1 of accessors[1] is not finite");
  }
}

TEST(GltfAccessor, ReplacesSparseElements) {
  GltfBuilder builder;
  const std::vector<uint16_t> indices = {0, 2};
  const std::vector<float> values = {7, 8, 9, 4, 5, 6};
  const int index_view = builder.AddView(indices.data(), 4);
  const int value_view = builder.AddView(values.data(), 24);
  const nlohmann::json sparse = {{"count", 2},
                                 {"indices", {{"bufferView", index_view}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", value_view}}}};
  builder.root["accessors"][0]["sparse"] = sparse;
  builder.root["accessors"].push_back(
      {{"componentType", 5126}, {"type", "VEC3"}, {"count", 3}, {"sparse", sparse}});
  EXPECT_THAT(Vectors(builder, 0, VertexAttribute::kPosition),
              ElementsAre(Vec3f(7, 8, 9), Vec3f(1, 0, 0), Vec3f(4, 5, 6)));
  EXPECT_THAT(Vectors(builder, 1, VertexAttribute::kPosition),
              ElementsAre(Vec3f(7, 8, 9), Vec3f(0, 0, 0), Vec3f(4, 5, 6)));
}

TEST(GltfAccessor, RefusesSparseIndicesOutOfRange) {
  GltfBuilder builder;
  const std::vector<uint8_t> indices = {3};
  const int index_view = builder.AddView(indices.data(), 1);
  builder.root["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
      {"values", {{"bufferView", 0}}}};
  EXPECT_EQ(MessageOf<InputError>([&] { Vectors(builder, 0, VertexAttribute::kPosition); }),
            "here: sparse index 3, expected less than 3");
}

}  // namespace
}  // namespace pfseq
