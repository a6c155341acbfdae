// SPDX-License-Identifier: Apache-2.0
// What is filmed, as plain values: triangle meshes in world coordinates, materials, textures and
// the sun. No ray tracer is needed to make, read, write or test a scene.
//
// World frame: right-handed, Z up, metres. Positions are float32 and are used exactly as stored: a
// scene written to glTF and read again has the same bits.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pfseq {

/// An 8-bit image, 4 channels (red, green, blue, alpha); repeats in both directions. The first row
/// lies at texture coordinate v = 0, as in glTF.
struct Texture {
  std::string name;
  Image<uint8_t> texels;
  /// Colour textures (base colour, emission) hold sRGB-encoded values; normal and roughness maps
  /// linear ones.
  bool is_srgb = true;
};

/// glTF 2.0 metallic-roughness material. Texture indices are positions in Scene::textures, -1 for
/// none; each texture is multiplied with the factor beside it.
struct Material {
  std::string name;
  Rgb base_color = Rgb::Constant(0.8F);
  int base_color_texture_idx = -1;
  float metallic = 0.0F;
  float roughness = 1.0F;
  /// Green is roughness, blue is metallic (glTF 2.0, section 3.9.2).
  int metallic_roughness_texture_idx = -1;
  /// Tangent-space normal map; the tangent follows +u, the bitangent -v (glTF 2.0, section 3.9.3,
  /// +Y up).
  int normal_texture_idx = -1;
  float normal_scale = 1.0F;
  /// Emitted radiance.
  Rgb emission = Rgb::Zero();
  int emission_texture_idx = -1;
  /// Index of refraction of the dielectric part; 1 turns the specular reflection off and leaves a
  /// Lambertian surface.
  float ior = 1.5F;
  /// Alpha (base colour texture's alpha times base_alpha) below the cutoff is a hole; no value:
  /// opaque.
  std::optional<float> alpha_cutoff;
  float base_alpha = 1.0F;
};

/// Triangles with one material. Both sides of a triangle are seen and shaded. Counter-clockwise
/// seen from the front.
struct Mesh {
  std::string name;
  std::vector<Vec3f> positions_m;
  /// Unit vertex normals, as many as positions, or empty for flat shading.
  std::vector<Vec3f> normals;
  /// Texture coordinates, as many as positions, or empty.
  std::vector<Vec2f> texcoords;
  std::vector<std::array<uint32_t, 3>> triangles;
  int material_idx = 0;
};

/// A directional light with a disc.
struct Sun {
  /// Unit vector from the scene to the sun.
  Vec3f direction_to_sun = Vec3f::UnitZ();
  /// Irradiance on a surface that faces the sun.
  Rgb irradiance = Rgb::Constant(1.0F);
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::optional<Sun> sun;

  size_t NumTriangles() const;

  /// Throws InputError that starts with `origin` (a file name, for example) when an index is out of
  /// range, a number is not finite, counts differ, or there is no triangle at all.
  void Validate(const std::string& origin) const;
};

}  // namespace pfseq
