// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/ray_scene.h"

#include "renderer/core/error.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

namespace pfseq {
namespace {

// One instruction set, and (see Commit) one thread: the acceleration structure, and with it the
// answer where triangles tie, is then the same on every machine.
// Embree limits all of TBB in the process to its number of threads: that limit is put out of the
// way.
constexpr const char* kDeviceConfig = "isa=avx2,threads=1024";

// A ray this close to a triangle's plane (cosine of the angle to its normal) keeps Embree's own
// distance: the exact plane's intersection is not defined by the data any more.
constexpr double kGrazingCosine = 1e-7;

float WrapUnit(float value) { return value - std::floor(value); }

/// Bilinear alpha of a repeating texture, 0 to 1.
float AlphaAt(const Texture& texture, const Vec2f& texcoord) {
  const int width_px = texture.texels.WidthPx();
  const int height_px = texture.texels.HeightPx();
  const float x = WrapUnit(texcoord.x()) * static_cast<float>(width_px) - 0.5F;
  const float y = WrapUnit(texcoord.y()) * static_cast<float>(height_px) - 0.5F;
  const auto x0 = static_cast<int>(std::floor(x));
  const auto y0 = static_cast<int>(std::floor(y));
  const float weight_x = x - static_cast<float>(x0);
  const float weight_y = y - static_cast<float>(y0);
  const auto alpha = [&](int i, int j) {
    return static_cast<float>(
        texture.texels.At((i + width_px) % width_px, (j + height_px) % height_px, 3));
  };
  const float top = (1.0F - weight_x) * alpha(x0, y0) + weight_x * alpha(x0 + 1, y0);
  const float bottom = (1.0F - weight_x) * alpha(x0, y0 + 1) + weight_x * alpha(x0 + 1, y0 + 1);
  return ((1.0F - weight_y) * top + weight_y * bottom) / 255.0F;
}

/// What the hole test of an alpha-masked mesh needs.
struct AlphaMask {
  const Mesh* mesh = nullptr;
  const Texture* texture = nullptr;
  float base_alpha = 1.0F;
  float cutoff = 0.5F;

  bool IsHole(uint32_t triangle_idx, float u, float v) const {
    float alpha = base_alpha;
    if (texture != nullptr && !mesh->texcoords.empty()) {
      const std::array<uint32_t, 3>& triangle = mesh->triangles[triangle_idx];
      const Vec2f texcoord = (1.0F - u - v) * mesh->texcoords[triangle[0]] +
                             u * mesh->texcoords[triangle[1]] + v * mesh->texcoords[triangle[2]];
      alpha *= AlphaAt(*texture, texcoord);
    }
    return alpha < cutoff;
  }
};

void RejectHoles(const RTCFilterFunctionNArguments* arguments) {
  const auto* mask = static_cast<const AlphaMask*>(arguments->geometryUserPtr);
  for (unsigned int i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] != 0 && mask->IsHole(RTCHitN_primID(arguments->hit, arguments->N, i),
                                                 RTCHitN_u(arguments->hit, arguments->N, i),
                                                 RTCHitN_v(arguments->hit, arguments->N, i))) {
      arguments->valid[i] = 0;
    }
  }
}

RTCRay EmbreeRay(const Vec3d& origin_m, const Vec3d& direction, double max_distance_m) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin_m.x());
  ray.org_y = static_cast<float>(origin_m.y());
  ray.org_z = static_cast<float>(origin_m.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = 0.0F;
  ray.tfar = static_cast<float>(max_distance_m);
  ray.mask = ~0U;
  return ray;
}

}  // namespace

struct RayScene::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<AlphaMask> masks;
  std::atomic<int64_t> memory_bytes{0};
  std::string first_error;

  ~Embree() {
    if (scene != nullptr) {
      rtcReleaseScene(scene);
    }
    if (device != nullptr) {
      rtcReleaseDevice(device);
    }
  }

  static void OnError(void* user, RTCError code, const char* text) {
    auto* self = static_cast<Embree*>(user);
    if (self->first_error.empty()) {
      self->first_error = fmt::format("Embree error {}: {}", static_cast<int>(code), text);
    }
  }

  static bool OnMemory(void* user, ssize_t bytes, bool /*post*/) {
    static_cast<Embree*>(user)->memory_bytes += bytes;
    return true;
  }

  void ThrowOnError() const {
    if (!first_error.empty()) {
      throw SystemError("cannot build the scene's acceleration structure: {}", first_error);
    }
  }

  void AddMesh(const Mesh& mesh, AlphaMask* mask);

  /// Builds the acceleration structure on one thread. (Embree's own setting "threads=1" would hold
  /// for every user of TBB in the process.)
  void Commit() const {
    tbb::task_arena arena(1);
    arena.execute([this] { rtcCommitScene(scene); });
  }
};

