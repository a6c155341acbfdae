// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_material.h"

#include "renderer/core/error.h"
#include "renderer/sequence/image_io.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace pfseq {
namespace {

double NumberOr(const tinygltf::Value& object, const char* key, double fallback) {
  return object.Has(key) ? object.Get(key).GetNumberAsDouble() : fallback;
}

const tinygltf::Value* FindExtension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() ? &found->second : nullptr;
}

Rgb ToRgb(const std::vector<double>& color, double scale) {
  return {static_cast<float>(color[0] * scale),
          static_cast<float>(color[1] * scale),
          static_cast<float>(color[2] * scale)};
}

/// The scene's textures: one for each image that a texture of the document shows, in the order of
/// the images. An image that is used both as colour and as data becomes two.
class TextureTable {
 public:
  TextureTable(const tinygltf::Model& model, const std::string& origin)
      : model_(model), origin_(origin), texture_idx_of_image_(model.images.size(), -1) {
    std::vector<bool> is_shown(model.images.size());
    for (const tinygltf::Texture& texture : model.textures) {
      if (texture.source >= 0) {
        is_shown[static_cast<size_t>(texture.source)] = true;
      }
    }
    for (size_t i = 0; i < model.images.size(); ++i) {
      if (is_shown[i]) {
        Decode(i);
      }
    }
  }

  /// The index in the scene of what a texture info refers to; -1 for none.
  int IndexOf(int gltf_texture_idx, bool is_srgb, const std::string& where) {
    if (gltf_texture_idx < 0) {
      return -1;
    }
    const int image_idx = model_.textures[static_cast<size_t>(gltf_texture_idx)].source;
    if (image_idx < 0) {
      throw InputError(
          "{}: textures[{}] has no image of a supported kind", where, gltf_texture_idx);
    }
    const int texture_idx = texture_idx_of_image_[static_cast<size_t>(image_idx)];
    Texture& texture = textures_[static_cast<size_t>(texture_idx)];
    std::optional<bool>& known = is_srgb_known_[static_cast<size_t>(texture_idx)];
    if (!known) {
      known = is_srgb;
      texture.is_srgb = is_srgb;
    }
    if (is_fixed_[static_cast<size_t>(texture_idx)] || *known == is_srgb) {
      return texture_idx;
    }
    return OtherUse(texture_idx, is_srgb);
  }

  std::vector<Texture> Take() { return std::move(textures_); }

 private:
  void Decode(size_t image_idx) {
    const tinygltf::Image& image = model_.images[image_idx];
    const std::string where = fmt::format("{}: images[{}] '{}'", origin_, image_idx, image.name);
    Texture texture;
    texture.name = image.name;
    texture.texels = DecodeImage8Rgba(std::as_bytes(std::span(image.image)), where);
    std::optional<bool> known;
    if (image.extras.Has(kIsSrgbExtra) && image.extras.Get(kIsSrgbExtra).IsBool()) {
      known = image.extras.Get(kIsSrgbExtra).Get<bool>();
      texture.is_srgb = *known;
    }
    texture_idx_of_image_[image_idx] = static_cast<int>(textures_.size());
    is_fixed_.push_back(known.has_value());
    is_srgb_known_.push_back(known);
    textures_.push_back(std::move(texture));
  }

  int OtherUse(int texture_idx, bool is_srgb) {
    const auto [entry, is_new] =
        other_use_.try_emplace(texture_idx, static_cast<int>(textures_.size()));
    if (is_new) {
      textures_.push_back(textures_[static_cast<size_t>(texture_idx)]);
      textures_.back().is_srgb = is_srgb;
      is_srgb_known_.emplace_back(is_srgb);
      is_fixed_.push_back(true);
    }
    return entry->second;
  }

  const tinygltf::Model& model_;
  const std::string& origin_;
  std::vector<int> texture_idx_of_image_;
  std::vector<Texture> textures_;
  /// For each texture: how its texels are encoded, once that is known, and whether the file says so
  /// itself.
  std::vector<std::optional<bool>> is_srgb_known_;
  std::vector<bool> is_fixed_;
  std::map<int, int> other_use_;
};

/// The mapping of one texture info. KHR_texture_transform: offset + rotation * scale * texcoord,
/// where the rotation is counter-clockwise as seen in the image, whose v points down. (The matrix
/// in the extension's text has the other sign; its prose and the test model TextureTransformTest of
/// Khronos agree with this one.)
template <typename Info>
TexcoordMapping MappingOf(const Info& info) {
  TexcoordMapping mapping;
  mapping.set = info.texCoord;
  const tinygltf::Value* transform = FindExtension(info.extensions, "KHR_texture_transform");
  if (transform == nullptr) {
    return mapping;
  }
  if (transform->Has("texCoord")) {
    mapping.set = transform->Get("texCoord").GetNumberAsInt();
  }
  Vec2d scale = Vec2d::Ones();
  for (int k = 0; k < 2; ++k) {
    if (transform->Has("scale")) {
      scale[k] = transform->Get("scale").Get(k).GetNumberAsDouble();
    }
    if (transform->Has("offset")) {
      mapping.offset[k] = transform->Get("offset").Get(k).GetNumberAsDouble();
    }
  }
  const double rotation_rad = NumberOr(*transform, "rotation", 0.0);
  Eigen::Matrix2d rotation;
  rotation << std::cos(rotation_rad), std::sin(rotation_rad), -std::sin(rotation_rad),
      std::cos(rotation_rad);
  mapping.scale_rotation = rotation * scale.asDiagonal();
  return mapping;
}

