// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/surface_table.h"

#include "renderer/trace/ray_lift.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

/// As in SurfacePoint: a shading normal is bent until the viewer stands this much above it.
constexpr float kMinViewerCosine = 1e-4F;

/// Slopes of the texture plane to the ray beyond this (cosine) are not followed: the footprint of a
/// grazing ray has no end.
constexpr float kMinSlope = 0.02F;

/// Textures are averaged over no more than this share of the root of a triangle's area in them:
/// what lies beside a leaf in an atlas does not belong to the leaf, however small it is seen.
constexpr float kMaxFootprintShare = 0.125F;

Vec3f AsVector(const std::array<float, 3>& values) { return {values[0], values[1], values[2]}; }
Vec2f AsVector(const std::array<float, 2>& values) { return {values[0], values[1]}; }

}  // namespace

Vec3f ShadingPoint::RayOriginM() const {
  const float lift_m = static_cast<float>(kLeastLiftM) +
                       static_cast<float>(kRelativeLift) * position_m.cwiseAbs().maxCoeff();
  return position_m + lift_m * geometric_normal;
}

SurfaceTable::SurfaceTable(const Scene& scene, const TextureSet& textures)
    : scene_(&scene), textures_(&textures) {
  triangles_.reserve(scene.NumTriangles());
  for (const Mesh& mesh : scene.meshes) {
    first_triangle_.push_back(static_cast<uint32_t>(triangles_.size()));
    for (const std::array<uint32_t, 3>& indices : mesh.triangles) {
      const Vec3d corner0 = mesh.positions_m[indices[0]].cast<double>();
      const Vec3d edge1 = mesh.positions_m[indices[1]].cast<double>() - corner0;
      const Vec3d edge2 = mesh.positions_m[indices[2]].cast<double>() - corner0;
      const Vec3d area_normal = edge1.cross(edge2);
      const double squared_norm = area_normal.squaredNorm();
      Triangle triangle{};
      triangle.material_idx = static_cast<uint32_t>(mesh.material_idx);
      if (squared_norm > 0.0) {
        const Vec3f normal = (area_normal / std::sqrt(squared_norm)).cast<float>();
        triangle.normal = {normal.x(), normal.y(), normal.z()};
      } else {
        triangle.normal = {0.0F, 0.0F, 1.0F};
      }
      if (!mesh.texcoords.empty()) {
        // Near zero, so that float holds fine differences: whole turns of a repeating texture
        // do not matter.
        const Vec2d start = mesh.texcoords[indices[0]].cast<double>();
        const Vec2d texcoord0 = start - Vec2d(std::floor(start.x()), std::floor(start.y()));
        const Vec2d delta1 = mesh.texcoords[indices[1]].cast<double>() - start;
        const Vec2d delta2 = mesh.texcoords[indices[2]].cast<double>() - start;
        triangle.texcoord0 = {static_cast<float>(texcoord0.x()), static_cast<float>(texcoord0.y())};
        triangle.texcoord_edge1 = {static_cast<float>(delta1.x()), static_cast<float>(delta1.y())};
        triangle.texcoord_edge2 = {static_cast<float>(delta2.x()), static_cast<float>(delta2.y())};
        if (squared_norm > 0.0) {
          // The in-plane vector g with g . edge1 = delta1 and g . edge2 = delta2.
          const Vec3d across2 = edge2.cross(area_normal) / squared_norm;
          const Vec3d across1 = edge1.cross(area_normal) / squared_norm;
          const Vec3f u = (delta1.x() * across2 - delta2.x() * across1).cast<float>();
          const Vec3f v = (delta1.y() * across2 - delta2.y() * across1).cast<float>();
          triangle.gradient_u = {u.x(), u.y(), u.z()};
          triangle.gradient_v = {v.x(), v.y(), v.z()};
        }
      }
      triangles_.push_back(triangle);
    }
  }
}

std::pair<uint32_t, uint32_t> SurfaceTable::MeshAndTriangle(uint32_t triangle_idx) const {
  const auto next = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), triangle_idx);
  const auto mesh_idx = static_cast<uint32_t>(next - first_triangle_.begin() - 1);
  return {mesh_idx, triangle_idx - first_triangle_[mesh_idx]};
}

std::array<Vec3f, 3> SurfaceTable::CornersM(uint32_t triangle_idx) const {
  const auto [mesh_idx, in_mesh] = MeshAndTriangle(triangle_idx);
  const Mesh& mesh = scene_->meshes[mesh_idx];
  const std::array<uint32_t, 3>& indices = mesh.triangles[in_mesh];
  return {mesh.positions_m[indices[0]], mesh.positions_m[indices[1]], mesh.positions_m[indices[2]]};
}

