// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_schema.h"

#include "scenes/gltf/gltf_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

using Json = nlohmann::json;

/// The extensions that a file may require.
constexpr std::array<std::string_view, 6> kSupportedExtensions = {"KHR_lights_punctual",
                                                                  "KHR_materials_emissive_strength",
                                                                  "KHR_materials_ior",
                                                                  "KHR_materials_unlit",
                                                                  "KHR_mesh_quantization",
                                                                  "KHR_texture_transform"};

constexpr uint64_t kMaxInt = std::numeric_limits<int>::max();
/// Sums of a few sizes and products of a size and a stride stay within 64 bits.
constexpr uint64_t kMaxSize = uint64_t{1} << 48;
/// An accessor without a view is all zeros (but for sparse values): its size costs no byte of the
/// file, so it is bounded.
constexpr uint64_t kMaxZeros = uint64_t{1} << 24;

class Checker : private JsonChecker {
 public:
  Checker(const Json& root, bool is_glb, const std::string& origin)
      : JsonChecker(root, origin), root_(root), is_glb_(is_glb) {}

  void Run() {
    CheckAsset();
    CheckExtensionsRequired();
    CheckEach("buffers", [this](const JsonPlace& place, size_t i) { CheckBuffer(place, i); });
    CheckEach("bufferViews", [this](const JsonPlace& place, size_t) { CheckBufferView(place); });
    CheckEach("accessors", [this](const JsonPlace& place, size_t) { CheckAccessor(place); });
    CheckEach("images", [this](const JsonPlace& place, size_t) { CheckImage(place); });
    CheckEach("textures",
              [this](const JsonPlace& place, size_t) { Index(place, "source", "images"); });
    CheckEach("materials", [this](const JsonPlace& place, size_t) { CheckMaterial(place); });
    CheckEach("meshes", [this](const JsonPlace& place, size_t) { CheckMesh(place); });
    CheckLights();
    CheckEach("nodes", [this](const JsonPlace& place, size_t) { CheckNode(place); });
    CheckTree();
    CheckEach("scenes", [this](const JsonPlace& place, size_t) { CheckScene(place); });
    Index(Document(), "scene", "scenes");
  }

 private:
  /// Calls check(place, index) for each entry of an array of the document.
  template <typename Check>
  void CheckEach(const char* array, const Check& check) const {
    ForEach(Document(), array, [&](const JsonPlace& place, size_t i) {
      String(place, "name");
      check(place, i);
    });
  }

  void CheckAsset() const {
    const std::optional<JsonPlace> asset = Object(Document(), "asset", true);
    const std::string& version = *String(*asset, "version", true);
    const std::string* min_version = String(*asset, "minVersion");
    if (!version.starts_with("2.") || (min_version != nullptr && *min_version != "2.0")) {
      Fail("asset",
           fmt::format("glTF version {:.20}, expected 2.0",
                       min_version != nullptr ? *min_version : version));
    }
  }

  void CheckExtensionsRequired() const {
    const Json* names = Array(Document(), "extensionsRequired");
    for (size_t i = 0; names != nullptr && i < names->size(); ++i) {
      const std::string name =
          (*names)[i].is_string() ? (*names)[i].get<std::string>() : (*names)[i].dump();
      if (std::ranges::find(kSupportedExtensions, name) == kSupportedExtensions.end()) {
        Fail("extensionsRequired", fmt::format("{:.100} is not supported", name));
      }
    }
  }

  void CheckUri(const JsonPlace& place, const std::string& uri) const {
    if (uri.empty() || uri.find('\0') != std::string::npos) {
      Fail(place.path + ".uri", "is not a file name");
    }
    if (uri.starts_with("data:") && uri.substr(0, 100).find(";base64,") == std::string::npos) {
      Fail(place.path + ".uri", fmt::format("only base64 data is supported, got '{:.40}'", uri));
    }
  }

  void CheckBuffer(const JsonPlace& place, size_t idx) const {
    Unsigned(place, "byteLength", 1, kMaxSize, true);
    const std::string* uri = String(place, "uri");
    if (uri != nullptr) {
      CheckUri(place, *uri);
    } else if (idx != 0 || !is_glb_) {
      Fail(place.path, "'uri' is missing");
    }
  }

