// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/mesh_builder.h"

#include "renderer/core/check.h"

#include <algorithm>
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

/// On a grid of 0.01 mm: what another processor's sine differs in its last digit does not show.
Vec3f OnGrid(const Vec3d& position_m) {
  constexpr double kPerM = 1e5;
  return (position_m * kPerM).array().round().matrix().cast<float>() / static_cast<float>(kPerM);
}

}  // namespace

MeshBuilder::MeshBuilder(const std::vector<double>& texture_size_m) {
  for (const double size_m : texture_size_m) {
    placements_.push_back({Vec2d::Constant(size_m), Vec2d::Zero(), false});
  }
}

int MeshBuilder::AddMaterial(const TexturePlacement& placement) {
  placements_.push_back(placement);
  return static_cast<int>(placements_.size()) - 1;
}

void MeshBuilder::BeginGroup(const std::string& name) { group_ = &groups_[name]; }

Mesh& MeshBuilder::MeshOf(int material_idx) {
  PFSEQ_CHECK(group_ != nullptr);
  PFSEQ_CHECK(material_idx >= 0 && static_cast<size_t>(material_idx) < placements_.size(),
              "material {} of {}",
              material_idx,
              placements_.size());
  group_->resize(std::max(group_->size(), static_cast<size_t>(material_idx) + 1));
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
  PFSEQ_CHECK(static_cast<size_t>(material_idx) < placements_.size());
  const TexturePlacement& placement = placements_[static_cast<size_t>(material_idx)];
  // v runs down: a tiled texture's from its offset, a fixed one's from the top of its place.
  const Vec2d left_top_m =
      placement.is_fixed
          ? Vec2d(placement.low_m.x(), placement.low_m.y() + placement.size_m.y())
          : Vec2d(-texture_offset_m_.x(), texture_offset_m_.y());

  Mesh& mesh = MeshOf(material_idx);
  const size_t first = mesh.positions_m.size();
  for (const Vec3d& corner_m : corners_m) {
    mesh.positions_m.push_back(OnGrid(corner_m));
    const Vec2d from_left_top_m(tangent.dot(corner_m) - left_top_m.x(),
                                left_top_m.y() - upward.dot(corner_m));
    mesh.texcoords.emplace_back(from_left_top_m.cwiseQuotient(placement.size_m).cast<float>());
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
    mesh.positions_m.push_back(OnGrid(*corner_m));
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
  PFSEQ_CHECK(materials.size() == placements_.size());
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