ShadingPoint SurfaceTable::Locate(const PacketHit& hit, const Vec3f& direction) const {
  ShadingPoint point;
  point.triangle_idx = TriangleIdx(hit.mesh_idx, hit.triangle_idx);
  point.u = hit.u;
  point.v = hit.v;
  const Vec3f normal = AsVector(triangles_[point.triangle_idx].normal);
  point.is_front = normal.dot(direction) <= 0.0F;
  point.geometric_normal = point.is_front ? normal : Vec3f(-normal);
  return point;
}

ShadingPoint SurfaceTable::Shade(const PacketHit& hit,
                                 const Vec3f& origin_m,
                                 const Vec3f& direction,
                                 const RayFootprint& footprint) const {
  ShadingPoint point = Locate(hit, direction);
  point.position_m = origin_m + hit.distance_m * direction;
  const Triangle& triangle = triangles_[point.triangle_idx];
  const Material& material = scene_->materials[triangle.material_idx];
  // A change of direction moves the hit by t (change - direction (n . change) / (n . direction)).
  const Vec3f& normal = point.geometric_normal;
  const float inverse_slope = -1.0F / std::max(kMinSlope, -normal.dot(direction));
  const Vec3f gradient_u = AsVector(triangle.gradient_u);
  const Vec3f gradient_v = AsVector(triangle.gradient_v);
  const Vec2f along(gradient_u.dot(direction), gradient_v.dot(direction));
  const auto texcoord_change = [&](const Vec3f& change) -> Vec2f {
    const float sliding = normal.dot(change) * inverse_slope;
    return hit.distance_m *
           (Vec2f(gradient_u.dot(change), gradient_v.dot(change)) - sliding * along);
  };
  TextureFootprint texture = FootprintWithin(
      triangle, hit, texcoord_change(footprint.axis_x), texcoord_change(footprint.axis_y));
  if (!texture.is_limited) {
    texture.texcoord += texcoord_change(footprint.to_middle);
  }
  Finish(hit, direction, material, texture, point);
  return point;
}

ShadingPoint SurfaceTable::Shade(const PacketHit& hit,
                                 const Vec3f& origin_m,
                                 const Vec3f& direction,
                                 float footprint_m,
                                 float min_roughness) const {
  ShadingPoint point = Locate(hit, direction);
  point.position_m = origin_m + hit.distance_m * direction;
  const Triangle& triangle = triangles_[point.triangle_idx];
  const Material& material = scene_->materials[triangle.material_idx];
  const float per_metre = std::max(AsVector(triangle.gradient_u).squaredNorm(),
                                   AsVector(triangle.gradient_v).squaredNorm());
  const float width = footprint_m * std::sqrt(per_metre);
  Finish(hit,
         direction,
         material,
         FootprintWithin(triangle, hit, {width, 0.0F}, {0.0F, width}),
         point);
  point.parameters.roughness = std::max(point.parameters.roughness, min_roughness);
  return point;
}

SurfaceTable::TextureFootprint SurfaceTable::FootprintWithin(const Triangle& triangle,
                                                             const PacketHit& hit,
                                                             const Vec2f& axis_x,
                                                             const Vec2f& axis_y) {
  const std::array<float, 2>& edge1 = triangle.texcoord_edge1;
  const std::array<float, 2>& edge2 = triangle.texcoord_edge2;
  const float area = 0.5F * std::abs(edge1[0] * edge2[1] - edge1[1] * edge2[0]);
  const float squared_limit = kMaxFootprintShare * kMaxFootprintShare * area;
  const float squared = std::max(axis_x.squaredNorm(), axis_y.squaredNorm());
  TextureFootprint footprint;
  footprint.texcoord = AsVector(triangle.texcoord0) + hit.u * AsVector(triangle.texcoord_edge1) +
                       hit.v * AsVector(triangle.texcoord_edge2);
  footprint.is_limited = squared > squared_limit;
  const float scale = footprint.is_limited ? std::sqrt(squared_limit / squared) : 1.0F;
  footprint.axis_x = scale * axis_x;
  footprint.axis_y = scale * axis_y;
  return footprint;
}

