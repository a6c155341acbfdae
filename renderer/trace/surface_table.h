// SPDX-License-Identifier: Apache-2.0
// Surfaces as the cached-light renderer shades them: in float, one cache line a triangle, textures
// filtered over the footprint of the ray.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/bsdf.h"
#include "renderer/trace/ray_packet.h"
#include "renderer/trace/scene.h"
#include "renderer/trace/texture.h"

#include <cstdint>
#include <vector>

namespace pfseq {

/// The bundle of directions that a ray stands for. Differences of unit directions.
struct RayFootprint {
  /// From the ray to the bundle's middle, where textures are looked up.
  Vec3f to_middle = Vec3f::Zero();
  /// Width of the bundle along two axes.
  Vec3f axis_x = Vec3f::Zero();
  Vec3f axis_y = Vec3f::Zero();
};

/// A place on a surface seen from one side, all that shading needs. Directions in the world frame.
struct ShadingPoint {
  Vec3f position_m;
  /// Of the triangle, on the viewer's side.
  Vec3f geometric_normal;
  /// With vertex normals and the normal map; the viewer sees it.
  Vec3f normal;
  /// Length of the mean of the unit normals under the footprint: what a cosine to `normal` is
  /// multiplied with to be the mean of their cosines.
  float normal_length = 1.0F;
  BsdfParameters parameters;
  Rgb emission;
  /// Number of the triangle over all meshes.
  uint32_t triangle_idx = 0;
  float u = 0.0F;
  float v = 0.0F;
  /// Whether the viewer sees the triangle counter-clockwise.
  bool is_front = true;

  /// No specular lobe and not a metal: the radiance is that of base_color alone.
  bool IsLambertian() const { return parameters.ior <= 1.0F && parameters.metallic <= 0.0F; }

  /// Where rays that leave the surface start.
  Vec3f RayOriginM() const;
};

class SurfaceTable {
 public:
  /// The scene and its textures must outlive this.
  SurfaceTable(const Scene& scene, const TextureSet& textures);

  /// What a ray along the unit `direction` meets at `hit`, with textures over the footprint.
  ShadingPoint Shade(const PacketHit& hit,
                     const Vec3f& origin_m,
                     const Vec3f& direction,
                     const RayFootprint& footprint) const;

  /// The same with textures over a circle of this diameter, and a least roughness.
  ShadingPoint Shade(const PacketHit& hit,
                     const Vec3f& origin_m,
                     const Vec3f& direction,
                     float footprint_m,
                     float min_roughness) const;

  /// The place alone: triangle, barycentric weights, side and geometric normal.
  ShadingPoint Locate(const PacketHit& hit, const Vec3f& direction) const;

  const Scene& PlainScene() const { return *scene_; }
  size_t NumTriangles() const { return triangles_.size(); }
  uint32_t TriangleIdx(uint32_t mesh_idx, uint32_t triangle_in_mesh) const {
    return first_triangle_[mesh_idx] + triangle_in_mesh;
  }

  /// Mesh of a triangle by its number over all meshes, and its number within the mesh.
  std::pair<uint32_t, uint32_t> MeshAndTriangle(uint32_t triangle_idx) const;

  /// The three corners of a triangle.
  std::array<Vec3f, 3> CornersM(uint32_t triangle_idx) const;

  /// Unit normal of a triangle's front.
  Vec3f Normal(uint32_t triangle_idx) const {
    const Triangle& triangle = triangles_[triangle_idx];
    return {triangle.normal[0], triangle.normal[1], triangle.normal[2]};
  }

  int64_t MemoryBytes() const { return static_cast<int64_t>(triangles_.size() * sizeof(Triangle)); }

 private:
  struct alignas(64) Triangle {
    std::array<float, 3> normal;
    uint32_t material_idx;
    /// Texture coordinates of the first vertex, and the others' differences to it.
    std::array<float, 2> texcoord0;
    std::array<float, 2> texcoord_edge1;
    std::array<float, 2> texcoord_edge2;
    /// In-plane gradients of the texture coordinates per metre.
    std::array<float, 3> gradient_u;
    std::array<float, 3> gradient_v;
  };
  /// Texture coordinates and the two axes of their footprint.
  struct TextureFootprint {
    Vec2f texcoord;
    Vec2f axis_x;
    Vec2f axis_y;
    /// The ray's own footprint is wider than the triangle lets it be.
    bool is_limited = false;
  };

  /// A footprint of these axes about a hit, made no wider than the triangle.
  static TextureFootprint FootprintWithin(const Triangle& triangle,
                                          const PacketHit& hit,
                                          const Vec2f& axis_x,
                                          const Vec2f& axis_y);

  void Finish(const PacketHit& hit,
              const Vec3f& direction,
              const Material& material,
              const TextureFootprint& footprint,
              ShadingPoint& point) const;
  Vec3f MappedNormal(const Material& material,
                     const Triangle& triangle,
                     const TextureFootprint& footprint,
                     const Vec3f& smooth_normal,
                     float& length) const;

  const Scene* scene_;
  const TextureSet* textures_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> first_triangle_;
};

}  // namespace pfseq
