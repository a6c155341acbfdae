// SPDX-License-Identifier: Apache-2.0
// glTF documents put together by hand, to be read, bent and broken.
#pragma once

#include "renderer/core/file.h"
#include "renderer/trace/scene.h"
#include "scenes/gltf/gltf_reader.h"
#include "tests/support/temp_folder.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace pfseq {

/// A document and its binary buffer. It begins with one triangle: (0, 0, 0), (1, 0, 0), (0, 1, 0)
/// in the axes of glTF, accessor 0 of meshes[0].primitives[0] at nodes[0].
struct GltfBuilder {
  using Json = nlohmann::json;

  Json root = Json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})");
  std::string bin;

  GltfBuilder() { AddAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3"); }

  Json& Primitive() { return root["meshes"][0]["primitives"][0]; }
  Json& Node() { return root["nodes"][0]; }
  /// materials[0], made and used by the triangle when it is first asked for.
  Json& Material() {
    if (!root.contains("materials")) {
      root["materials"] = Json::array({Json::object()});
      Primitive()["material"] = 0;
    }
    return root["materials"][0];
  }

  int AddView(const void* bytes, size_t size) {
    bin.resize((bin.size() + 3) / 4 * 4);
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", size}});
    bin.append(static_cast<const char*>(bytes), size);
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }

  /// Tightly packed values; returns the accessor's index.
  template <typename T>
  int AddAccessor(const std::vector<T>& values, int component_type, const std::string& type) {
    const int view = AddView(values.data(), values.size() * sizeof(T));
    const size_t num_components = type == "SCALAR" ? 1 : static_cast<size_t>(type[3] - '0');
    root["accessors"].push_back({{"bufferView", view},
                                 {"componentType", component_type},
                                 {"type", type},
                                 {"count", values.size() / num_components}});
    return static_cast<int>(root["accessors"].size()) - 1;
  }

  /// An image inside the file and a texture of it; returns the texture's index.
  int AddTexture(const std::vector<std::byte>& png) {
    const int view = AddView(png.data(), png.size());
    root["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
    root["textures"].push_back({{"source", root["images"].size() - 1}});
    return static_cast<int>(root["textures"].size()) - 1;
  }

  std::string Glb() const {
    Json document = root;
    if (!bin.empty() && !document.contains("buffers")) {
      document["buffers"] = Json::array({{{"byteLength", bin.size()}}});
    }
    std::string json = document.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string padded = bin;
    padded.resize((padded.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    for (const size_t word : {size_t{2}, 28 + json.size() + padded.size(), json.size()}) {
      AppendWord(word, bytes);
    }
    bytes += "JSON" + json;
    AppendWord(padded.size(), bytes);
    return bytes + std::string("BIN\0", 4) + padded;
  }

  /// As a .gltf file with scene.bin beside it.
  std::filesystem::path WriteSeparate(const TempFolder& folder) const {
    Json document = root;
    document["buffers"] = Json::array({{{"byteLength", bin.size()}, {"uri", "scene.bin"}}});
    WriteFileAtomically(folder / "scene.bin", bin);
    WriteFileAtomically(folder / "scene.gltf", document.dump());
    return folder / "scene.gltf";
  }

  /// What ReadGltf makes of it.
  Scene Read() const {
    const TempFolder folder;
    WriteFileAtomically(folder / "scene.glb", Glb());
    return ReadGltf(folder / "scene.glb");
  }

 private:
  static void AppendWord(size_t value, std::string& bytes) {
    const auto word = static_cast<uint32_t>(value);
    bytes.append(reinterpret_cast<const char*>(&word), sizeof(word));
  }
};

}  // namespace pfseq
