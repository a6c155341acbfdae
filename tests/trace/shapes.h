// SPDX-License-Identifier: Apache-2.0
// Simple scenes for the tests of light transport.
#pragma once

#include "renderer/trace/scene.h"
#include "tests/support/simple_scenes.h"

#include <vector>

namespace pfseq {

/// Lambertian, without any specular reflection.
inline Material LambertianMaterial(const Rgb& base_color) {
  Material material;
  material.base_color = base_color;
  material.ior = 1.0F;
  return material;
}

/// The parallelogram of a corner and two edges, facing edge1 x edge2; texture coordinates run along
/// the edges.
inline Mesh ParallelogramMesh(const Vec3f& corner_m,
                              const Vec3f& edge1_m,
                              const Vec3f& edge2_m,
                              int material_idx) {
  Mesh mesh = Quad(corner_m, corner_m + edge1_m, corner_m + edge1_m + edge2_m, corner_m + edge2_m);
  mesh.texcoords = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
  mesh.material_idx = material_idx;
  return mesh;
}

/// A horizontal square around the origin at z = 0, facing up.
inline Mesh FloorMesh(float half_size_m, int material_idx) {
  return ParallelogramMesh({-half_size_m, -half_size_m, 0.0F},
                           {2.0F * half_size_m, 0.0F, 0.0F},
                           {0.0F, 2.0F * half_size_m, 0.0F},
                           material_idx);
}

/// The five faces of a box that stands on z = 0, seen from outside.
inline void AddBox(const Vec3f& low_m,
                   const Vec3f& size_m,
                   int material_idx,
                   std::vector<Mesh>* meshes) {
  const Vec3f x(size_m.x(), 0.0F, 0.0F);
  const Vec3f y(0.0F, size_m.y(), 0.0F);
  const Vec3f z(0.0F, 0.0F, size_m.z());
  meshes->push_back(ParallelogramMesh(low_m, x, z, material_idx));
  meshes->push_back(ParallelogramMesh(low_m + y, z, x, material_idx));
  meshes->push_back(ParallelogramMesh(low_m, z, y, material_idx));
  meshes->push_back(ParallelogramMesh(low_m + x, y, z, material_idx));
  meshes->push_back(ParallelogramMesh(low_m + z, x, y, material_idx));
}

/// A sphere of triangles, outward faces, flat shaded.
inline Mesh SphereMesh(const Vec3f& center_m, float radius_m, int material_idx) {
  Mesh mesh = SphereScene(center_m, radius_m, 24)->meshes[0];
  mesh.material_idx = material_idx;
  return mesh;
}

}  // namespace pfseq
