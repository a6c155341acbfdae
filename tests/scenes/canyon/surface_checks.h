// SPDX-License-Identifier: Apache-2.0
// What must hold for a scene's surfaces: area, winding, no holes, none on top of another.
#pragma once

#include "renderer/core/random.h"
#include "renderer/trace/ray_scene.h"
#include "tests/scenes/canyon/canyon_test_support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace pfseq {

/// A direction on the sphere, at least `least_z` upwards.
inline Vec3d RandomDirection(RandomStream& random, double least_z) {
  const double z = random.Uniform(least_z, 1.0);
  const double angle_rad = random.Uniform(0.0, 2.0 * std::numbers::pi);
  const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {across * std::cos(angle_rad), across * std::sin(angle_rad), z};
}

/// What is wrong with a scene's surfaces, in words.
struct SurfaceFaults {
  int num_checked = 0;
  std::vector<std::string> texts;
};

/// Leaves are single sheets, seen from both sides.
inline bool IsSheet(const Mesh& mesh) { return mesh.name.find("/leaf") != std::string::npos; }

/// Triangles without area, by mesh and number.
inline SurfaceFaults FindDegenerate(const Scene& scene) {
  SurfaceFaults faults;
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3d corner_m = mesh.positions_m[a].cast<double>();
      const double area_m2 = 0.5 * (mesh.positions_m[b].cast<double>() - corner_m)
                                       .cross(mesh.positions_m[c].cast<double>() - corner_m)
                                       .norm();
      ++faults.num_checked;
      if (!(area_m2 > 1e-9)) {
        faults.texts.push_back(fmt::format("{} near ({:.3f}, {:.3f}, {:.3f})",
                                           mesh.name,
                                           corner_m.x(),
                                           corner_m.y(),
                                           corner_m.z()));
      }
    }
  }
  return faults;
}

/// Rays that meet the back of a surface first: holes or wrong winding.
inline SurfaceFaults FindBackFaces(const RayScene& rays,
                                   const std::vector<Vec3d>& origins_m,
                                   int num_each,
                                   double least_z) {
  SurfaceFaults faults;
  RandomStream random(99);
  for (const Vec3d& origin_m : origins_m) {
    for (int i = 0; i < num_each; ++i) {
      const Vec3d direction = RandomDirection(random, least_z);
      const auto hit = rays.Intersect(origin_m, direction);
      ++faults.num_checked;
      if (hit && hit->geometric_normal.dot(direction) > 0.0 &&
          !IsSheet(rays.PlainScene().meshes[hit->mesh_idx])) {
        const Vec3d at_m = origin_m + hit->distance_m * direction;
        faults.texts.push_back(
            fmt::format("back of {} at ({:.3f}, {:.3f}, {:.3f}) from ({:.2f}, {:.2f}, {:.2f})",
                        rays.PlainScene().meshes[hit->mesh_idx].name,
                        at_m.x(),
                        at_m.y(),
                        at_m.z(),
                        origin_m.x(),
                        origin_m.y(),
                        origin_m.z()));
      }
    }
  }
  return faults;
}

/// Rays at all of a thing, from everywhere on one side of it, that meet the back of one of its
/// surfaces first. `hiding` is what it stands or hangs on, where it need not be closed.
inline SurfaceFaults FindBacksFrom(const Vec3d& side,
                                   const Scene& scene,
                                   const Scene& hiding = {}) {
  auto both = std::make_shared<Scene>(scene);
  both->meshes.insert(both->meshes.end(), hiding.meshes.begin(), hiding.meshes.end());
  const RayScene rays(both);
  const Bounds bounds = BoundsOfScene(scene);
  const Vec3d center_m = 0.5 * (bounds.low_m + bounds.high_m).cast<double>();
  /// The mesh whose back is seen.
  const auto back_seen = [&](const Vec3d& target_m, const Vec3d& back) -> const Mesh* {
    const auto hit = rays.Intersect(Vec3d(target_m + 30.0 * back), -back);
    if (!hit || hit->mesh_idx >= scene.meshes.size() || hit->geometric_normal.dot(back) >= 0.0) {
      return nullptr;
    }
    const Mesh& mesh = scene.meshes[hit->mesh_idx];
    return IsSheet(mesh) ? nullptr : &mesh;
  };
  SurfaceFaults faults;
  RandomStream random({8});
  for (int i = 0; i < 20000; ++i) {
    const Vec3d target_m =
        center_m + 0.5 * Vec3d(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1))
                             .cwiseProduct((bounds.high_m - bounds.low_m).cast<double>());
    Vec3d back = RandomDirection(random, -1.0);
    if (back.dot(side) < 0.0) {
      back = -back;
    }
    if (back.dot(side) < 0.02) {
      continue;
    }
    ++faults.num_checked;
    const Mesh* mesh = back_seen(target_m, back);
    // On an edge, both its faces are equally far: what is beside it counts.
    const Vec3d beside_m = 2e-4 * back.unitOrthogonal();
    if (mesh != nullptr && back_seen(target_m + beside_m, back) != nullptr &&
        back_seen(target_m - beside_m, back) != nullptr) {
      faults.texts.push_back(mesh->name);
    }
  }
  return faults;
}

