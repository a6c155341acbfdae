// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/light_store.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/sampler.h"
#include "renderer/trace/scatter_packet.h"
#include "renderer/trace/surface_table.h"

#include <array>
#include <vector>

namespace pfseq {

/// Eight camera rays with what they stand for.
struct CameraPacket {
  RayPacket rays;
  std::array<RayFootprint, kPacketSize> footprints;
  /// Supply the random numbers of each ray.
  std::vector<PixelSampler> samplers =
      std::vector<PixelSampler>(kPacketSize, PixelSampler(0, 0, 0, 0, 0));
};

/// Light along camera rays from the light stored on the surfaces: a shadow ray to the sun, the
/// stored skylight and indirect light at the surface, and, where it mirrors, one ray whose hit is
/// shaded in the same way, mirrors in mirrors as long as they count. Where a surface is rough, its
/// specular lobe's reflection of the surroundings is that of their first moments. Any number of
/// threads may use one.
class CachedLightTracer {
 public:
  /// All must outlive this.
  CachedLightTracer(const RayScene& rays,
                    const SurfaceTable& surfaces,
                    const Lighting& lighting,
                    LightStore& store,
                    float min_indirect_roughness,
                    int max_bounces);

  /// One estimate for each active ray of the radiance that arrives along it; others are left as
  /// they are.
  void Radiance(CameraPacket& packet, std::array<Rgb, kPacketSize>& radiance) const;

  /// Appends the records that Radiance would look up and nobody has wanted before.
  void WantRecords(CameraPacket& packet, std::vector<LightStore::RecordId>& missing) const;

  const RayScene& Rays() const { return rays_; }

 private:
  /// Of sky and sun, the sun's times a weight.
  Rgb EscapedLight(const Vec3f& direction, float sun_weight) const;
  /// Of the active surfaces, with `mirroring` those whose specular lobe is traced. The vertex is 0
  /// for what the camera sees, 1 for what is seen in that, and so on; the throughput is the share
  /// of the light there that the camera gets.
  Rgb8 SurfaceLight(const std::array<ShadingPoint, kPacketSize>& points,
                    const ScatterPacket& surface,
                    uint32_t active,
                    uint32_t mirroring,
                    Float8 throughput,
                    int vertex_idx,
                    CameraPacket& packet) const;
  /// What they reflect by stored light and sun; the specular lobe's reflection of the stored light
  /// is left out where that is traced.
  Rgb8 ReflectedLight(const std::array<ShadingPoint, kPacketSize>& points,
                      const ScatterPacket& surface,
                      uint32_t active,
                      Mask8 is_traced,
                      int vertex_idx,
                      CameraPacket& packet) const;
  Rgb8 SunLight(const ScatterPacket& surface,
                uint32_t active,
                int vertex_idx,
                CameraPacket& packet) const;
  /// Rays of specular lobes and what they meet.
  struct MirroredRays {
    ScatterPacket::SpecularSample sample;
    RayPacket rays;
    HitPacket hits;
  };
  MirroredRays FollowMirrors(const ScatterPacket& surface,
                             uint32_t mirroring,
                             int vertex_idx,
                             CameraPacket& packet) const;
  /// What the specular lobes reflect, by a ray each.
  Rgb8 MirroredLight(const ScatterPacket& surface,
                     uint32_t mirroring,
                     Float8 throughput,
                     int vertex_idx,
                     CameraPacket& packet) const;
  /// The surfaces that mirrored rays met.
  std::array<ShadingPoint, kPacketSize> ShadeMirrored(const ScatterPacket& surface,
                                                      const MirroredRays& mirrored,
                                                      const CameraPacket& packet) const;
  void WantMirrored(const ScatterPacket& surface,
                    uint32_t mirroring,
                    Float8 throughput,
                    int vertex_idx,
                    CameraPacket& packet,
                    std::vector<LightStore::RecordId>& missing) const;

  const RayScene& rays_;
  const SurfaceTable& surfaces_;
  const Lighting& lighting_;
  LightStore& store_;
  float min_indirect_roughness_;
  int max_bounces_;
  Rgb sun_irradiance_ = Rgb::Zero();
  Vec3f direction_to_sun_ = Vec3f::UnitZ();
  float sun_pdf_ = 0.0F;
};

}  // namespace pfseq
