// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/material.h"

#include "renderer/trace/ray_lift.h"

#include <algorithm>
#include <cmath>

namespace pfseq {

/// The triangle's data at the hit, both interpolated and constant.
struct TrianglePoint {
  TrianglePoint(const Mesh& mesh, const RayHit& hit);

  const std::array<uint32_t, 3>& triangle;
  std::array<Vec3d, 3> corners_m;
  Vec3d position_m;
  Vec2d texcoord = Vec2d::Zero();
};

TrianglePoint::TrianglePoint(const Mesh& mesh, const RayHit& hit)
    : triangle(mesh.triangles[hit.triangle_idx]) {
  for (size_t i = 0; i < 3; ++i) {
    corners_m[i] = mesh.positions_m[triangle[i]].cast<double>();
  }
  const double first_weight = 1.0 - hit.u - hit.v;
  position_m = first_weight * corners_m[0] + hit.u * corners_m[1] + hit.v * corners_m[2];
  if (!mesh.texcoords.empty()) {
    texcoord = first_weight * mesh.texcoords[triangle[0]].cast<double>() +
               hit.u * mesh.texcoords[triangle[1]].cast<double>() +
               hit.v * mesh.texcoords[triangle[2]].cast<double>();
  }
}

namespace {

/// A shading normal is bent until the viewer stands at least this much above it (cosine); from
/// behind it, the BSDF is not defined.
constexpr double kMinViewerCosine = 1e-4;

/// The vertex normals' interpolation, or the triangle's own normal where there are none or they
/// cancel.
Vec3d InterpolatedNormal(const Mesh& mesh, const TrianglePoint& point, const RayHit& hit) {
  if (mesh.normals.empty()) {
    return hit.geometric_normal;
  }
  const Vec3d sum = (1.0 - hit.u - hit.v) * mesh.normals[point.triangle[0]].cast<double>() +
                    hit.u * mesh.normals[point.triangle[1]].cast<double>() +
                    hit.v * mesh.normals[point.triangle[2]].cast<double>();
  const double norm = sum.norm();
  return norm > 1e-6 ? Vec3d(sum / norm) : hit.geometric_normal;
}

/// The normal map's normal in the world. The map's x axis follows growing u, its y axis falling v,
/// since glTF counts v downwards in the image and +y is up (glTF 2.0, section 3.9.3).
Vec3d MappedNormal(const Material& material,
                   const TextureSet& textures,
                   const Mesh& mesh,
                   const TrianglePoint& point,
                   const Vec3d& normal) {
  const Vec2d texcoord0 = mesh.texcoords[point.triangle[0]].cast<double>();
  const Vec2d delta1 = mesh.texcoords[point.triangle[1]].cast<double>() - texcoord0;
  const Vec2d delta2 = mesh.texcoords[point.triangle[2]].cast<double>() - texcoord0;
  const double determinant = delta1.x() * delta2.y() - delta1.y() * delta2.x();
  // The position's derivatives along u and v, but for the same positive factor.
  const double sign = determinant < 0.0 ? -1.0 : 1.0;
  const Vec3d edge1 = sign * (point.corners_m[1] - point.corners_m[0]);
  const Vec3d edge2 = sign * (point.corners_m[2] - point.corners_m[0]);
  const Vec3d along_u = edge1 * delta2.y() - edge2 * delta1.y();
  const Vec3d along_v = edge2 * delta1.x() - edge1 * delta2.x();
  const Vec3d in_plane = along_u - normal * normal.dot(along_u);
  const double norm = in_plane.norm();
  if (determinant == 0.0 || !(norm > 0.0)) {
    return normal;
  }
  const Vec3d tangent = in_plane / norm;
  const Vec3d perpendicular = normal.cross(tangent);
  const Vec3d bitangent = perpendicular.dot(along_v) > 0.0 ? Vec3d(-perpendicular) : perpendicular;
  const Rgba texel = textures.Lookup(material.normal_texture_idx, point.texcoord);
  const double x = (2.0 * texel[0] - 1.0) * material.normal_scale;
  const double y = (2.0 * texel[1] - 1.0) * material.normal_scale;
  const double z = 2.0 * texel[2] - 1.0;
  const Vec3d mapped = x * tangent + y * bitangent + z * normal;
  const double mapped_norm = mapped.norm();
  return mapped_norm > 1e-6 ? Vec3d(mapped / mapped_norm) : normal;
}

/// The shading normal on the viewer's side of the surface.
Vec3d ShadingNormal(const Scene& scene,
                    const TextureSet& textures,
                    const RayHit& hit,
                    const TrianglePoint& point,
                    const Vec3d& to_viewer) {
  const Mesh& mesh = scene.meshes[hit.mesh_idx];
  const Material& material = scene.materials[static_cast<size_t>(mesh.material_idx)];
  const Vec3d smooth = InterpolatedNormal(mesh, point, hit);
  Vec3d normal = smooth;
  if (material.normal_texture_idx >= 0 && !mesh.texcoords.empty()) {
    normal = MappedNormal(material, textures, mesh, point, smooth);
  }
  const bool is_front = hit.geometric_normal.dot(to_viewer) >= 0.0;
  // Vertex normals may point to either side of the triangle; the whole normal is turned as one.
  if ((smooth.dot(hit.geometric_normal) >= 0.0) != is_front) {
    normal = -normal;
  }
  const double viewer_cosine = normal.dot(to_viewer);
  if (viewer_cosine < kMinViewerCosine) {
    // The nearest normal that the viewer just sees.
    const Vec3d in_plane = normal - viewer_cosine * to_viewer;
    const double norm = in_plane.norm();
    normal = norm > 1e-9 ? Vec3d(in_plane / norm + kMinViewerCosine * to_viewer).normalized()
                         : Vec3d(is_front ? hit.geometric_normal : -hit.geometric_normal);
  }
  return normal;
}

BsdfParameters EvaluateMaterial(const Material& material,
                                const TextureSet& textures,
                                const Vec2d& texcoord,
                                bool has_texcoord,
                                float min_roughness) {
  BsdfParameters parameters;
  parameters.base_color = material.base_color;
  parameters.metallic = material.metallic;
  parameters.roughness = material.roughness;
  parameters.ior = material.ior;
  if (has_texcoord && material.base_color_texture_idx >= 0) {
    parameters.base_color *= textures.Lookup(material.base_color_texture_idx, texcoord).head<3>();
  }
  if (has_texcoord && material.metallic_roughness_texture_idx >= 0) {
    const Rgba texel = textures.Lookup(material.metallic_roughness_texture_idx, texcoord);
    parameters.roughness *= texel[1];
    parameters.metallic *= texel[2];
  }
  parameters.roughness = std::max(parameters.roughness, min_roughness);
  return parameters;
}

Rgb EvaluateEmission(const Material& material,
                     const TextureSet& textures,
                     const Vec2d& texcoord,
                     bool has_texcoord) {
  if (!has_texcoord || material.emission_texture_idx < 0) {
    return material.emission;
  }
  return material.emission * textures.Lookup(material.emission_texture_idx, texcoord).head<3>();
}

const Material& MaterialOf(const Scene& scene, const RayHit& hit) {
  return scene.materials[static_cast<size_t>(scene.meshes[hit.mesh_idx].material_idx)];
}

double LargestCoordinateM(const TrianglePoint& point) {
  double largest_m = 0.0;
  for (const Vec3d& corner_m : point.corners_m) {
    largest_m = std::max(largest_m, corner_m.cwiseAbs().maxCoeff());
  }
  return largest_m;
}

}  // namespace

ShadingFrame::ShadingFrame(const Vec3d& unit_normal) : normal(unit_normal) {
  const double sign = std::copysign(1.0, unit_normal.z());
  const double a = -1.0 / (sign + unit_normal.z());
  const double b = unit_normal.x() * unit_normal.y() * a;
  tangent = {1.0 + sign * unit_normal.x() * unit_normal.x() * a, sign * b, -sign * unit_normal.x()};
  bitangent = {b, sign + unit_normal.y() * unit_normal.y() * a, -unit_normal.y()};
}

SurfacePoint::SurfacePoint(const Scene& scene,
                           const TextureSet& textures,
                           const RayHit& hit,
                           const Vec3d& direction,
                           float min_roughness)
    : SurfacePoint(scene,
                   textures,
                   hit,
                   -direction,
                   TrianglePoint(scene.meshes[hit.mesh_idx], hit),
                   min_roughness) {}

SurfacePoint::SurfacePoint(const Scene& scene,
                           const TextureSet& textures,
                           const RayHit& hit,
                           const Vec3d& to_viewer,
                           const TrianglePoint& point,
                           float min_roughness)
    : position_m_(point.position_m),
      coordinate_size_m_(LargestCoordinateM(point)),
      geometric_normal_(hit.geometric_normal.dot(to_viewer) >= 0.0 ? hit.geometric_normal
                                                                   : -hit.geometric_normal),
      frame_(::pfseq::ShadingNormal(scene, textures, hit, point, to_viewer)),
      parameters_(EvaluateMaterial(MaterialOf(scene, hit),
                                   textures,
                                   point.texcoord,
                                   !scene.meshes[hit.mesh_idx].texcoords.empty(),
                                   min_roughness)),
      emission_(EvaluateEmission(MaterialOf(scene, hit),
                                 textures,
                                 point.texcoord,
                                 !scene.meshes[hit.mesh_idx].texcoords.empty())),
      bsdf_(parameters_, frame_.ToLocal(to_viewer)) {}

BsdfValue SurfacePoint::Evaluate(const Vec3d& to_light) const {
  if (geometric_normal_.dot(to_light) <= 0.0) {
    return {};
  }
  return bsdf_.Evaluate(frame_.ToLocal(to_light));
}

std::optional<BsdfSample> SurfacePoint::Sample(double lobe_sample,
                                               const Vec2d& direction_sample) const {
  std::optional<BsdfSample> sample = bsdf_.Sample(lobe_sample, direction_sample);
  if (sample.has_value()) {
    sample->to_light = frame_.ToWorld(sample->to_light).normalized();
    if (geometric_normal_.dot(sample->to_light) <= 0.0) {
      return std::nullopt;
    }
  }
  return sample;
}

Vec3d SurfacePoint::RayOriginM() const {
  // Float coordinates of size x are off by up to 6e-8 x each; a ray tracer in float adds a few
  // times that.
  return position_m_ + (kLeastLiftM + kRelativeLift * coordinate_size_m_) * geometric_normal_;
}

}  // namespace pfseq
