// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_writer.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parallel.h"
#include "renderer/sequence/image_io.h"
#include "scenes/gltf/gltf_axes.h"
#include "scenes/gltf/gltf_document.h"
#include "scenes/gltf/gltf_material.h"
#include "scenes/gltf/gltf_sun.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <span>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

/// A colour below this would be taken for black by tinygltf; it is written as a brighter one of
/// little strength.
constexpr float kMinPlainEmission = 1e-6F;

/// Room for the JSON part of an ordinary scene; it grows where it must.
constexpr size_t kJsonBytes = size_t{1} << 20;

/// Each part of the binary buffer begins at a multiple of this.
constexpr size_t kAlignment = 4;

void CheckGlbSize(uint64_t size_bytes) {
  if (size_bytes > std::numeric_limits<uint32_t>::max()) {
    throw SystemError(
        "cannot write the scene as GLB: {} bytes, more than the 4 GiB that the format holds",
        size_bytes);
  }
}

tinygltf::Value ObjectValue(const char* key, tinygltf::Value value) {
  return tinygltf::Value(tinygltf::Value::Object{{key, std::move(value)}});
}

/// Three of the four channels where nothing is transparent: readers put the fourth back.
Image<uint8_t> WithoutOpaqueAlpha(const Image<uint8_t>& rgba) {
  const std::span<const uint8_t> from = rgba.Values();
  for (size_t i = 3; i < from.size(); i += 4) {
    if (from[i] != 255) {
      return rgba;
    }
  }
  Image<uint8_t> rgb(rgba.WidthPx(), rgba.HeightPx(), 3);
  uint8_t* to = rgb.Values().data();
  for (size_t i = 0; i < from.size(); i += 4, to += 3) {
    std::copy_n(&from[i], 3, to);
  }
  return rgb;
}

/// Builds the model; the textures' PNG files are kept apart until it is known where they go.
class ModelBuilder {
 public:
  explicit ModelBuilder(const Scene& scene) : scene_(scene) {
    model_.asset.version = "2.0";
    model_.asset.generator = "pfseq " PFSEQ_VERSION;
    model_.buffers.emplace_back();
    Buffer().reserve(GeometryBytes());
    AddTextures();
    AddMaterials();
    AddNodes();
  }

  tinygltf::Model& Model() { return model_; }
  std::vector<unsigned char>& Buffer() { return model_.buffers[0].data; }
  std::vector<Bytes>& PngFiles() { return png_files_; }

