// SPDX-License-Identifier: Apache-2.0
// All that shading needs to know about the place where a ray meets the scene.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/bsdf.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/scene.h"
#include "renderer/trace/texture.h"

#include <optional>

namespace pfseq {

/// Two tangents and a normal, right-handed and orthonormal.
struct ShadingFrame {
  /// Any frame about a unit normal: Duff et al. 2017, "Building an Orthonormal Basis, Revisited"
  /// (JCGT 6(1)).
  explicit ShadingFrame(const Vec3d& unit_normal);

  Vec3d ToLocal(const Vec3d& world) const {
    return {tangent.dot(world), bitangent.dot(world), normal.dot(world)};
  }
  Vec3d ToWorld(const Vec3d& local) const {
    return local.x() * tangent + local.y() * bitangent + local.z() * normal;
  }

  Vec3d tangent;
  Vec3d bitangent;
  Vec3d normal;
};

struct TrianglePoint;

/// A place on a surface, seen from the origin of the ray that found it. Both sides of a triangle
/// scatter: normals are turned toward the viewer. Directions are unit vectors in the world frame.
class SurfacePoint {
 public:
  /// `hit` is what the scene's ray tracer said of a ray along `direction`. The material's roughness
  /// is raised to `min_roughness`.
  SurfacePoint(const Scene& scene,
               const TextureSet& textures,
               const RayHit& hit,
               const Vec3d& direction,
               float min_roughness = 0.0F);

  /// BSDF times cosine for light from this direction, and Sample's density for it. Zero where the
  /// geometric and the shading normal disagree on the side, so that no light leaks through.
  BsdfValue Evaluate(const Vec3d& to_light) const;

  /// As Bsdf::Sample, in the world frame.
  std::optional<BsdfSample> Sample(double lobe_sample, const Vec2d& direction_sample) const;

  /// Where rays that leave the surface start: lifted off the triangle by about 0.1 mm at the
  /// world's origin and 1 mm a kilometre away, well above the rounding of positions to float.
  Vec3d RayOriginM() const;

  const Vec3d& PositionM() const { return position_m_; }
  const Vec3d& GeometricNormal() const { return geometric_normal_; }
  const Vec3d& ShadingNormal() const { return frame_.normal; }
  const BsdfParameters& Parameters() const { return parameters_; }
  /// Radiance that the surface itself emits.
  const Rgb& Emission() const { return emission_; }

 private:
  SurfacePoint(const Scene& scene,
               const TextureSet& textures,
               const RayHit& hit,
               const Vec3d& to_viewer,
               const TrianglePoint& point,
               float min_roughness);

  Vec3d position_m_;
  double coordinate_size_m_;
  Vec3d geometric_normal_;
  ShadingFrame frame_;
  BsdfParameters parameters_;
  Rgb emission_;
  Bsdf bsdf_;
};

}  // namespace pfseq
