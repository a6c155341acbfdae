// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/mesh_builder.h"

#include "renderer/core/check.h"

#include <array>
#include <cmath>
#include <utility>

namespace pfseq {
namespace {

/// Polygons with less area than this (a square of 0.1 mm) are nothing but rounding.
constexpr double kLeastArea_m2 = 1e-8;

/// Twice the area of a flat polygon along its normal.
Vec3d AreaVector(std::span<const Vec3d> corners_m) {
  Vec3d sum = Vec3d::Zero();
  for (size_t i = 1; i + 1 < corners_m.size(); ++i) {
    sum += (corners_m[i] - corners_m[0]).cross(corners_m[i + 1] - corners_m[0]);
  }
  return sum;
}

}  // namespace

MeshBuilder::MeshBuilder(std::vector<double> texture_size_m)
    : texture_size_m_(std::move(texture_size_m)) {}

void MeshBuilder::BeginGroup(const std::string& name) {
  group_ = &groups_[name];
  group_->resize(texture_size_m_.size());
}

Mesh& MeshBuilder::MeshOf(int material_idx) {
  PFSEQ_CHECK(group_ != nullptr);
  PFSEQ_CHECK(material_idx >= 0 && static_cast<size_t>(material_idx) < group_->size(),
              "material {} of {}",
              material_idx,
              group_->size());
  return (*group_)[static_cast<size_t>(material_idx)];
}

void MeshBuilder::Polygon(int material_idx, std::span<const Vec3d> corners_m) {
  const Vec3d area_vector = AreaVector(corners_m);
  if (area_vector.norm() < 2.0 * kLeastArea_m2) {
    return;
  }
  const Vec3d normal = area_vector.normalized();
  const bool is_level = std::abs(normal.z()) > 0.999;
  const Vec3d tangent = is_level ? Vec3d::UnitX() : Vec3d::UnitZ().cross(normal).normalized();
  const Vec3d upward = normal.cross(tangent);
  const double per_m = 1.0 / texture_size_m_[static_cast<size_t>(material_idx)];

  Mesh& mesh = MeshOf(material_idx);
  const size_t first = mesh.positions_m.size();
  for (const Vec3d& corner_m : corners_m) {
    mesh.positions_m.emplace_back(corner_m.cast<float>());
    const Vec2d texcoord((tangent.dot(corner_m) + texture_offset_m_.x()) * per_m,
                         (texture_offset_m_.y() - upward.dot(corner_m)) * per_m);
    mesh.texcoords.emplace_back(texcoord.cast<float>());
  }
  for (size_t i = 1; i + 1 < corners_m.size(); ++i) {
    if (AreaVector(std::array{corners_m[0], corners_m[i], corners_m[i + 1]}).norm() >
        2.0 * kLeastArea_m2) {
      const auto corner = static_cast<uint32_t>(first + i);
      mesh.triangles.push_back({static_cast<uint32_t>(first), corner, corner + 1});
    }
  }
}

void MeshBuilder::Quad(
    int material_idx, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const std::array<Vec3d, 4> corners_m = {a, b, c, d};
  Polygon(material_idx, corners_m);
}

void MeshBuilder::Rectangle(int material_idx,
                            const SurfaceFrame& frame,
                            const Vec2d& low_m,
                            const Vec2d& high_m,
                            double w_m) {
  if (high_m.x() <= low_m.x() || high_m.y() <= low_m.y()) {
    return;
  }
  Quad(material_idx,
       frame.At(low_m.x(), low_m.y(), w_m),
       frame.At(high_m.x(), low_m.y(), w_m),
       frame.At(high_m.x(), high_m.y(), w_m),
       frame.At(low_m.x(), high_m.y(), w_m));
}

void MeshBuilder::PictureQuad(int material_idx,
                              const Vec3d& a,
                              const Vec3d& b,
                              const Vec3d& c,
                              const Vec3d& d,
                              const TextureWindow& window) {
  Mesh& mesh = MeshOf(material_idx);
  const size_t first = mesh.positions_m.size();
  for (const Vec3d* corner_m : {&a, &b, &c, &d}) {
    mesh.positions_m.emplace_back(corner_m->cast<float>());
  }
  for (const Vec2d& texcoord : {Vec2d(window.u0, window.v1),
                                Vec2d(window.u1, window.v1),
                                Vec2d(window.u1, window.v0),
                                Vec2d(window.u0, window.v0)}) {
    mesh.texcoords.emplace_back(texcoord.cast<float>());
  }
  const auto base = static_cast<uint32_t>(first);
  mesh.triangles.push_back({base, base + 1, base + 2});
  mesh.triangles.push_back({base, base + 2, base + 3});
}

std::vector<Mesh> MeshBuilder::TakeMeshes(std::span<const Material> materials) {
  PFSEQ_CHECK(materials.size() == texture_size_m_.size());
  std::vector<Mesh> meshes;
  for (auto& [name, group] : groups_) {
    for (size_t i = 0; i < group.size(); ++i) {
      if (!group[i].triangles.empty()) {
        group[i].name = name + "/" + materials[i].name;
        group[i].material_idx = static_cast<int>(i);
        meshes.push_back(std::move(group[i]));
      }
    }
  }
  groups_.clear();
  group_ = nullptr;
  return meshes;
}

}  // namespace pfseq