void RayScene::Embree::AddMesh(const Mesh& mesh, AlphaMask* mask) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* positions = rtcSetNewGeometryBuffer(geometry,
                                            RTC_BUFFER_TYPE_VERTEX,
                                            0,
                                            RTC_FORMAT_FLOAT3,
                                            sizeof(Vec3f),
                                            mesh.positions_m.size());
  void* indices = rtcSetNewGeometryBuffer(geometry,
                                          RTC_BUFFER_TYPE_INDEX,
                                          0,
                                          RTC_FORMAT_UINT3,
                                          3 * sizeof(uint32_t),
                                          mesh.triangles.size());
  if (positions != nullptr && indices != nullptr) {
    std::memcpy(positions, mesh.positions_m.data(), mesh.positions_m.size() * sizeof(Vec3f));
    std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * 3 * sizeof(uint32_t));
  }
  if (mask->mesh != nullptr) {
    rtcSetGeometryUserData(geometry, mask);
    rtcSetGeometryIntersectFilterFunction(geometry, &RejectHoles);
    rtcSetGeometryOccludedFilterFunction(geometry, &RejectHoles);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

RayScene::RayScene(std::shared_ptr<const Scene> scene)
    : scene_(std::move(scene)), embree_(std::make_unique<Embree>()) {
  Embree& embree = *embree_;
  embree.device = rtcNewDevice(kDeviceConfig);
  if (embree.device == nullptr) {
    throw SystemError("cannot start Embree (error {}): a processor with AVX2 is needed",
                      static_cast<int>(rtcGetDeviceError(nullptr)));
  }
  rtcSetDeviceErrorFunction(embree.device, &Embree::OnError, &embree);
  rtcSetDeviceMemoryMonitorFunction(embree.device, &Embree::OnMemory, &embree);
  embree.scene = rtcNewScene(embree.device);
  // Robust: no ray slips through between triangles that share an edge.
  rtcSetSceneFlags(embree.scene, RTC_SCENE_FLAG_ROBUST);
  embree.masks.resize(scene_->meshes.size());
  for (size_t i = 0; i < scene_->meshes.size(); ++i) {
    const Mesh& mesh = scene_->meshes[i];
    const Material& material = scene_->materials[static_cast<size_t>(mesh.material_idx)];
    if (material.alpha_cutoff.has_value()) {
      const int texture_idx = material.base_color_texture_idx;
      embree.masks[i] = {
          &mesh,
          texture_idx < 0 ? nullptr : &scene_->textures[static_cast<size_t>(texture_idx)],
          material.base_alpha,
          *material.alpha_cutoff};
    }
    embree.AddMesh(mesh, &embree.masks[i]);
  }
  embree.ThrowOnError();
  embree.Commit();
  embree.ThrowOnError();
}

RayScene::~RayScene() = default;

std::optional<RayHit> RayScene::Intersect(const Vec3d& origin_m,
                                          const Vec3d& direction,
                                          double max_distance_m) const {
  RTCRayHit query{};
  query.ray = EmbreeRay(origin_m, direction, max_distance_m);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return std::nullopt;
  }
  const Mesh& mesh = scene_->meshes[query.hit.geomID];
  const std::array<uint32_t, 3>& triangle = mesh.triangles[query.hit.primID];
  const Vec3d vertex0 = mesh.positions_m[triangle[0]].cast<double>();
  const Vec3d edge1 = mesh.positions_m[triangle[1]].cast<double>() - vertex0;
  const Vec3d edge2 = mesh.positions_m[triangle[2]].cast<double>() - vertex0;
  const Vec3d normal = edge1.cross(edge2);
  const double squared_norm = normal.squaredNorm();
  const double normal_norm = std::sqrt(squared_norm);

  RayHit hit;
  hit.mesh_idx = query.hit.geomID;
  hit.triangle_idx = query.hit.primID;
  hit.geometric_normal = normal / normal_norm;
  hit.distance_m = query.ray.tfar;
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  const double slope = normal.dot(direction);
  if (std::abs(slope) > kGrazingCosine * normal_norm) {
    const Vec3d to_vertex0 = vertex0 - origin_m;
    hit.distance_m = normal.dot(to_vertex0) / slope;
    const Vec3d offset = hit.distance_m * direction - to_vertex0;
    hit.u = offset.cross(edge2).dot(normal) / squared_norm;
    hit.v = edge1.cross(offset).dot(normal) / squared_norm;
  }
  return hit;
}

bool RayScene::Occluded(const Vec3d& origin_m,
                        const Vec3d& direction,
                        double max_distance_m) const {
  RTCRay ray = EmbreeRay(origin_m, direction, max_distance_m);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(embree_->scene, &context, &ray);
  return ray.tfar < 0.0F;
}

int64_t RayScene::MemoryBytes() const { return embree_->memory_bytes.load(); }

}  // namespace pfseq