  void CheckBufferView(const JsonPlace& place) const {
    const size_t buffer_idx = *Index(place, "buffer", "buffers", true);
    const uint64_t offset = Unsigned(place, "byteOffset", 0, kMaxSize).value_or(0);
    const uint64_t length = *Unsigned(place, "byteLength", 1, kMaxSize, true);
    const std::optional<uint64_t> stride = Unsigned(place, "byteStride", 4, 252);
    if (stride && *stride % 4 != 0) {
      Fail(place.path + ".byteStride", fmt::format("{} is not a multiple of 4", *stride));
    }
    const uint64_t buffer_length = root_["buffers"][buffer_idx]["byteLength"].get<uint64_t>();
    if (offset + length > buffer_length) {
      Fail(place.path,
           fmt::format("ends at byte {} of buffers[{}], which has {}",
                       offset + length,
                       buffer_idx,
                       buffer_length));
    }
  }

  /// That `count` elements from `offset` on lie within a view.
  void CheckExtent(const JsonPlace& place,
                   size_t view_idx,
                   uint64_t offset,
                   uint64_t count,
                   uint64_t element_size) const {
    const Json& view = root_["bufferViews"][view_idx];
    const uint64_t stride = view.value("byteStride", element_size);
    const uint64_t length = view["byteLength"].get<uint64_t>();
    if (stride < element_size) {
      Fail(place.path,
           fmt::format("elements of {} bytes in a view of stride {}", element_size, stride));
    }
    if (count > length || offset > length ||
        offset + (count - 1) * stride + element_size > length) {
      Fail(place.path,
           fmt::format(
               "{} elements of {} bytes from byte {} on exceed bufferViews[{}], which has {} bytes",
               count,
               element_size,
               offset,
               view_idx,
               length));
    }
  }

  size_t ComponentSize(const JsonPlace& place) const {
    const int type = static_cast<int>(*Unsigned(place, "componentType", 0, kMaxInt, true));
    const size_t size = ComponentSizeBytes(type);
    if (size == 0) {
      Fail(place.path + ".componentType", fmt::format("{} is not a component type", type));
    }
    return size;
  }

  size_t ElementSize(const JsonPlace& place) const {
    const size_t component_size = ComponentSize(place);
    const std::string& type = *String(place, "type", true);
    // Columns of matrices begin at multiples of four bytes (glTF 2.0, section 3.6.2.4).
    const auto column_size = [&](size_t rows) { return (rows * component_size + 3) / 4 * 4; };
    const std::array<std::pair<std::string_view, size_t>, 7> sizes = {
        {{"SCALAR", component_size},
         {"VEC2", 2 * component_size},
         {"VEC3", 3 * component_size},
         {"VEC4", 4 * component_size},
         {"MAT2", 2 * column_size(2)},
         {"MAT3", 3 * column_size(3)},
         {"MAT4", 4 * column_size(4)}}};
    const auto* const found =
        std::ranges::find(sizes, type, [](const auto& entry) { return entry.first; });
    if (found == sizes.end()) {
      Fail(place.path + ".type", fmt::format("'{:.20}' is not an accessor type", type));
    }
    return found->second;
  }

  void CheckAccessor(const JsonPlace& place) const {
    const size_t element_size = ElementSize(place);
    const uint64_t offset = Unsigned(place, "byteOffset", 0, kMaxSize).value_or(0);
    const std::optional<size_t> view_idx = Index(place, "bufferView", "bufferViews");
    const uint64_t count = *Unsigned(place, "count", 1, view_idx ? kMaxSize : kMaxZeros, true);
    Boolean(place, "normalized");
    if (view_idx) {
      CheckExtent(place, *view_idx, offset, count, element_size);
    }
    const std::optional<JsonPlace> sparse = Object(place, "sparse");
    if (!sparse) {
      return;
    }
    const uint64_t num_sparse = *Unsigned(*sparse, "count", 1, std::min(count, kMaxInt), true);
    const JsonPlace indices = *Object(*sparse, "indices", true);
    const JsonPlace values = *Object(*sparse, "values", true);
    CheckExtent(indices,
                *Index(indices, "bufferView", "bufferViews", true),
                Unsigned(indices, "byteOffset", 0, kMaxInt).value_or(0),
                num_sparse,
                ComponentSize(indices));
    CheckExtent(values,
                *Index(values, "bufferView", "bufferViews", true),
                Unsigned(values, "byteOffset", 0, kMaxInt).value_or(0),
                num_sparse,
                element_size);
  }