  /// A part of the binary buffer; returns the view's index.
  int AddView(std::span<const std::byte> bytes, int target) {
    std::vector<unsigned char>& data = Buffer();
    data.resize((data.size() + kAlignment - 1) / kAlignment * kAlignment);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = bytes.size();
    view.target = target;
    const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
    data.insert(data.end(), begin, begin + bytes.size());
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

 private:
  size_t GeometryBytes() const {
    size_t bytes = 0;
    for (const pfseq::Mesh& mesh : scene_.meshes) {
      bytes += sizeof(Vec3f) * (mesh.positions_m.size() + mesh.normals.size()) +
               sizeof(Vec2f) * mesh.texcoords.size() +
               sizeof(mesh.triangles[0]) * mesh.triangles.size();
    }
    return bytes;
  }

  /// Whether the uses of a texture tell what its is_srgb tells. An unused one is taken for colour.
  bool UseTells(int texture_idx, bool is_srgb) const {
    bool is_color = false;
    bool is_data = false;
    for (const Material& material : scene_.materials) {
      is_color |= material.base_color_texture_idx == texture_idx ||
                  material.emission_texture_idx == texture_idx;
      is_data |= material.metallic_roughness_texture_idx == texture_idx ||
                 material.normal_texture_idx == texture_idx;
    }
    return is_srgb ? !is_data : is_data && !is_color;
  }

  void AddTextures() {
    for (size_t i = 0; i < scene_.textures.size(); ++i) {
      const pfseq::Texture& source = scene_.textures[i];
      const int idx = static_cast<int>(i);
      tinygltf::Image image;
      image.name = source.name;
      image.mimeType = "image/png";
      if (!UseTells(idx, source.is_srgb)) {
        image.extras = ObjectValue(kIsSrgbExtra, tinygltf::Value(source.is_srgb));
      }
      model_.images.push_back(image);
      tinygltf::Texture texture;
      texture.source = idx;
      model_.textures.push_back(texture);
    }
    png_files_.resize(scene_.textures.size());
    ParallelFor(png_files_.size(), NumHardwareThreads(), [&](size_t i) {
      // The scene is written before each sequence: textures need not be small, but soon there.
      png_files_[i] = EncodePng(WithoutOpaqueAlpha(scene_.textures[i].texels), PngEffort::kFast);
    });
  }

  void UseExtension(const std::string& name) {
    if (std::ranges::find(model_.extensionsUsed, name) == model_.extensionsUsed.end()) {
      model_.extensionsUsed.push_back(name);
    }
  }

  void AddMaterials() {
    for (const pfseq::Material& source : scene_.materials) {
      tinygltf::Material material;
      material.name = source.name;
      material.doubleSided = true;
      tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
      pbr.baseColorFactor = {
          source.base_color[0], source.base_color[1], source.base_color[2], source.base_alpha};
      pbr.baseColorTexture.index = source.base_color_texture_idx;
      pbr.metallicFactor = source.metallic;
      pbr.roughnessFactor = source.roughness;
      pbr.metallicRoughnessTexture.index = source.metallic_roughness_texture_idx;
      material.normalTexture.index = source.normal_texture_idx;
      material.normalTexture.scale = source.normal_scale;
      material.emissiveTexture.index = source.emission_texture_idx;
      SetEmission(source.emission, material);
      if (source.ior != 1.5F) {
        material.extensions["KHR_materials_ior"] =
            ObjectValue("ior", tinygltf::Value(static_cast<double>(source.ior)));
        UseExtension("KHR_materials_ior");
      }
      if (source.ior == 1.0F) {
        // With the index of refraction alone, others would still reflect at grazing angles.
        material.extensions["KHR_materials_specular"] =
            ObjectValue("specularFactor", tinygltf::Value(0.0));
        UseExtension("KHR_materials_specular");
      }
      if (source.alpha_cutoff) {
        material.alphaMode = "MASK";
        material.alphaCutoff = *source.alpha_cutoff;
      }
      model_.materials.push_back(material);
    }
  }

  /// emissiveFactor is at most 1; what is brighter needs a strength.
  void SetEmission(const Rgb& emission, tinygltf::Material& material) {
    const float max = emission.maxCoeff();
    double strength = 1.0;
    if (max > 1.0F || (max > 0.0F && max < kMinPlainEmission)) {
      strength = max;
      material.extensions["KHR_materials_emissive_strength"] =
          ObjectValue("emissiveStrength", tinygltf::Value(strength));
      UseExtension("KHR_materials_emissive_strength");
    }
    material.emissiveFactor.clear();
    for (const float channel : emission) {
      material.emissiveFactor.push_back(static_cast<double>(channel) / strength);
    }
  }

  template <typename Element>
  int AddAccessor(const std::vector<Element>& elements, int type, int component_type, int target) {
    static_assert(std::is_trivially_copyable_v<Element> || !std::is_arithmetic_v<Element>);
    tinygltf::Accessor accessor;
    accessor.bufferView = AddView(std::as_bytes(std::span(elements)), target);
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = elements.size();
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int AddVectors(const std::vector<Vec3f>& vectors_world) {
    std::vector<Vec3f> vectors(vectors_world.size());
    std::ranges::transform(vectors_world, vectors.begin(), &GltfFromWorld<float>);
    return AddAccessor(
        vectors, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER);
  }

  int AddPositions(const std::vector<Vec3f>& positions_m) {
    const int idx = AddVectors(positions_m);
    Vec3f min = GltfFromWorld(positions_m[0]);
    Vec3f max = min;
    for (const Vec3f& position_m : positions_m) {
      const Vec3f position_gltf_m = GltfFromWorld(position_m);
      min = min.cwiseMin(position_gltf_m);
      max = max.cwiseMax(position_gltf_m);
    }
    model_.accessors.back().minValues = {min.x(), min.y(), min.z()};
    model_.accessors.back().maxValues = {max.x(), max.y(), max.z()};
    return idx;
  }

  int AddMesh(const pfseq::Mesh& source) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = source.material_idx;
    primitive.attributes["POSITION"] = AddPositions(source.positions_m);
    if (!source.normals.empty()) {
      primitive.attributes["NORMAL"] = AddVectors(source.normals);
    }
    if (!source.texcoords.empty()) {
      primitive.attributes["TEXCOORD_0"] = AddAccessor(source.texcoords,
                                                       TINYGLTF_TYPE_VEC2,
                                                       TINYGLTF_COMPONENT_TYPE_FLOAT,
                                                       TINYGLTF_TARGET_ARRAY_BUFFER);
    }
    std::vector<uint32_t> indices(3 * source.triangles.size());
    std::memcpy(indices.data(), source.triangles.data(), sizeof(uint32_t) * indices.size());
    primitive.indices = AddAccessor(indices,
                                    TINYGLTF_TYPE_SCALAR,
                                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                    TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    tinygltf::Mesh mesh;
    mesh.name = source.name;
    mesh.primitives.push_back(std::move(primitive));
    model_.meshes.push_back(std::move(mesh));
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  void AddNodes() {
    tinygltf::Scene gltf_scene;
    gltf_scene.nodes = {0};
    model_.scenes.push_back(gltf_scene);
    model_.defaultScene = 0;
    model_.nodes.emplace_back();
    model_.nodes[0].name = "scene";
    for (const pfseq::Mesh& mesh : scene_.meshes) {
      if (mesh.triangles.empty()) {
        continue;
      }
      tinygltf::Node node;
      node.mesh = AddMesh(mesh);
      model_.nodes[0].children.push_back(static_cast<int>(model_.nodes.size()));
      model_.nodes.push_back(node);
    }
    if (scene_.sun) {
      const int sun_idx = AddSun(*scene_.sun, model_);
      model_.nodes[0].children.push_back(sun_idx);
    }
  }

  const Scene& scene_;
  tinygltf::Model model_;
  std::vector<Bytes> png_files_;
};

/// `size_bytes` is about what it will take.
std::string Serialize(const tinygltf::Model& model, bool is_binary, size_t size_bytes) {
  tinygltf::TinyGLTF writer;
  writer.SetImageWriter(nullptr, nullptr);
  std::string space;
  space.reserve(size_bytes);
  std::ostringstream stream(std::move(space), std::ios::out);
  if (!writer.WriteGltfSceneToStream(&model, stream, false, is_binary)) {
    throw SystemError("cannot write the scene as glTF");
  }
  return std::move(stream).str();
}

/// A file's name as a URI (RFC 3986): all but unreserved characters escaped.
std::string UriOf(const std::string& name) {
  constexpr std::string_view kUnreserved =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~";
  std::string uri;
  for (const char c : name) {
    if (kUnreserved.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return uri;
}

}  // namespace

std::string GlbBytes(const Scene& scene, const std::string& copyright) {
  scene.Validate("scene");
  ModelBuilder builder(scene);
  builder.Model().asset.copyright = copyright;
  for (size_t i = 0; i < builder.PngFiles().size(); ++i) {
    builder.Model().images[i].bufferView = builder.AddView(builder.PngFiles()[i], 0);
  }
  CheckGlbSize(builder.Buffer().size());
  std::string bytes = Serialize(builder.Model(), true, builder.Buffer().size() + kJsonBytes);
  CheckGlbSize(bytes.size());
  return bytes;
}

void WriteGltf(const Scene& scene,
               const std::filesystem::path& path,
               const std::string& copyright) {
  scene.Validate("scene");
  ModelBuilder builder(scene);
  builder.Model().asset.copyright = copyright;
  const std::string name = path.stem().string();
  const std::filesystem::path folder = path.parent_path();
  for (size_t i = 0; i < builder.PngFiles().size(); ++i) {
    const std::string png_name = fmt::format("{}_{}.png", name, i);
    WriteFileAtomically(folder / png_name, builder.PngFiles()[i]);
    builder.Model().images[i].uri = UriOf(png_name);
  }
  // tinygltf would put the buffer's bytes into the JSON: it is named there afterwards.
  const std::vector<unsigned char> buffer = std::move(builder.Buffer());
  builder.Model().buffers.clear();
  const std::string bin_name = name + ".bin";
  nlohmann::json root = nlohmann::json::parse(Serialize(builder.Model(), false, kJsonBytes));
  root["buffers"] = {{{"byteLength", buffer.size()}, {"uri", UriOf(bin_name)}}};
  WriteFileAtomically(folder / bin_name, std::as_bytes(std::span(buffer)));
  WriteFileAtomically(path, root.dump(2) + "\n");
}

}  // namespace pfseq