/// Edges of upright pictures that do not read from left to right and from top to bottom.
inline SurfaceFaults FindMirrored(const Scene& pictures) {
  SurfaceFaults faults;
  for (const Mesh& mesh : pictures.meshes) {
    for (const auto& corners : mesh.triangles) {
      const auto edge_m = [&](size_t i) -> Vec3f {
        return mesh.positions_m[corners[(i + 1) % 3]] - mesh.positions_m[corners[i]];
      };
      const Vec3f right = Vec3f::UnitZ().cross(edge_m(0).cross(edge_m(1)).normalized());
      for (size_t i = 0; i < 3; ++i) {
        const Vec2f step = mesh.texcoords.at(corners[(i + 1) % 3]) - mesh.texcoords.at(corners[i]);
        ++faults.num_checked;
        // v grows downwards.
        if (step.x() * edge_m(i).dot(right) < 0.0F || step.y() * edge_m(i).z() > 0.0F ||
            step.norm() == 0.0F) {
          faults.texts.push_back(mesh.name);
        }
      }
    }
  }
  return faults;
}

/// A triangle in a plane, seen along the axis that the plane faces most.
struct FlatTriangle {
  std::array<Vec2d, 3> corners_m;
  double low_m = 0.0;
  double high_m = 0.0;
  double across_low_m = 0.0;
  double across_high_m = 0.0;
  Vec3d normal = Vec3d::UnitZ();
  Vec3d center_m = Vec3d::Zero();
  std::string where;

  /// True when the point lies inside, a millimetre or more from each edge.
  bool Holds(const Vec2d& point_m) const {
    const auto cross = [](const Vec2d& a, const Vec2d& b) { return a.x() * b.y() - a.y() * b.x(); };
    const double area = cross(corners_m[1] - corners_m[0], corners_m[2] - corners_m[0]);
    const double sign = area > 0.0 ? 1.0 : -1.0;
    for (size_t i = 0; i < 3; ++i) {
      const Vec2d edge_m = corners_m[(i + 1) % 3] - corners_m[i];
      if (sign * cross(edge_m, point_m - corners_m[i]) < 1e-3 * edge_m.norm()) {
        return false;
      }
    }
    return true;
  }

  bool Overlaps(const FlatTriangle& other) const {
    constexpr double kSamePlane_m = 1e-4;
    const bool is_apart = high_m <= other.low_m || other.high_m <= low_m ||
                          across_high_m <= other.across_low_m ||
                          other.across_high_m <= across_low_m;
    if (is_apart || std::abs(normal.dot(other.center_m - center_m)) > kSamePlane_m) {
      return false;
    }
    for (size_t i = 0; i < 4; ++i) {
      std::array<double, 3> weights = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
      if (i < 3) {
        weights = {0.1, 0.1, 0.1};
        weights[i] = 0.8;
      }
      const Vec2d point_m =
          weights[0] * corners_m[0] + weights[1] * corners_m[1] + weights[2] * corners_m[2];
      if (other.Holds(point_m)) {
        return true;
      }
    }
    return false;
  }
};

