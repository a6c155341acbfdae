// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/scene.h"

#include "renderer/core/error.h"

namespace pfseq {
namespace {

void ValidateMesh(const Mesh& mesh, const Scene& scene, const std::string& where) {
  const size_t num_vertices = mesh.positions_m.size();
  if (mesh.material_idx < 0 || static_cast<size_t>(mesh.material_idx) >= scene.materials.size()) {
    throw InputError("{}: material {} of {}", where, mesh.material_idx, scene.materials.size());
  }
  if (!mesh.normals.empty() && mesh.normals.size() != num_vertices) {
    throw InputError("{}: {} normals for {} positions", where, mesh.normals.size(), num_vertices);
  }
  if (!mesh.texcoords.empty() && mesh.texcoords.size() != num_vertices) {
    throw InputError(
        "{}: {} texture coordinates for {} positions", where, mesh.texcoords.size(), num_vertices);
  }
  for (const Vec3f& position : mesh.positions_m) {
    if (!position.allFinite()) {
      throw InputError("{}: a position is not finite", where);
    }
  }
  for (const Vec3f& normal : mesh.normals) {
    if (!normal.allFinite()) {
      throw InputError("{}: a normal is not finite", where);
    }
  }
  for (const Vec2f& texcoord : mesh.texcoords) {
    if (!texcoord.allFinite()) {
      throw InputError("{}: a texture coordinate is not finite", where);
    }
  }
  for (const std::array<uint32_t, 3>& triangle : mesh.triangles) {
    for (const uint32_t vertex : triangle) {
      if (vertex >= num_vertices) {
        throw InputError("{}: vertex index {} of {} vertices", where, vertex, num_vertices);
      }
    }
  }
}

void ValidateMaterial(const Material& material, size_t num_textures, const std::string& where) {
  for (const int texture_idx : {material.base_color_texture_idx,
                                material.metallic_roughness_texture_idx,
                                material.normal_texture_idx,
                                material.emission_texture_idx}) {
    if (texture_idx < -1 || texture_idx >= static_cast<int>(num_textures)) {
      throw InputError("{}: texture {} of {}", where, texture_idx, num_textures);
    }
  }
  const bool is_finite = material.base_color.allFinite() && material.emission.allFinite() &&
                         std::isfinite(material.metallic) && std::isfinite(material.roughness) &&
                         std::isfinite(material.normal_scale) && std::isfinite(material.ior);
  if (!is_finite) {
    throw InputError("{}: a factor is not finite", where);
  }
}

}  // namespace

size_t Scene::NumTriangles() const {
  size_t count = 0;
  for (const Mesh& mesh : meshes) {
    count += mesh.triangles.size();
  }
  return count;
}

void Scene::Validate(const std::string& origin) const {
  if (NumTriangles() == 0) {
    throw InputError("{}: the scene holds no triangle", origin);
  }
  for (size_t i = 0; i < materials.size(); ++i) {
    ValidateMaterial(materials[i],
                     textures.size(),
                     fmt::format("{}: material {} '{}'", origin, i, materials[i].name));
  }
  for (size_t i = 0; i < textures.size(); ++i) {
    if (textures[i].texels.Empty() || textures[i].texels.NumChannels() != 4) {
      throw InputError("{}: texture {} '{}' is empty", origin, i, textures[i].name);
    }
  }
  for (size_t i = 0; i < meshes.size(); ++i) {
    ValidateMesh(meshes[i], *this, fmt::format("{}: mesh {} '{}'", origin, i, meshes[i].name));
  }
}

}  // namespace pfseq