  void CheckImage(const JsonPlace& place) const {
    const std::string* uri = String(place, "uri");
    const std::optional<size_t> view_idx = Index(place, "bufferView", "bufferViews");
    if ((uri == nullptr) == !view_idx) {
      Fail(place.path, "expected either 'uri' or 'bufferView'");
    }
    if (uri != nullptr) {
      CheckUri(place, *uri);
    } else if (root_["bufferViews"][*view_idx]["byteLength"].get<uint64_t>() > kMaxInt) {
      Fail(place.path, "an image of more than 2 GiB");
    }
  }

  void CheckTextureInfo(const JsonPlace& place, const char* key) const {
    const std::optional<JsonPlace> info = Object(place, key);
    if (!info) {
      return;
    }
    Index(*info, "index", "textures", true);
    Unsigned(*info, "texCoord", 0, kMaxInt);
    Number(*info, "scale");
    if (const std::optional<JsonPlace> transform = Extension(*info, "KHR_texture_transform")) {
      Numbers(*transform, "offset", 2);
      Numbers(*transform, "scale", 2);
      Number(*transform, "rotation");
      Unsigned(*transform, "texCoord", 0, kMaxInt);
    }
  }

  void CheckMaterial(const JsonPlace& place) const {
    if (const std::optional<JsonPlace> pbr = Object(place, "pbrMetallicRoughness")) {
      Numbers(*pbr, "baseColorFactor", 4, 0.0);
      Number(*pbr, "metallicFactor");
      Number(*pbr, "roughnessFactor");
      CheckTextureInfo(*pbr, "baseColorTexture");
      CheckTextureInfo(*pbr, "metallicRoughnessTexture");
    }
    CheckTextureInfo(place, "normalTexture");
    CheckTextureInfo(place, "occlusionTexture");
    CheckTextureInfo(place, "emissiveTexture");
    Numbers(place, "emissiveFactor", 3, 0.0);
    Number(place, "alphaCutoff", 0.0);
    Boolean(place, "doubleSided");
    const std::string* mode = String(place, "alphaMode");
    if (mode != nullptr && *mode != "OPAQUE" && *mode != "MASK" && *mode != "BLEND") {
      Fail(place.path + ".alphaMode",
           fmt::format("expected OPAQUE, MASK or BLEND, got '{:.20}'", *mode));
    }
    if (const std::optional<JsonPlace> extension = Extension(place, "KHR_materials_ior")) {
      Number(*extension, "ior", 0.0);
    }
    if (const std::optional<JsonPlace> extension =
            Extension(place, "KHR_materials_emissive_strength")) {
      Number(*extension, "emissiveStrength", 0.0);
    }
    Extension(place, "KHR_materials_unlit");
  }

  void CheckMesh(const JsonPlace& place) const {
    Array(place, "primitives", true);
    ForEach(place, "primitives", [this](const JsonPlace& primitive, size_t) {
      const JsonPlace attributes = *Object(primitive, "attributes", true);
      for (const auto& [name, value] : attributes.object->items()) {
        Index(value, Join(attributes.path, name), "accessors");
      }
      Member(attributes, "POSITION", true);
      Index(primitive, "indices", "accessors");
      Index(primitive, "material", "materials");
      Unsigned(primitive, "mode", 0, 6);
    });
  }

  void CheckLights() {
    const std::optional<JsonPlace> lights = Extension(Document(), "KHR_lights_punctual");
    if (!lights) {
      return;
    }
    num_lights_ = Array(*lights, "lights", true)->size();
    ForEach(*lights, "lights", [this](const JsonPlace& light, size_t) {
      String(light, "type", true);
      Numbers(light, "color", 3, 0.0);
      Number(light, "intensity", 0.0);
    });
  }

