// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/cached_light_tracer.h"

#include <algorithm>
#include <bit>
#include <numbers>

namespace pfseq {
namespace {

constexpr float kInversePi = std::numbers::inv_pi_v<float>;

/// The specular lobe is traced below this roughness, and where it gives more than this share of
/// what the surface reflects.
constexpr float kTracedRoughness = 0.5F;
constexpr float kTracedShare = 0.25F;

/// Mirrors in mirrors are traced where they give the camera more than this of what they reflect.
constexpr float kTracedThroughput = 0.003F;

/// The reflection sampled toward the sun and the sun found by reflected rays are weighed against
/// each other below this roughness; rougher lobes are wide against the sun's disc.
constexpr float kNarrowRoughness = 0.25F;

/// Irradiance of a normal that is tilted against the geometric one. The vector's component is that
/// without the part of the hemisphere below the tilted normal's horizon, where it counts negative;
/// the second term makes up for it, exactly under a uniform sky.
Rgb8 TiltedIrradiance(const LightPacket& light, const ScatterPacket& surface) {
  // The mean normal: both terms are linear in it.
  const Vec3x8 normal = surface.normal_length * surface.normal;
  const Float8 cosine = Dot(surface.geometric_normal, normal);
  const Rgb8 irradiance = light.Along(normal) +
                          (0.5F * Max(1.0F - cosine, 0.0F)) * light.Along(surface.geometric_normal);
  return Max(irradiance, Rgb8{});
}

/// What a wide specular lobe reflects of the linear field of radiance that has the light's first
/// moments.
Rgb8 LobeLight(const LightPacket& light, const ScatterPacket& surface, const Rgb8& irradiance) {
  const Vec3x8 forward = surface.Forward();
  const Vec3x8 in_plane =
      forward - Dot(forward, surface.geometric_normal) * surface.geometric_normal;
  const Rgb8 of_mean = Float8(kInversePi) * (surface.SpecularReflectance() * irradiance);
  // Of radiance L = a + b . w over the hemisphere, the in-plane moments are 2 pi / 3 b.
  const Rgb8 of_slope =
      Float8(1.5F * kInversePi) * (surface.SpecularForward() * light.Along(in_plane));
  return Max(of_mean + of_slope, Float8(0.2F) * of_mean);
}

/// The lanes whose specular lobe is traced.
uint32_t MirroringLanes(const ScatterPacket& surface) {
  const Float8 diffuse = Luminance(surface.DiffuseReflectance());
  const Float8 specular = Luminance(surface.SpecularReflectance());
  return (surface.is_specular & ((surface.roughness < kTracedRoughness) |
                                 (specular > kTracedShare * (diffuse + specular))))
      .Bits();
}

/// Those of what is seen by reflection, of which the camera gets a share.
uint32_t MirroringLanesThatCount(const ScatterPacket& seen, Float8 throughput) {
  const Float8 share = throughput * Luminance(seen.SpecularReflectance());
  return MirroringLanes(seen) & (share > kTracedThroughput).Bits();
}

Float8 PowerHeuristic(Float8 pdf, Float8 other_pdf) {
  const Float8 ratio = other_pdf / pdf;
  return 1.0F / (1.0F + ratio * ratio);
}

/// A pair of random numbers for each lane.
struct Draws {
  Float8 first;
  Float8 second;
};

/// Those of the lanes' samplers at a vertex, after as many others.
Draws Draw2D(uint32_t lanes, int vertex_idx, int num_skipped, CameraPacket& packet) {
  std::array<float, kPacketSize> first{};
  std::array<float, kPacketSize> second{};
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<size_t>(std::countr_zero(lanes));
    PixelSampler& sampler = packet.samplers[lane];
    sampler.StartVertex(vertex_idx);
    sampler.Skip(num_skipped);
    const Vec2d draw = sampler.Get2D();
    first[lane] = static_cast<float>(draw.x());
    second[lane] = static_cast<float>(draw.y());
  }
  return {Float8(first), Float8(second)};
}

}  // namespace

