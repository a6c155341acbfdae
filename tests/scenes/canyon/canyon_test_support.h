// SPDX-License-Identifier: Apache-2.0
// Parts and cities without textures, and what must hold for their triangles.
#pragma once

#include "renderer/core/random.h"
#include "renderer/trace/ray_scene.h"
#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"
#include "scenes/canyon/city.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pfseq {

/// A material of its own for each member, no textures.
inline Palette PlainPalette() {
  Palette palette;
  const auto add = [&](const std::string& name) {
    Material material;
    material.name = name;
    palette.materials.push_back(material);
    palette.texture_size_m.push_back(1.0);
    return static_cast<int>(palette.materials.size()) - 1;
  };
  const auto choices = [&](std::vector<int>& list, const std::string& name, int count) {
    for (int i = 0; i < count; ++i) {
      list.push_back(add(name));
    }
  };
  choices(palette.plaster, "plaster", 2);
  choices(palette.brick, "brick", 3);
  choices(palette.ashlar, "ashlar", 2);
  choices(palette.concrete, "concrete", 2);
  choices(palette.blank_wall, "blank_wall", 2);
  choices(palette.trim, "trim", 3);
  choices(palette.window_frame, "frame", 5);
  choices(palette.door, "door", 1);
  choices(palette.shutter, "shutter", 1);
  choices(palette.awning, "awning", 1);
  choices(palette.shop_front, "shop_front", 1);
  choices(palette.spandrel, "spandrel", 1);
  choices(palette.roof_tile, "roof_tile", 1);
  choices(palette.slate, "slate", 1);
  for (int* member :
       {&palette.roof_metal,    &palette.roof_gravel,  &palette.coping,     &palette.chimney_pot,
        &palette.railing,       &palette.pale_metal,   &palette.gutter,     &palette.roller_blind,
        &palette.window_glass,  &palette.window_framed, &palette.shop_glass, &palette.sign,
        &palette.facade_glass,  &palette.curtain_wall, &palette.asphalt,    &palette.pavement,
        &palette.kerb,          &palette.marking,      &palette.manhole}) {
    *member = add("material");
  }
  return palette;
}

/// Collects what builders of parts make.
struct PartBench {
  Palette palette = PlainPalette();
  MeshBuilder builder = MeshBuilder(palette.texture_size_m);
  CanyonStats stats;

  PartBench() { builder.BeginGroup("part"); }

  BuildContext Context(double detail = 1.0) { return {builder, palette, detail, stats}; }

  Scene TakeScene() {
    Scene scene;
    scene.meshes = builder.TakeMeshes(palette.materials);
    scene.materials = palette.materials;
    return scene;
  }
};

inline Scene PlainCity(const CanyonSpec& canyon, const DriveSpec& drive) {
  PartBench bench;
  BuildCity(bench.Context(canyon.detail), canyon, drive);
  return bench.TakeScene();
}

/// One sixth of the sum of the triangles' determinants: the volume of a closed surface
/// with outward winding.
inline double SignedVolume(const Scene& scene) {
  double sum = 0.0;
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& [a, b, c] : mesh.triangles) {
      sum += mesh.positions_m[a].cast<double>().dot(
          mesh.positions_m[b].cast<double>().cross(mesh.positions_m[c].cast<double>()));
    }
  }
  return sum / 6.0;
}

/// The sum of area vectors; zero for a closed surface.
inline Vec3d AreaVectorSum(const Scene& scene) {
  Vec3d sum = Vec3d::Zero();
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3d corner_m = mesh.positions_m[a].cast<double>();
      sum += 0.5 * (mesh.positions_m[b].cast<double>() - corner_m)
                       .cross(mesh.positions_m[c].cast<double>() - corner_m);
    }
  }
  return sum;
}

struct Bounds {
  Vec3f low_m = Vec3f::Constant(std::numeric_limits<float>::max());
  Vec3f high_m = Vec3f::Constant(std::numeric_limits<float>::lowest());
};

inline Bounds BoundsOfScene(const Scene& scene) {
  Bounds bounds;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3f& position_m : mesh.positions_m) {
      bounds.low_m = bounds.low_m.cwiseMin(position_m);
      bounds.high_m = bounds.high_m.cwiseMax(position_m);
    }
  }
  return bounds;
}

/// A direction on the sphere, at least `least_z` upwards.
inline Vec3d RandomDirection(RandomStream& random, double least_z) {
  const double z = random.Uniform(least_z, 1.0);
  const double angle_rad = random.Uniform(0.0, 2.0 * std::numbers::pi);
  const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {across * std::cos(angle_rad), across * std::sin(angle_rad), z};
}

/// What rays from given points find wrong.
struct RayFaults {
  int num_rays = 0;
  int num_back_faces = 0;
  /// A second triangle of the same facing within 0.1 mm.
  int num_overlaps = 0;
  std::string first;

  void Note(const std::string& text) {
    if (first.empty()) {
      first = text;
    }
  }
};

inline RayFaults ShootRays(const RayScene& rays, const std::vector<Vec3d>& origins_m,
                           int num_each, double least_z, uint64_t seed) {
  constexpr double kSamePlace_m = 1e-4;
  RayFaults faults;
  RandomStream random(seed);
  for (const Vec3d& origin_m : origins_m) {
    for (int i = 0; i < num_each; ++i) {
      const Vec3d direction = RandomDirection(random, least_z);
      const auto hit = rays.Intersect(origin_m, direction);
      ++faults.num_rays;
      if (!hit) {
        continue;
      }
      const Vec3d at_m = origin_m + hit->distance_m * direction;
      const std::string place =
          fmt::format("{} at ({:.3f}, {:.3f}, {:.3f}) from ({:.2f}, {:.2f}, {:.2f})",
                      rays.PlainScene().meshes[hit->mesh_idx].name, at_m.x(), at_m.y(), at_m.z(),
                      origin_m.x(), origin_m.y(), origin_m.z());
      const double cosine = hit->geometric_normal.dot(direction);
      if (cosine > 0.0) {
        ++faults.num_back_faces;
        faults.Note("back face of " + place);
        continue;
      }
      // Just behind the hit, along the normal: at grazing incidence a hair's depth is a long way.
      const double step_m = kSamePlace_m / std::max(0.05, -cosine);
      const auto next = rays.Intersect(at_m + 1e-6 * direction, direction, step_m);
      const bool is_overlap =
          next && std::abs(next->geometric_normal.dot(hit->geometric_normal)) > 0.999;
      if (is_overlap &&
          (next->mesh_idx != hit->mesh_idx || next->triangle_idx != hit->triangle_idx)) {
        ++faults.num_overlaps;
        faults.Note("overlap behind " + place + " with " +
                    rays.PlainScene().meshes[next->mesh_idx].name);
      }
    }
  }
  return faults;
}

}  // namespace pfseq