void SurfaceTable::Finish(const PacketHit& hit,
                          const Vec3f& direction,
                          const Material& material,
                          const TextureFootprint& footprint,
                          ShadingPoint& point) const {
  const Mesh& mesh = scene_->meshes[hit.mesh_idx];
  const Triangle& triangle = triangles_[point.triangle_idx];
  const bool has_texcoord = !mesh.texcoords.empty();
  const auto texel = [&](int texture_idx) {
    return textures_->LookupFiltered(
        texture_idx, footprint.texcoord, footprint.axis_x, footprint.axis_y);
  };
  point.parameters = {material.base_color, material.metallic, material.roughness, material.ior};
  point.emission = material.emission;
  if (has_texcoord) {
    if (material.base_color_texture_idx >= 0) {
      point.parameters.base_color *= texel(material.base_color_texture_idx).head<3>();
    }
    if (material.metallic_roughness_texture_idx >= 0) {
      const Rgba values = texel(material.metallic_roughness_texture_idx);
      point.parameters.roughness *= values[1];
      point.parameters.metallic *= values[2];
    }
    if (material.emission_texture_idx >= 0) {
      point.emission *= texel(material.emission_texture_idx).head<3>();
    }
  }

  point.normal = point.geometric_normal;
  const bool is_mapped = has_texcoord && material.normal_texture_idx >= 0;
  if (mesh.normals.empty() && !is_mapped) {
    return;
  }
  Vec3f smooth = AsVector(triangle.normal);
  if (!mesh.normals.empty()) {
    const std::array<uint32_t, 3>& indices = mesh.triangles[hit.triangle_idx];
    const Vec3f sum = (1.0F - hit.u - hit.v) * mesh.normals[indices[0]] +
                      hit.u * mesh.normals[indices[1]] + hit.v * mesh.normals[indices[2]];
    const float norm = sum.norm();
    smooth = norm > 1e-6F ? Vec3f(sum / norm) : smooth;
  }
  Vec3f normal = smooth;
  if (is_mapped) {
    normal = MappedNormal(material, triangle, footprint, smooth, point.normal_length);
    // Normals that spread under the footprint widen the lobe by their slopes' variance, as
    // Beckmann's alpha counts it: Olano and Baker 2010, "LEAN Mapping", and Toksvig 2005,
    // "Mipmapping Normal Maps", for the variance from the mean's length.
    const float alpha = point.parameters.roughness * point.parameters.roughness;
    const float widened =
        std::sqrt(alpha * alpha + 2.0F * std::max(0.0F, 1.0F - point.normal_length));
    point.parameters.roughness = std::sqrt(std::min(1.0F, widened));
  }
  // Vertex normals may point to either side of the triangle; the whole normal is turned as one.
  if (smooth.dot(point.geometric_normal) < 0.0F) {
    normal = -normal;
  }
  const float viewer_cosine = -normal.dot(direction);
  if (viewer_cosine < kMinViewerCosine) {
    const Vec3f in_plane = normal + viewer_cosine * direction;
    const float norm = in_plane.norm();
    normal = norm > 1e-6F ? Vec3f(in_plane / norm - kMinViewerCosine * direction).normalized()
                          : point.geometric_normal;
  }
  point.normal = normal;
}

Vec3f SurfaceTable::MappedNormal(const Material& material,
                                 const Triangle& triangle,
                                 const TextureFootprint& footprint,
                                 const Vec3f& smooth_normal,
                                 float& length) const {
  // As SurfacePoint's: x along growing u, y along falling v.
  const Vec3f gradient_u = AsVector(triangle.gradient_u);
  const Vec3f gradient_v = AsVector(triangle.gradient_v);
  const Vec3f triangle_normal = AsVector(triangle.normal);
  // The direction in which u grows and v stays lies across v's gradient.
  Vec3f along_u = gradient_v.cross(triangle_normal);
  if (along_u.dot(gradient_u) < 0.0F) {
    along_u = -along_u;
  }
  const Vec3f in_plane = along_u - smooth_normal * smooth_normal.dot(along_u);
  const float norm = in_plane.norm();
  if (!(norm > 0.0F) || gradient_u.squaredNorm() == 0.0F) {
    return smooth_normal;
  }
  const Vec3f tangent = in_plane / norm;
  const Vec3f perpendicular = smooth_normal.cross(tangent);
  const Vec3f bitangent =
      perpendicular.dot(gradient_v) > 0.0F ? Vec3f(-perpendicular) : perpendicular;
  const Rgba texel = textures_->LookupFiltered(
      material.normal_texture_idx, footprint.texcoord, footprint.axis_x, footprint.axis_y);
  const float x = (2.0F * texel[0] - 1.0F) * material.normal_scale;
  const float y = (2.0F * texel[1] - 1.0F) * material.normal_scale;
  const float z = 2.0F * texel[2] - 1.0F;
  const Vec3f mapped = x * tangent + y * bitangent + z * smooth_normal;
  const float mapped_norm = mapped.norm();
  length = std::clamp(mapped_norm, 0.0F, 1.0F);
  return mapped_norm > 1e-6F ? Vec3f(mapped / mapped_norm) : smooth_normal;
}

}  // namespace pfseq
