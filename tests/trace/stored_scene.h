// SPDX-License-Identifier: Apache-2.0
// A light store over a scene of its own, for its tests.
#pragma once

#include "renderer/core/random.h"
#include "renderer/trace/light_store.h"
#include "tests/trace/gathered_scene.h"
#include "tests/trace/shapes.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace pfseq {

inline GatherOptions FewRays() {
  GatherOptions options;
  options.num_rays = 64;
  return options;
}

/// A floor of 4 x 3 m, a wall on it and a ball with triangles of all shapes.
inline Scene Yard() {
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb(0.6F, 0.5F, 0.4F)),
                     LambertianMaterial(Rgb(0.1F, 0.7F, 0.2F))};
  scene.meshes = {
      ParallelogramMesh({-2.0F, -1.5F, 0.0F}, {4.0F, 0.0F, 0.0F}, {0.5F, 3.0F, 0.0F}, 0)};
  AddBox({1.6F, -0.9F, 0.0F}, {0.2F, 1.7F, 1.6F}, 1, &scene.meshes);
  scene.meshes.push_back(SphereMesh({-0.8F, 0.4F, 0.6F}, 0.5F, 1));
  return scene;
}

/// A store over a scene of its own.
struct StoredScene {
  explicit StoredScene(const LightStoreOptions& options, Scene scene = Yard())
      : lit(std::move(scene),
            SunAndConstantSky({1.0, 0.3, 1.5}, Rgb::Constant(5.0F), Rgb(0.7F, 0.8F, 1.0F)),
            FewRays()),
        store(lit.surfaces, lit.gatherer, options) {}

  /// What rays at the scene from all sides meet.
  std::vector<ShadingPoint> Points(int num_rays) const {
    std::vector<ShadingPoint> points;
    RandomStream random({8});
    for (int i = 0; i < num_rays; ++i) {
      const double x = random.Uniform(-4.0, 4.0);
      const double y = random.Uniform(-4.0, 4.0);
      const Vec3f origin_m = Vec3d(x, y, random.Uniform(-1.0, 4.0)).cast<float>();
      const double target_x = random.Uniform(-1.8, 1.8);
      const double target_y = random.Uniform(-1.4, 1.4);
      const Vec3f target_m = Vec3d(target_x, target_y, random.Uniform(0.0, 1.0)).cast<float>();
      const Vec3f direction = (target_m - origin_m).normalized();
      const std::optional<PacketHit> hit = lit.rays.Intersect(origin_m, direction);
      if (hit.has_value()) {
        points.push_back(lit.surfaces.Locate(*hit, direction));
      }
    }
    return points;
  }

  std::vector<LightStore::RecordId> Missing(const std::vector<ShadingPoint>& points) {
    std::vector<LightStore::RecordId> missing;
    for (const ShadingPoint& point : points) {
      store.Want(point, LightDetail::kSeen, missing);
    }
    return missing;
  }

  void Compute(const std::vector<LightStore::RecordId>& records, int num_threads) {
    Progress progress("", records.size(), true);
    store.Compute(records, num_threads, progress);
  }

  /// All that is missing, in three rounds: where light changes fast, and faster, shows after the
  /// first and the second.
  std::vector<LightStore::RecordId> ComputeMissing(const std::vector<ShadingPoint>& points,
                                                   int num_threads) {
    std::vector<LightStore::RecordId> all;
    for (int round = 0; round < 3; ++round) {
      const std::vector<LightStore::RecordId> missing = Missing(points);
      Compute(missing, num_threads);
      all.insert(all.end(), missing.begin(), missing.end());
    }
    return all;
  }

  GatheredScene lit;
  LightStore store;
};

inline LightStoreOptions Spacing(float spacing_m) {
  LightStoreOptions options;
  options.spacing_m = spacing_m;
  return options;
}

inline bool IsSame(const VectorIrradiance& a, const VectorIrradiance& b) {
  return (a.x == b.x).all() && (a.y == b.y).all() && (a.z == b.z).all();
}

/// A place on the floor, the first mesh, by shares of its two edges.
inline ShadingPoint FloorPoint(float along_edge1, float along_edge2, bool is_front = true) {
  ShadingPoint point;
  point.is_front = is_front;
  point.geometric_normal = Vec3f(0.0F, 0.0F, is_front ? 1.0F : -1.0F);
  if (along_edge1 >= along_edge2) {
    point.triangle_idx = 0;
    point.u = along_edge1 - along_edge2;
    point.v = along_edge2;
  } else {
    point.triangle_idx = 1;
    point.u = along_edge1;
    point.v = along_edge2 - along_edge1;
  }
  return point;
}

}  // namespace pfseq
