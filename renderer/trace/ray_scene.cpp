// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/ray_scene.h"

#include "renderer/core/error.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
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

RTCRay EmbreeRay(const Vec3f& origin_m, const Vec3f& direction, float max_distance_m) {
  RTCRay ray{};
  ray.org_x = origin_m.x();
  ray.org_y = origin_m.y();
  ray.org_z = origin_m.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = 0.0F;
  ray.tfar = max_distance_m;
  ray.mask = ~0U;
  return ray;
}

void FillPacket(const RayPacket& rays, RTCRay8& query, std::array<int, kPacketSize>& valid) {
  std::copy_n(rays.origin_x_m.data(), kPacketSize, query.org_x);
  std::copy_n(rays.origin_y_m.data(), kPacketSize, query.org_y);
  std::copy_n(rays.origin_z_m.data(), kPacketSize, query.org_z);
  std::copy_n(rays.direction_x.data(), kPacketSize, query.dir_x);
  std::copy_n(rays.direction_y.data(), kPacketSize, query.dir_y);
  std::copy_n(rays.direction_z.data(), kPacketSize, query.dir_z);
  std::fill_n(query.tnear, kPacketSize, 0.0F);
  std::fill_n(query.tfar, kPacketSize, std::numeric_limits<float>::infinity());
  std::fill_n(query.time, kPacketSize, 0.0F);
  std::fill_n(query.mask, kPacketSize, ~0U);
  std::fill_n(query.flags, kPacketSize, 0U);
  for (int i = 0; i < kPacketSize; ++i) {
    valid[static_cast<size_t>(i)] = rays.IsActive(i) ? -1 : 0;
  }
}

RTCIntersectContext PacketContext(Coherence coherence) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherence == Coherence::kCoherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                    : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
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

  std::optional<PacketHit> Intersect(const RTCRay& ray) const {
    RTCRayHit query{};
    query.ray = ray;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
      return std::nullopt;
    }
    return PacketHit{query.hit.geomID, query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v};
  }

  bool Occluded(RTCRay ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0.0F;
  }

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
  const std::optional<PacketHit> hit = embree_->Intersect(EmbreeRay(
      origin_m.cast<float>(), direction.cast<float>(), static_cast<float>(max_distance_m)));
  return hit.has_value() ? std::optional(ExactHit(*hit, origin_m, direction)) : std::nullopt;
}

std::optional<PacketHit> RayScene::Intersect(const Vec3f& origin_m, const Vec3f& direction) const {
  return embree_->Intersect(EmbreeRay(origin_m, direction, std::numeric_limits<float>::infinity()));
}

RayHit RayScene::ExactHit(const PacketHit& found,
                          const Vec3d& origin_m,
                          const Vec3d& direction) const {
  const Mesh& mesh = scene_->meshes[found.mesh_idx];
  const std::array<uint32_t, 3>& triangle = mesh.triangles[found.triangle_idx];
  const Vec3d vertex0 = mesh.positions_m[triangle[0]].cast<double>();
  const Vec3d edge1 = mesh.positions_m[triangle[1]].cast<double>() - vertex0;
  const Vec3d edge2 = mesh.positions_m[triangle[2]].cast<double>() - vertex0;
  const Vec3d normal = edge1.cross(edge2);
  const double squared_norm = normal.squaredNorm();
  const double normal_norm = std::sqrt(squared_norm);

  RayHit hit;
  hit.mesh_idx = found.mesh_idx;
  hit.triangle_idx = found.triangle_idx;
  hit.geometric_normal = normal / normal_norm;
  hit.distance_m = found.distance_m;
  hit.u = found.u;
  hit.v = found.v;
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
  return embree_->Occluded(EmbreeRay(
      origin_m.cast<float>(), direction.cast<float>(), static_cast<float>(max_distance_m)));
}

bool RayScene::Occluded(const Vec3f& origin_m, const Vec3f& direction) const {
  return embree_->Occluded(EmbreeRay(origin_m, direction, std::numeric_limits<float>::infinity()));
}

void RayScene::Intersect(const RayPacket& rays, Coherence coherence, HitPacket& hits) const {
  RTCRayHit8 query;
  alignas(32) std::array<int, kPacketSize> valid;
  FillPacket(rays, query.ray, valid);
  std::fill_n(query.hit.geomID, kPacketSize, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(query.hit.instID[0], kPacketSize, RTC_INVALID_GEOMETRY_ID);
  RTCIntersectContext context = PacketContext(coherence);
  rtcIntersect8(valid.data(), embree_->scene, &context, &query);
  std::copy_n(query.hit.geomID, kPacketSize, hits.mesh_idx.data());
  std::copy_n(query.hit.primID, kPacketSize, hits.triangle_idx.data());
  std::copy_n(query.ray.tfar, kPacketSize, hits.distance_m.data());
  std::copy_n(query.hit.u, kPacketSize, hits.u.data());
  std::copy_n(query.hit.v, kPacketSize, hits.v.data());
  hits.hit = 0;
  for (int i = 0; i < kPacketSize; ++i) {
    hits.hit |= query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? 1U << i : 0U;
  }
  hits.hit &= rays.active;
}

uint32_t RayScene::Occluded(const RayPacket& rays, Coherence coherence) const {
  if (rays.active == 0) {
    return 0;
  }
  RTCRay8 query;
  alignas(32) std::array<int, kPacketSize> valid;
  FillPacket(rays, query, valid);
  RTCIntersectContext context = PacketContext(coherence);
  rtcOccluded8(valid.data(), embree_->scene, &context, &query);
  uint32_t occluded = 0;
  for (int i = 0; i < kPacketSize; ++i) {
    occluded |= query.tfar[i] < 0.0F ? 1U << i : 0U;
  }
  return occluded & rays.active;
}

int64_t RayScene::MemoryBytes() const { return embree_->memory_bytes.load(); }

}  // namespace pfseq
