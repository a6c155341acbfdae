// SPDX-License-Identifier: Apache-2.0
// Small scenes with closed-form distances.
#pragma once

#include "renderer/trace/scene.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace pfseq {

/// Two triangles; counter-clockwise corners.
inline Mesh Quad(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d) {
  Mesh mesh;
  mesh.positions_m = {a, b, c, d};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A scene of one mesh with the default material.
inline std::shared_ptr<const Scene> SceneOfMesh(Mesh mesh) {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes.push_back(std::move(mesh));
  return std::make_shared<const Scene>(std::move(scene));
}

inline std::shared_ptr<const Scene> SceneOfTriangles(
    const std::vector<std::array<Vec3f, 3>>& triangles) {
  Mesh mesh;
  for (const std::array<Vec3f, 3>& triangle : triangles) {
    const auto first = static_cast<uint32_t>(mesh.positions_m.size());
    mesh.positions_m.insert(mesh.positions_m.end(), triangle.begin(), triangle.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return SceneOfMesh(std::move(mesh));
}

/// A closed axis-aligned box, seen from inside or outside.
inline std::shared_ptr<const Scene> BoxScene(const Vec3f& low_m, const Vec3f& high_m) {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.positions_m.emplace_back((corner & 1) != 0 ? high_m.x() : low_m.x(),
                                  (corner & 2) != 0 ? high_m.y() : low_m.y(),
                                  (corner & 4) != 0 ? high_m.z() : low_m.z());
  }
  const std::array<std::array<uint32_t, 4>, 6> faces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const std::array<uint32_t, 4>& face : faces) {
    mesh.triangles.push_back({face[0], face[1], face[2]});
    mesh.triangles.push_back({face[0], face[2], face[3]});
  }
  return SceneOfMesh(std::move(mesh));
}

/// A closed sphere of triangles with its vertices on the sphere. A chord's sagitta makes distances
/// from the centre too short by at most radius * (1 - cos(pi / num_rings)).
inline std::shared_ptr<const Scene> SphereScene(const Vec3f& center_m,
                                                float radius_m,
                                                int num_rings) {
  Mesh mesh;
  const int num_sectors = 2 * num_rings;
  for (int i = 0; i <= num_rings; ++i) {
    const double polar_rad = std::numbers::pi * i / num_rings;
    for (int j = 0; j < num_sectors; ++j) {
      const double azimuth_rad = 2.0 * std::numbers::pi * j / num_sectors;
      const Vec3d unit(std::sin(polar_rad) * std::cos(azimuth_rad),
                       std::sin(polar_rad) * std::sin(azimuth_rad),
                       std::cos(polar_rad));
      mesh.positions_m.push_back((center_m.cast<double>() + radius_m * unit).cast<float>());
    }
  }
  for (int i = 0; i < num_rings; ++i) {
    for (int j = 0; j < num_sectors; ++j) {
      const auto index = [&](int ring, int sector) {
        return static_cast<uint32_t>(ring * num_sectors + sector % num_sectors);
      };
      if (i > 0) {
        mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i, j + 1)});
      }
      if (i + 1 < num_rings) {
        mesh.triangles.push_back({index(i, j + 1), index(i + 1, j), index(i + 1, j + 1)});
      }
    }
  }
  return SceneOfMesh(std::move(mesh));
}

}  // namespace pfseq