CachedLightTracer::CachedLightTracer(const RayScene& rays,
                                     const SurfaceTable& surfaces,
                                     const Lighting& lighting,
                                     LightStore& store,
                                     float min_indirect_roughness,
                                     int max_bounces)
    : rays_(rays),
      surfaces_(surfaces),
      lighting_(lighting),
      store_(store),
      min_indirect_roughness_(min_indirect_roughness),
      max_bounces_(max_bounces) {
  if (lighting.sun.has_value()) {
    sun_pdf_ = static_cast<float>(lighting.sun->Pdf());
    sun_irradiance_ = lighting.sun->Radiance() / sun_pdf_;
    direction_to_sun_ = lighting.sun->DirectionToSun().cast<float>();
  }
}

Rgb CachedLightTracer::EscapedLight(const Vec3f& direction, float sun_weight) const {
  Rgb light = lighting_.sky.Radiance(direction);
  if (sun_weight > 0.0F && lighting_.sun.has_value() &&
      lighting_.sun->Contains(direction.cast<double>().normalized())) {
    light += sun_weight * lighting_.sun->Radiance();
  }
  return light;
}

Rgb8 CachedLightTracer::ReflectedLight(const std::array<ShadingPoint, kPacketSize>& points,
                                       const ScatterPacket& surface,
                                       uint32_t active,
                                       Mask8 is_traced,
                                       int vertex_idx,
                                       CameraPacket& packet) const {
  const LightDetail detail = vertex_idx == 0 ? LightDetail::kSeen : LightDetail::kReflected;
  std::array<VectorIrradiance, kPacketSize> records;
  for (uint32_t lanes = active; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<size_t>(std::countr_zero(lanes));
    records[lane] = store_.Lookup(points[lane], detail);
  }
  const LightPacket stored(records);
  const Rgb8 irradiance = TiltedIrradiance(stored, surface);
  Rgb8 light = Float8(kInversePi) * (surface.DiffuseReflectance() * irradiance);
  if ((surface.is_specular.Bits() & ~is_traced.Bits() & active) != 0) {
    light = light + Select(is_traced, Rgb8{}, LobeLight(stored, surface, irradiance));
  }
  return lighting_.sun.has_value() ? light + SunLight(surface, active, vertex_idx, packet) : light;
}

Rgb8 CachedLightTracer::SunLight(const ScatterPacket& surface,
                                 uint32_t active,
                                 int vertex_idx,
                                 CameraPacket& packet) const {
  const Vec3x8 to_middle = Broadcast(direction_to_sun_);
  const uint32_t facing = active & ((surface.MeanCosine(to_middle) > 0.0F) &
                                    (Dot(surface.geometric_normal, to_middle) > 0.0F))
                                       .Bits();
  if (facing == 0) {
    return {};
  }
  // The third draw of a vertex, as in the path tracer.
  const Draws draws = Draw2D(facing, vertex_idx, 2, packet);
  const Vec3x8 to_sun = lighting_.sun->SampleDirection(draws.first, draws.second);
  const uint32_t sunlit =
      facing &
      ~rays_.Occluded(MakeRayPacket(surface.RayOriginM(), to_sun, facing), Coherence::kCoherent);
  if (sunlit == 0) {
    return {};
  }
  Rgb8 value = surface.EvaluateDiffuse(to_sun);
  if ((surface.is_specular.Bits() & sunlit) != 0) {
    const ScatterPacket::Specular specular = surface.EvaluateSpecular(to_sun);
    // Where the lobe has no density it has no value either.
    const Float8 weight = Select((surface.roughness < kNarrowRoughness) & (specular.pdf > 0.0F),
                                 PowerHeuristic(sun_pdf_, specular.pdf),
                                 1.0F);
    value = value + weight * specular.value_cosine;
  }
  return Select(Mask8::FromBits(sunlit), value * Broadcast(sun_irradiance_), Rgb8{});
}

