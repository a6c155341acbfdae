// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/cached_light_tracer.h"

#include "renderer/trace/material.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace pfseq {
namespace {

constexpr float kInversePi = std::numbers::inv_pi_v<float>;

/// The specular lobe is traced below this roughness, and where it gives more than this share of
/// what the surface reflects.
constexpr float kTracedRoughness = 0.5F;
constexpr float kTracedShare = 0.25F;

/// The reflection sampled toward the sun and the sun found by reflected rays are weighed against
/// each other below this roughness; rougher lobes are wide against the sun's disc.
constexpr float kNarrowRoughness = 0.25F;

/// Irradiance of a normal that is tilted against the geometric one. The vector's component is that
/// without the part of the hemisphere below the tilted normal's horizon, where it counts negative;
/// the second term makes up for it, exactly under a uniform sky.
Rgb TiltedIrradiance(const VectorIrradiance& light, const ShadingPoint& point) {
  // The mean normal: both terms are linear in it.
  const Vec3f normal = point.normal_length * point.normal;
  const float cosine = point.geometric_normal.dot(normal);
  Rgb irradiance = light.Along(normal);
  if (cosine < 1.0F) {
    irradiance += (0.5F * (1.0F - cosine)) * light.Along(point.geometric_normal);
  }
  return irradiance.max(0.0F);
}

/// Mean radiance over a wide specular lobe, of the linear field of radiance that has the light's
/// first moments.
Rgb LobeRadiance(const VectorIrradiance& light,
                 const ShadingPoint& point,
                 const Vec3f& to_viewer,
                 const Rgb& irradiance) {
  const Vec3f& normal = point.normal;
  const Vec3f mirrored = 2.0F * normal.dot(to_viewer) * normal - to_viewer;
  // The lobe's main direction: Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based
  // Rendering", section 4.9.3.
  const float smoothness = std::clamp(1.0F - point.parameters.roughness, 0.0F, 1.0F);
  const float share = smoothness * (std::sqrt(smoothness) + point.parameters.roughness);
  const Vec3f lobe = ((1.0F - share) * normal + share * mirrored).normalized();
  const Vec3f in_plane = lobe - lobe.dot(point.geometric_normal) * point.geometric_normal;
  // Of radiance L = a + b . w over the hemisphere, the in-plane moments are 2 pi / 3 b.
  const Rgb mean = irradiance * kInversePi;
  return (mean + light.Along(in_plane) * (1.5F * kInversePi)).max(0.2F * mean);
}

float PowerHeuristic(double pdf, double other_pdf) {
  const double ratio = other_pdf / pdf;
  return static_cast<float>(1.0 / (1.0 + ratio * ratio));
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
    sun_irradiance_ = lighting.sun->Radiance() * static_cast<float>(1.0 / lighting.sun->Pdf());
    direction_to_sun_ = lighting.sun->DirectionToSun().cast<float>();
  }
}

Rgb CachedLightTracer::EscapedLight(const Vec3f& direction) const {
  Rgb light = lighting_.sky.Radiance(direction);
  if (lighting_.sun.has_value() && lighting_.sun->Contains(direction.cast<double>().normalized())) {
    light += lighting_.sun->Radiance();
  }
  return light;
}

CachedLightTracer::Surface::Surface(const ShadingPoint& shading_point, const Vec3f& direction)
    : point(shading_point), to_viewer(-direction) {
  if (!point.IsLambertian()) {
    frame.emplace(point.normal.cast<double>());
    bsdf.emplace(point.parameters, frame->ToLocal(to_viewer.cast<double>()));
    diffuse = bsdf->DiffuseReflectance();
    specular = bsdf->SpecularReflectance();
  } else {
    diffuse = point.parameters.base_color;
  }
}

bool CachedLightTracer::Surface::Mirrors() const {
  return bsdf.has_value() && (point.parameters.roughness < kTracedRoughness ||
                              Luminance(specular) > kTracedShare * Luminance(diffuse + specular));
}

