// SPDX-License-Identifier: Apache-2.0
// Materials and textures of a glTF document as the scene's.
#pragma once

#include "renderer/trace/scene.h"
#include "scenes/gltf/gltf_document.h"

#include <string>
#include <vector>

namespace pfseq {

/// Which texture coordinates a material samples, and how they are mapped first
/// (KHR_texture_transform).
struct TexcoordMapping {
  /// The number behind TEXCOORD_.
  int set = 0;
  /// texcoord = scale_rotation * stored + offset.
  Eigen::Matrix2d scale_rotation = Eigen::Matrix2d::Identity();
  Vec2d offset = Vec2d::Zero();

  bool operator==(const TexcoordMapping&) const = default;
  bool IsIdentity() const {
    return scale_rotation == Eigen::Matrix2d::Identity() && offset == Vec2d::Zero();
  }
};

/// Entries with the document's indices, then one more material: glTF's default for primitives that
/// name none. It is left out (and `default_material_idx` is -1) when all name one.
struct GltfMaterials {
  std::vector<Material> materials;
  /// One for each material.
  std::vector<TexcoordMapping> texcoords;
  std::vector<Texture> textures;
  int default_material_idx = -1;
};

/// InputError that starts with `origin` when an image cannot be decoded or a material needs what a
/// scene cannot hold (different texture coordinates for its textures).
GltfMaterials ReadGltfMaterials(const tinygltf::Model& model, const std::string& origin);

/// In the extras of an image: whether its texels are sRGB-encoded, for textures whose use does not
/// tell.
inline constexpr const char* kIsSrgbExtra = "pfseq_is_srgb";

}  // namespace pfseq