Rgb8 CachedLightTracer::SurfaceLight(const std::array<ShadingPoint, kPacketSize>& points,
                                     const ScatterPacket& surface,
                                     uint32_t active,
                                     uint32_t mirroring,
                                     Float8 throughput,
                                     int vertex_idx,
                                     CameraPacket& packet) const {
  if (max_bounces_ <= vertex_idx) {
    return surface.emission;
  }
  const Rgb8 light =
      surface.emission +
      ReflectedLight(points, surface, active, Mask8::FromBits(mirroring), vertex_idx, packet);
  if (mirroring == 0) {
    return light;
  }
  return light + MirroredLight(surface, mirroring, throughput, vertex_idx, packet);
}

CachedLightTracer::MirroredRays CachedLightTracer::FollowMirrors(const ScatterPacket& surface,
                                                                 uint32_t mirroring,
                                                                 int vertex_idx,
                                                                 CameraPacket& packet) const {
  const Draws draws = Draw2D(mirroring, vertex_idx, 0, packet);
  MirroredRays mirrored;
  mirrored.sample = surface.SampleSpecular(draws.first, draws.second);
  mirrored.rays = MakeRayPacket(
      surface.RayOriginM(), mirrored.sample.to_light, mirroring & mirrored.sample.is_valid.Bits());
  if (mirrored.rays.active != 0) {
    rays_.Intersect(mirrored.rays, Coherence::kCoherent, mirrored.hits);
  }
  return mirrored;
}

std::array<ShadingPoint, kPacketSize> CachedLightTracer::ShadeMirrored(
    const ScatterPacket& surface, const MirroredRays& mirrored, const CameraPacket& packet) const {
  const std::array<float, kPacketSize> roughness = surface.roughness.Values();
  std::array<ShadingPoint, kPacketSize> points;
  for (uint32_t lanes = mirrored.hits.hit; lanes != 0; lanes &= lanes - 1) {
    const int i = std::countr_zero(lanes);
    const auto lane = static_cast<size_t>(i);
    const PacketHit hit = mirrored.hits.Of(i);
    // The lobe's width and the camera ray's footprint both widen what the reflection averages.
    const float spread =
        0.5F * roughness[lane] * roughness[lane] + 2.0F * packet.footprints[lane].axis_x.norm();
    points[lane] = surfaces_.Shade(hit,
                                   mirrored.rays.Origin(i),
                                   mirrored.rays.Direction(i),
                                   spread * hit.distance_m,
                                   std::max(min_indirect_roughness_, kNarrowRoughness));
  }
  return points;
}

Rgb8 CachedLightTracer::MirroredLight(const ScatterPacket& surface,
                                      uint32_t mirroring,
                                      Float8 throughput,
                                      int vertex_idx,
                                      CameraPacket& packet) const {
  const MirroredRays mirrored = FollowMirrors(surface, mirroring, vertex_idx, packet);
  const auto& [sample, rays, hits] = mirrored;
  if (rays.active == 0) {
    return {};
  }
  const std::array<float, kPacketSize> sun_weights =
      Select(surface.roughness < kNarrowRoughness, PowerHeuristic(sample.pdf, sun_pdf_), 0.0F)
          .Values();
  std::array<Rgb, kPacketSize> escaped;
  escaped.fill(Rgb::Zero());
  for (uint32_t lanes = rays.active & ~hits.hit; lanes != 0; lanes &= lanes - 1) {
    const int i = std::countr_zero(lanes);
    const auto lane = static_cast<size_t>(i);
    escaped[lane] = EscapedLight(rays.Direction(i), sun_weights[lane]);
  }
  Rgb8 light = Transposed(escaped);
  if (hits.hit != 0) {
    const std::array<ShadingPoint, kPacketSize> points = ShadeMirrored(surface, mirrored, packet);
    const ScatterPacket seen(points, hits.hit, rays);
    const Float8 seen_throughput = throughput * Luminance(sample.weight);
    const Rgb8 reflected = SurfaceLight(points,
                                        seen,
                                        hits.hit,
                                        MirroringLanesThatCount(seen, seen_throughput) & hits.hit,
                                        seen_throughput,
                                        vertex_idx + 1,
                                        packet);
    light = Select(Mask8::FromBits(hits.hit), reflected, light);
  }
  return Select(Mask8::FromBits(rays.active), sample.weight * light, Rgb8{});
}

