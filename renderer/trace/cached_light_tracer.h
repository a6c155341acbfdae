// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/light_store.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/material.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/sampler.h"
#include "renderer/trace/surface_table.h"

#include <array>
#include <optional>
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
/// shaded in the same way without a further one. Where a surface is rough, its specular lobe's
/// reflection of the surroundings is that of their first moments. Any number of threads may use
/// one.
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

  /// Appends the records that Radiance would look up at the first surfaces and nobody has wanted
  /// before.
  void WantRecords(const RayPacket& rays, std::vector<LightStore::RecordId>& missing) const;

 private:
  Rgb EscapedLight(const Vec3f& direction) const;
  /// A shading point with its scattering toward the viewer; no BSDF where it is Lambertian.
  struct Surface {
    Surface(const ShadingPoint& shading_point, const Vec3f& direction);

    /// Whether the specular lobe is to be traced.
    bool Mirrors() const;

    ShadingPoint point;
    Vec3f to_viewer;
    std::optional<ShadingFrame> frame;
    std::optional<Bsdf> bsdf;
    Rgb diffuse = Rgb::Zero();
    Rgb specular = Rgb::Zero();
  };

  void AddReflections(const std::array<std::optional<Surface>, kPacketSize>& surfaces,
                      uint32_t mirroring,
                      CameraPacket& packet,
                      std::array<Rgb, kPacketSize>& radiance) const;
  /// By the stored light alone; the specular lobe's reflection of it is left out where that is
  /// traced.
  Rgb StoredLight(const Surface& surface, bool is_traced) const;
  Rgb SunLight(const Surface& surface, const Vec3f& to_sun) const;
  bool FacesSun(const ShadingPoint& point) const;
  Vec3f SunSample(int vertex_idx, PixelSampler& sampler) const;

  const RayScene& rays_;
  const SurfaceTable& surfaces_;
  const Lighting& lighting_;
  LightStore& store_;
  float min_indirect_roughness_;
  int max_bounces_;
  Rgb sun_irradiance_ = Rgb::Zero();
  Vec3f direction_to_sun_ = Vec3f::UnitZ();
  float sun_cos_radius_ = 2.0F;
};

}  // namespace pfseq