Rgb CachedLightTracer::StoredLight(const Surface& surface, bool is_traced) const {
  const VectorIrradiance light = store_.Lookup(surface.point);
  const Rgb irradiance = TiltedIrradiance(light, surface.point);
  Rgb radiance = surface.diffuse * irradiance * kInversePi;
  if (surface.bsdf.has_value() && !is_traced) {
    radiance +=
        surface.specular * LobeRadiance(light, surface.point, surface.to_viewer, irradiance);
  }
  return radiance;
}

Rgb CachedLightTracer::SunLight(const Surface& surface, const Vec3f& to_sun) const {
  const ShadingPoint& point = surface.point;
  if (!surface.bsdf.has_value()) {
    const float cosine = point.normal_length * std::max(0.0F, point.normal.dot(to_sun));
    return surface.diffuse * sun_irradiance_ * (cosine * kInversePi);
  }
  const Vec3d local = surface.frame->ToLocal(to_sun.cast<double>());
  const BsdfValue specular = surface.bsdf->EvaluateSpecular(local);
  const float weight = point.parameters.roughness < kNarrowRoughness
                           ? PowerHeuristic(lighting_.sun->Pdf(), specular.pdf)
                           : 1.0F;
  return (point.normal_length * surface.bsdf->EvaluateDiffuse(local) +
          specular.value_cosine * weight) *
         sun_irradiance_;
}

bool CachedLightTracer::FacesSun(const ShadingPoint& point) const {
  return lighting_.sun.has_value() && point.normal.dot(direction_to_sun_) > 0.0F &&
         point.geometric_normal.dot(direction_to_sun_) > 0.0F;
}

Vec3f CachedLightTracer::SunSample(int vertex_idx, PixelSampler& sampler) const {
  // The third draw of a vertex, as in the path tracer.
  sampler.StartVertex(vertex_idx);
  sampler.Skip(2);
  return lighting_.sun->SampleDirection(sampler.Get2D()).cast<float>();
}

void CachedLightTracer::Radiance(CameraPacket& packet,
                                 std::array<Rgb, kPacketSize>& radiance) const {
  HitPacket hits;
  rays_.Intersect(packet.rays, Coherence::kCoherent, hits);
  std::array<std::optional<Surface>, kPacketSize> surfaces;
  RayPacket sun_rays;
  uint32_t mirroring = 0;
  for (int i = 0; i < kPacketSize; ++i) {
    if (!packet.rays.IsActive(i)) {
      continue;
    }
    const auto lane = static_cast<size_t>(i);
    const Vec3f direction = packet.rays.Direction(i);
    if (!hits.IsHit(i)) {
      radiance[lane] = EscapedLight(direction);
      continue;
    }
    const Surface& surface = surfaces[lane].emplace(
        surfaces_.Shade(hits.Of(i), packet.rays.Origin(i), direction, packet.footprints[lane]),
        direction);
    radiance[lane] = surface.point.emission;
    if (max_bounces_ < 1) {
      continue;
    }
    const bool is_traced = surface.Mirrors();
    radiance[lane] += StoredLight(surface, is_traced);
    mirroring |= is_traced ? 1U << i : 0U;
    if (FacesSun(surface.point)) {
      sun_rays.Set(i, surface.point.RayOriginM(), SunSample(0, packet.samplers[lane]));
    }
  }
  const uint32_t sunlit = sun_rays.active & ~rays_.Occluded(sun_rays, Coherence::kCoherent);
  for (int i = 0; i < kPacketSize; ++i) {
    if ((sunlit >> i & 1U) != 0) {
      const auto lane = static_cast<size_t>(i);
      radiance[lane] += SunLight(*surfaces[lane], sun_rays.Direction(i));
    }
  }
  if (mirroring != 0) {
    AddReflections(surfaces, mirroring, packet, radiance);
  }
}