void CachedLightTracer::Radiance(CameraPacket& packet,
                                 std::array<Rgb, kPacketSize>& radiance) const {
  HitPacket hits;
  rays_.Intersect(packet.rays, Coherence::kCoherent, hits);
  std::array<ShadingPoint, kPacketSize> points;
  for (uint32_t lanes = packet.rays.active; lanes != 0; lanes &= lanes - 1) {
    const int i = std::countr_zero(lanes);
    const auto lane = static_cast<size_t>(i);
    if (hits.IsHit(i)) {
      points[lane] = surfaces_.Shade(
          hits.Of(i), packet.rays.Origin(i), packet.rays.Direction(i), packet.footprints[lane]);
    } else {
      radiance[lane] = EscapedLight(packet.rays.Direction(i), 1.0F);
    }
  }
  if (hits.hit == 0) {
    return;
  }
  const ScatterPacket surface(points, hits.hit, packet.rays);
  const std::array<Rgb, kPacketSize> colors = Transposed(
      SurfaceLight(points, surface, hits.hit, MirroringLanes(surface) & hits.hit, 1.0F, 0, packet));
  for (uint32_t lanes = hits.hit; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<size_t>(std::countr_zero(lanes));
    radiance[lane] = colors[lane];
  }
}

void CachedLightTracer::WantRecords(CameraPacket& packet,
                                    std::vector<LightStore::RecordId>& missing) const {
  if (max_bounces_ < 1) {
    return;
  }
  HitPacket hits;
  rays_.Intersect(packet.rays, Coherence::kCoherent, hits);
  if (hits.hit == 0) {
    return;
  }
  std::array<ShadingPoint, kPacketSize> points;
  for (uint32_t lanes = hits.hit; lanes != 0; lanes &= lanes - 1) {
    const int i = std::countr_zero(lanes);
    const auto lane = static_cast<size_t>(i);
    points[lane] = surfaces_.Shade(
        hits.Of(i), packet.rays.Origin(i), packet.rays.Direction(i), packet.footprints[lane]);
    store_.Want(points[lane], LightDetail::kSeen, missing);
  }
  const ScatterPacket surface(points, hits.hit, packet.rays);
  WantMirrored(surface, MirroringLanes(surface) & hits.hit, 1.0F, 0, packet, missing);
}

void CachedLightTracer::WantMirrored(const ScatterPacket& surface,
                                     uint32_t mirroring,
                                     Float8 throughput,
                                     int vertex_idx,
                                     CameraPacket& packet,
                                     std::vector<LightStore::RecordId>& missing) const {
  if (mirroring == 0 || max_bounces_ <= vertex_idx + 1) {
    return;
  }
  const MirroredRays mirrored = FollowMirrors(surface, mirroring, vertex_idx, packet);
  const uint32_t hit = mirrored.hits.hit;
  if (hit == 0) {
    return;
  }
  const std::array<ShadingPoint, kPacketSize> points = ShadeMirrored(surface, mirrored, packet);
  for (uint32_t lanes = hit; lanes != 0; lanes &= lanes - 1) {
    store_.Want(
        points[static_cast<size_t>(std::countr_zero(lanes))], LightDetail::kReflected, missing);
  }
  const ScatterPacket seen(points, hit, mirrored.rays);
  const Float8 seen_throughput = throughput * Luminance(mirrored.sample.weight);
  WantMirrored(seen,
               MirroringLanesThatCount(seen, seen_throughput) & hit,
               seen_throughput,
               vertex_idx + 1,
               packet,
               missing);
}

}  // namespace pfseq
