// SPDX-License-Identifier: Apache-2.0
// A scene made ready for rays. The only room that knows Embree is ray_scene.cpp.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/ray_packet.h"
#include "renderer/trace/scene.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

namespace pfseq {

/// Where a ray meets a triangle. Everything is recomputed in double from the stored float vertices,
/// so that the distance is that of the exact plane of the triangle, not of the ray tracer's float
/// arithmetic.
struct RayHit {
  double distance_m = 0.0;
  uint32_t mesh_idx = 0;
  uint32_t triangle_idx = 0;
  /// Barycentric weights of the triangle's second and third vertex.
  double u = 0.0;
  double v = 0.0;
  /// Unit normal of the triangle, right-handed about its vertex order (it may point away from the
  /// ray).
  Vec3d geometric_normal = Vec3d::UnitZ();
};

/// Immutable; queries may run on any number of threads. Holes of alpha-masked materials are looked
/// through. The acceleration structure is built on one thread, because its layout, and with it the
/// choice between triangles that a ray meets at the very same place, must not depend on the number
/// of threads.
class RayScene {
 public:
  /// Builds the acceleration structure; the scene must be valid (Scene::Validate). SystemError when
  /// Embree fails.
  explicit RayScene(std::shared_ptr<const Scene> scene);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// The nearest hit in (0, max_distance_m) along a unit direction, or nothing.
  std::optional<RayHit> Intersect(
      const Vec3d& origin_m,
      const Vec3d& direction,
      double max_distance_m = std::numeric_limits<double>::infinity()) const;

  /// True when anything lies in (0, max_distance_m) along a unit direction.
  bool Occluded(const Vec3d& origin_m,
                const Vec3d& direction,
                double max_distance_m = std::numeric_limits<double>::infinity()) const;

  /// The same for shading, in the ray tracer's float arithmetic.
  std::optional<PacketHit> Intersect(const Vec3f& origin_m, const Vec3f& direction) const;
  bool Occluded(const Vec3f& origin_m, const Vec3f& direction) const;

  /// The nearest hits of eight rays.
  void Intersect(const RayPacket& rays, Coherence coherence, HitPacket& hits) const;

  /// The same place worked out in double from the triangle's vertices, for the given ray.
  RayHit ExactHit(const PacketHit& hit, const Vec3d& origin_m, const Vec3d& direction) const;

  /// Bit i is set when anything lies along ray i.
  uint32_t Occluded(const RayPacket& rays, Coherence coherence) const;

  const Scene& PlainScene() const { return *scene_; }

  /// Bytes that Embree holds for geometry and acceleration structure.
  int64_t MemoryBytes() const;

 private:
  struct Embree;

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace pfseq