  void CheckNode(const JsonPlace& place) const {
    Index(place, "mesh", "meshes");
    const bool has_matrix = Numbers(place, "matrix", 16);
    const bool has_translation = Numbers(place, "translation", 3);
    const bool has_rotation = Numbers(place, "rotation", 4);
    const bool has_scale = Numbers(place, "scale", 3);
    if (has_matrix && (has_translation || has_rotation || has_scale)) {
      Fail(place.path, "has both a matrix and a translation, rotation or scale");
    }
    const Json* children = Array(place, "children");
    for (size_t i = 0; children != nullptr && i < children->size(); ++i) {
      Index((*children)[i], fmt::format("{}.children[{}]", place.path, i), "nodes");
    }
    if (const std::optional<JsonPlace> light = Extension(place, "KHR_lights_punctual")) {
      const uint64_t light_idx = *Unsigned(*light, "light", 0, kMaxInt, true);
      if (light_idx >= num_lights_) {
        Fail(light->path + ".light",
             fmt::format(
                 "{}, expected less than {} (the number of lights)", light_idx, num_lights_));
      }
    }
  }

  /// Nodes are strict trees (glTF 2.0, section 3.5.2): each has one parent at most, and none is its
  /// own ancestor.
  void CheckTree() {
    constexpr size_t kNone = std::numeric_limits<size_t>::max();
    std::vector<size_t> parents(NumEntries("nodes"), kNone);
    for (size_t i = 0; i < parents.size(); ++i) {
      const Json& node = root_["nodes"][i];
      const auto children = node.find("children");
      for (size_t k = 0; children != node.end() && k < children->size(); ++k) {
        const size_t child = (*children)[k].get<size_t>();
        if (parents[child] != kNone) {
          Fail(fmt::format("nodes[{}]", child),
               fmt::format("is a child of nodes[{}] and of nodes[{}]", parents[child], i));
        }
        parents[child] = i;
      }
    }
    // Walk up from each node; a walk that meets itself has found a cycle.
    std::vector<size_t> walk_of(parents.size(), kNone);
    for (size_t start = 0; start < parents.size(); ++start) {
      for (size_t i = start; i != kNone && walk_of[i] != start; i = parents[i]) {
        if (walk_of[i] != kNone) {
          break;
        }
        walk_of[i] = start;
        if (parents[i] != kNone && walk_of[parents[i]] == start) {
          Fail(fmt::format("nodes[{}]", i), "is its own ancestor");
        }
      }
    }
    for (const size_t parent : parents) {
      has_parent_.push_back(parent != kNone);
    }
  }

  void CheckScene(const JsonPlace& place) const {
    const Json* nodes = Array(place, "nodes");
    std::vector<bool> is_listed(NumEntries("nodes"));
    for (size_t i = 0; nodes != nullptr && i < nodes->size(); ++i) {
      const std::string path = fmt::format("{}.nodes[{}]", place.path, i);
      const size_t node_idx = Index((*nodes)[i], path, "nodes");
      if (has_parent_[node_idx] || is_listed[node_idx]) {
        Fail(path,
             fmt::format("nodes[{}] {}",
                         node_idx,
                         is_listed[node_idx] ? "is listed twice" : "is not a root node"));
      }
      is_listed[node_idx] = true;
    }
  }

  const Json& root_;
  const bool is_glb_;
  size_t num_lights_ = 0;
  std::vector<bool> has_parent_;
};

}  // namespace

size_t ComponentSizeBytes(int component_type) {
  switch (component_type) {
    case 5120:  // BYTE
    case 5121:  // UNSIGNED_BYTE
      return 1;
    case 5122:  // SHORT
    case 5123:  // UNSIGNED_SHORT
      return 2;
    case 5125:  // UNSIGNED_INT
    case 5126:  // FLOAT
      return 4;
    default:
      return 0;
  }
}

void CheckGltfJson(const nlohmann::json& root, bool is_glb, const std::string& origin) {
  Checker(root, is_glb, origin).Run();
}

}  // namespace pfseq