/// Pairs of triangles that lie on one another in one plane (within 0.1 mm) and face the same way.
inline SurfaceFaults FindOverlaps(const Scene& scene) {
  constexpr double kPlane_m = 1e-4;
  using PlaneKey = std::array<int64_t, 4>;
  std::map<PlaneKey, std::vector<FlatTriangle>> planes;
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& corners : mesh.triangles) {
      std::array<Vec3d, 3> points_m;
      for (size_t i = 0; i < 3; ++i) {
        points_m[i] = mesh.positions_m[corners[i]].cast<double>();
      }
      const Vec3d normal =
          (points_m[1] - points_m[0]).cross(points_m[2] - points_m[0]).normalized();
      // The same axis for all triangles of a plane, also of one at 45 degrees.
      const bool is_level = std::abs(normal.z()) > 0.9;
      const int axis = is_level ? 2 : std::abs(normal.x()) > std::abs(normal.y()) + 0.01 ? 0 : 1;
      const double offset_m = normal.dot(points_m[0]);
      FlatTriangle flat;
      flat.normal = normal;
      flat.center_m = (points_m[0] + points_m[1] + points_m[2]) / 3.0;
      for (size_t i = 0; i < 3; ++i) {
        flat.corners_m[i] = {points_m[i][(axis + 1) % 3], points_m[i][(axis + 2) % 3]};
      }
      const auto [low, high] =
          std::minmax({flat.corners_m[0].x(), flat.corners_m[1].x(), flat.corners_m[2].x()});
      flat.low_m = low;
      flat.high_m = high;
      const auto [across_low, across_high] =
          std::minmax({flat.corners_m[0].y(), flat.corners_m[1].y(), flat.corners_m[2].y()});
      flat.across_low_m = across_low;
      flat.across_high_m = across_high;
      flat.where = fmt::format("{} near ({:.3f}, {:.3f}, {:.3f})",
                               mesh.name,
                               points_m[0].x(),
                               points_m[0].y(),
                               points_m[0].z());
      planes[{std::llround(1e3 * normal.x()),
              std::llround(1e3 * normal.y()),
              std::llround(1e3 * normal.z()),
              std::llround(offset_m / kPlane_m)}]
          .push_back(flat);
    }
  }
  SurfaceFaults faults;
  for (auto& [key, triangles] : planes) {
    std::sort(triangles.begin(), triangles.end(), [](const FlatTriangle& a, const FlatTriangle& b) {
      return a.low_m < b.low_m;
    });
    for (size_t i = 0; i < triangles.size(); ++i) {
      ++faults.num_checked;
      for (size_t j = i + 1; j < triangles.size() && triangles[j].low_m < triangles[i].high_m;
           ++j) {
        if (triangles[i].Overlaps(triangles[j]) || triangles[j].Overlaps(triangles[i])) {
          faults.texts.push_back(triangles[i].where + " overlaps " + triangles[j].where);
        }
      }
    }
  }
  return faults;
}

/// Rays towards a front in the plane y = 0 (out is -Y) that miss it or meet a back face; they come
/// from all sides at up to 60 degrees and aim at [0, width] x [low, high] on the plane.
inline SurfaceFaults FindHoles(const Scene& scene, double width_m, double low_m, double high_m) {
  constexpr double kMargin_m = 0.01;
  constexpr double kFar_m = 20.0;
  const RayScene rays(std::make_shared<const Scene>(scene));
  SurfaceFaults faults;
  RandomStream random(77);
  for (int i = 0; i < 20000; ++i) {
    const Vec3d target_m(random.Uniform(kMargin_m, width_m - kMargin_m),
                         0.0,
                         random.Uniform(low_m + kMargin_m, high_m - kMargin_m));
    Vec3d back = Vec3d(random.Uniform(-1.5, 1.5), -1.0, random.Uniform(-1.5, 1.5)).normalized();
    if (target_m.z() + kFar_m * back.z() < low_m) {
      back.z() = -back.z();  // not from under the ground
    }
    const auto hit = rays.Intersect(Vec3d(target_m + kFar_m * back), -back);
    ++faults.num_checked;
    const bool is_sheet = hit && IsSheet(scene.meshes[hit->mesh_idx]);
    if (!hit || (hit->geometric_normal.dot(back) < 0.0 && !is_sheet)) {
      faults.texts.push_back(fmt::format(
          "{} at ({:.3f}, {:.3f})", hit ? "back face" : "hole", target_m.x(), target_m.z()));
    }
  }
  return faults;
}

}  // namespace pfseq