void CachedLightTracer::AddReflections(
    const std::array<std::optional<Surface>, kPacketSize>& surfaces,
    uint32_t mirroring,
    CameraPacket& packet,
    std::array<Rgb, kPacketSize>& radiance) const {
  RayPacket rays;
  std::array<BsdfSample, kPacketSize> samples;
  for (int i = 0; i < kPacketSize; ++i) {
    if ((mirroring >> i & 1U) == 0) {
      continue;
    }
    const auto lane = static_cast<size_t>(i);
    const Surface& surface = *surfaces[lane];
    packet.samplers[lane].StartVertex(0);
    const std::optional<BsdfSample> sample =
        surface.bsdf->SampleSpecular(packet.samplers[lane].Get2D());
    if (!sample.has_value()) {
      continue;
    }
    samples[lane] = *sample;
    const Vec3f direction = surface.frame->ToWorld(sample->to_light).normalized().cast<float>();
    if (direction.dot(surface.point.geometric_normal) > 0.0F) {
      rays.Set(i, surface.point.RayOriginM(), direction);
    }
  }
  if (rays.active == 0) {
    return;
  }
  HitPacket hits;
  rays_.Intersect(rays, Coherence::kCoherent, hits);
  std::array<std::optional<Surface>, kPacketSize> seen;
  RayPacket sun_rays;
  std::array<Rgb, kPacketSize> light;
  for (int i = 0; i < kPacketSize; ++i) {
    if (!rays.IsActive(i)) {
      continue;
    }
    const auto lane = static_cast<size_t>(i);
    const Vec3f direction = rays.Direction(i);
    const float roughness = surfaces[lane]->point.parameters.roughness;
    if (!hits.IsHit(i)) {
      light[lane] = lighting_.sky.Radiance(direction);
      if (lighting_.sun.has_value() && roughness < kNarrowRoughness &&
          lighting_.sun->Contains(direction.cast<double>())) {
        light[lane] +=
            lighting_.sun->Radiance() * PowerHeuristic(samples[lane].pdf, lighting_.sun->Pdf());
      }
      continue;
    }
    const PacketHit hit = hits.Of(i);
    // The lobe's width and the camera ray's footprint both widen what the reflection averages.
    const float spread =
        0.5F * roughness * roughness + 2.0F * packet.footprints[lane].axis_x.norm();
    const Surface& surface =
        seen[lane].emplace(surfaces_.Shade(hit,
                                           rays.Origin(i),
                                           direction,
                                           spread * hit.distance_m,
                                           std::max(min_indirect_roughness_, kNarrowRoughness)),
                           direction);
    light[lane] = surface.point.emission;
    if (max_bounces_ < 2) {
      continue;
    }
    light[lane] += StoredLight(surface, false);
    if (FacesSun(surface.point)) {
      sun_rays.Set(i, surface.point.RayOriginM(), SunSample(1, packet.samplers[lane]));
    }
  }
  const uint32_t sunlit = sun_rays.active & ~rays_.Occluded(sun_rays, Coherence::kCoherent);
  for (int i = 0; i < kPacketSize; ++i) {
    const auto lane = static_cast<size_t>(i);
    if ((sunlit >> i & 1U) != 0) {
      light[lane] += SunLight(*seen[lane], sun_rays.Direction(i));
    }
    if (rays.IsActive(i)) {
      radiance[lane] += samples[lane].weight * light[lane];
    }
  }
}

void CachedLightTracer::WantRecords(const RayPacket& rays,
                                    std::vector<LightStore::RecordId>& missing) const {
  HitPacket hits;
  rays_.Intersect(rays, Coherence::kCoherent, hits);
  for (int i = 0; i < kPacketSize; ++i) {
    if (hits.IsHit(i)) {
      store_.Want(surfaces_.Locate(hits.Of(i), rays.Direction(i)), missing);
    }
  }
}

}  // namespace pfseq
