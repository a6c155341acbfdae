// SPDX-License-Identifier: Apache-2.0
// Parts and cities without textures, and where they lie.
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"
#include "scenes/canyon/city.h"
#include "scenes/canyon/street_plan.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

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
  choices(palette.car_paint, "car_paint", 2);
  choices(palette.cloth, "cloth", 2);
  choices(palette.leaf, "leaf", 2);
  choices(palette.bloom, "leaf_bloom", 1);
  for (int* member : {&palette.roof_metal,    &palette.roof_gravel,  &palette.coping,
                      &palette.chimney_pot,   &palette.railing,      &palette.pale_metal,
                      &palette.gutter,        &palette.roller_blind, &palette.window_glass,
                      &palette.window_framed, &palette.shop_glass,   &palette.sign,
                      &palette.facade_glass,  &palette.curtain_wall, &palette.asphalt,
                      &palette.pavement,      &palette.kerb,         &palette.marking,
                      &palette.manhole,       &palette.car_glass,    &palette.tyre,
                      &palette.tail_lamp,     &palette.head_lamp,    &palette.signal_green,
                      &palette.skin,          &palette.bark,         &palette.wire,
                      &palette.street_picture}) {
    *member = add(fmt::format("single_{}", palette.materials.size()));
  }
  return palette;
}

/// Collects what builders of parts make.
struct PartBench {
  Palette palette = PlainPalette();
  MeshBuilder builder = MeshBuilder(palette.texture_size_m);
  CanyonStats stats;

  PartBench() { builder.BeginGroup("part"); }

  BuildContext Context(double detail = 1.0, double street_life = 1.0) {
    return {builder, palette, detail, stats, nullptr, street_life};
  }

  Scene TakeScene() {
    Scene scene;
    scene.meshes = builder.TakeMeshes(palette.materials);
    scene.materials = palette.materials;
    return scene;
  }
};

inline Scene PlainCity(const CanyonSpec& canyon, const DriveSpec& drive) {
  PartBench bench;
  BuildCity(bench.Context(canyon.detail, canyon.street_life), canyon, drive);
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

/// The part of a scene that has one material.
inline Scene PartOf(const Scene& scene, int material_idx) {
  Scene part;
  part.materials = scene.materials;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.material_idx == material_idx) {
      part.meshes.push_back(mesh);
    }
  }
  return part;
}

/// A house of 14 x 11 m with its street to the south, along X.
inline Building RowHouse(const Palette& palette, FacadeStyle style, uint64_t seed, double detail) {
  Lot lot;
  lot.footprint_m = {{0, 0}, {14, 0}, {14, 11}, {0, 11}};
  lot.edges = {EdgeKind::kStreet, EdgeKind::kParty, EdgeKind::kCourt, EdgeKind::kParty};
  CanyonSpec canyon;
  canyon.detail = detail;
  for (;; ++seed) {
    const Building house = DesignBuilding(lot, canyon, {0.5, 0.5}, palette, seed);
    if (house.style == style) {
      return house;
    }
  }
}

/// Points at eye height along the drive and beside it, over the carriageway.
inline std::vector<Vec3d> EyesAlongDrive(const DriveSpec& drive, double spacing_m) {
  std::vector<Vec3d> eyes_m;
  for (const Vec2d& point_m : SampleDrivePath(drive, spacing_m)) {
    for (const double height_m : {0.6, 1.6, 2.0}) {
      eyes_m.emplace_back(point_m.x(), point_m.y(), height_m);
    }
  }
  return eyes_m;
}

}  // namespace pfseq