/// The one mapping of all textures of a material that are read.
TexcoordMapping MappingOfMaterial(const tinygltf::Material& source, const std::string& where) {
  std::optional<TexcoordMapping> common;
  const auto add = [&](const auto& info) {
    if (info.index < 0) {
      return;
    }
    const TexcoordMapping mapping = MappingOf(info);
    if (common && !(*common == mapping)) {
      throw InputError(
          "{}: its textures differ in texCoord or KHR_texture_transform, which is not supported",
          where);
    }
    common = mapping;
  };
  add(source.pbrMetallicRoughness.baseColorTexture);
  add(source.pbrMetallicRoughness.metallicRoughnessTexture);
  add(source.normalTexture);
  add(source.emissiveTexture);
  return common.value_or(TexcoordMapping{});
}

Material ConvertMaterial(const tinygltf::Material& source,
                         TextureTable& textures,
                         const std::string& where) {
  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
  Material material;
  material.name = source.name;
  material.base_color = ToRgb(pbr.baseColorFactor, 1.0);
  material.base_alpha = static_cast<float>(pbr.baseColorFactor[3]);
  material.base_color_texture_idx = textures.IndexOf(pbr.baseColorTexture.index, true, where);
  // BLEND: what is at least half there is there; the scene knows no translucency.
  if (source.alphaMode != "OPAQUE") {
    material.alpha_cutoff =
        source.alphaMode == "MASK" ? static_cast<float>(source.alphaCutoff) : 0.5F;
  }
  material.normal_texture_idx = textures.IndexOf(source.normalTexture.index, false, where);
  material.normal_scale = static_cast<float>(source.normalTexture.scale);
  if (source.extensions.contains("KHR_materials_unlit")) {
    // A picture painted on: a Lambertian surface of that colour.
    material.ior = 1.0F;
    return material;
  }
  // Exporters are known to write roughnesses below 0.
  material.metallic = static_cast<float>(std::clamp(pbr.metallicFactor, 0.0, 1.0));
  material.roughness = static_cast<float>(std::clamp(pbr.roughnessFactor, 0.0, 1.0));
  material.metallic_roughness_texture_idx =
      textures.IndexOf(pbr.metallicRoughnessTexture.index, false, where);
  double strength = 1.0;
  if (const tinygltf::Value* emission =
          FindExtension(source.extensions, "KHR_materials_emissive_strength")) {
    strength = NumberOr(*emission, "emissiveStrength", 1.0);
  }
  material.emission = ToRgb(source.emissiveFactor, strength);
  material.emission_texture_idx = textures.IndexOf(source.emissiveTexture.index, true, where);
  if (const tinygltf::Value* ior = FindExtension(source.extensions, "KHR_materials_ior")) {
    material.ior = static_cast<float>(NumberOr(*ior, "ior", 1.5));
  }
  return material;
}

bool HasPrimitiveWithoutMaterial(const tinygltf::Model& model) {
  return std::ranges::any_of(model.meshes, [](const tinygltf::Mesh& mesh) {
    return std::ranges::any_of(mesh.primitives, [](const tinygltf::Primitive& primitive) {
      return primitive.material < 0;
    });
  });
}

}  // namespace

GltfMaterials ReadGltfMaterials(const tinygltf::Model& model, const std::string& origin) {
  GltfMaterials result;
  TextureTable textures(model, origin);
  for (size_t i = 0; i < model.materials.size(); ++i) {
    const tinygltf::Material& source = model.materials[i];
    const std::string where = fmt::format("{}: materials[{}] '{}'", origin, i, source.name);
    result.materials.push_back(ConvertMaterial(source, textures, where));
    result.texcoords.push_back(MappingOfMaterial(source, where));
  }
  if (HasPrimitiveWithoutMaterial(model)) {
    result.default_material_idx = static_cast<int>(result.materials.size());
    tinygltf::Material fallback;
    fallback.emissiveFactor = {0.0, 0.0, 0.0};
    result.materials.push_back(ConvertMaterial(fallback, textures, origin));
    result.texcoords.emplace_back();
  }
  result.textures = textures.Take();
  return result;
}

}  // namespace pfseq
