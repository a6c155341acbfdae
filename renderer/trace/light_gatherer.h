// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/random.h"
#include "renderer/core/vector.h"
#include "renderer/trace/coarse_light.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/surface_table.h"
#include "renderer/trace/vector_irradiance.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace pfseq {

struct GatheredLight {
  VectorIrradiance light;
  /// Most of what the point sees it sees from behind: it lies within a body.
  bool is_buried = false;
  /// Harmonic mean distance of what the point sees: how far light stays about the same (Ward,
  /// Rubinstein and Clear 1988, "A Ray Tracing Solution for Diffuse Interreflection").
  float mean_distance_m = std::numeric_limits<float>::infinity();
};

struct GatherOptions {
  /// Rays per record; rounded up to a square of a multiple of 4.
  int num_rays = 256;
  /// Scattering events along a light path at most, the surface the camera sees included.
  int max_bounces = 6;
  /// As PathTracerOptions.
  float min_indirect_roughness = 0.0F;
  /// Surfaces nearer than this to the point, or to the one before on a path, are followed by real
  /// paths: the coarse light does not resolve them.
  float near_m = 1.5F;
  /// Size of the coarse light's patches.
  float patch_m = 2.0F;
};

/// How many of a record's rays are used, about.
enum class ShareOfRays : uint8_t { kAll, kQuarter, kSixteenth };

/// Works out the light that a point on a surface gets from sky and surroundings, all but the sun's
/// own disc: one step of final gathering (Jensen 1996, "Global Illumination using Photon Maps")
/// over a coarse radiosity. Immutable but for the coarse light that it fills on demand.
class LightGatherer {
 public:
  LightGatherer(const RayScene& rays,
                const SurfaceTable& surfaces,
                const Lighting& lighting,
                const GatherOptions& options);

  /// `normal` is the unit normal of the surface on the side asked for, `key` chooses the random
  /// numbers.
  GatheredLight Gather(const Vec3f& origin_m,
                       const Vec3f& normal,
                       uint64_t key,
                       ShareOfRays share = ShareOfRays::kAll) const {
    return GatherBy(RaysAcross(share), origin_m, normal, key);
  }

  /// The same by 16 rays: unbiased, but noisy.
  GatheredLight GatherRoughly(const Vec3f& origin_m, const Vec3f& normal, uint64_t key) const {
    return GatherBy(4, origin_m, normal, key);
  }

  /// How much of what the point sees it sees from behind, by few rays, 0 to 1.
  float ShareFromBehind(const Vec3f& origin_m, const Vec3f& normal, uint64_t key) const;

  int64_t MemoryBytes() const { return coarse_.MemoryBytes(); }

  /// As CoarseLight's, of the coarse light.
  std::string Serialize() const { return coarse_.Serialize(); }
  bool Load(std::string_view& bytes) { return coarse_.Load(bytes); }

 private:
  /// Rows and columns of the grid of rays; multiples of 4.
  int RaysAcross(ShareOfRays share) const;
  GatheredLight GatherBy(int rays_across,
                         const Vec3f& origin_m,
                         const Vec3f& normal,
                         uint64_t key) const;

  /// What a packet of rays meets far off: the radiance of the surfaces, all taken as rough, and
  /// which of them the sun reaches.
  struct FarSurfaces {
    std::array<Rgb, kPacketSize> radiance;
    uint32_t sunlit = 0;
  };

  FarSurfaces ShadeFar(const std::array<ShadingPoint, kPacketSize>& points,
                       uint32_t far,
                       const RayPacket& rays,
                       RandomStream& random) const;
  /// By the coarse light alone.
  Rgb FarReflection(const ShadingPoint& point, const Vec3f& direction) const;
  Rgb SmoothReflection(const ShadingPoint& point,
                       const Vec3f& direction,
                       bool is_sunlit,
                       RandomStream& random) const;
  ShadingPoint ShadeWide(const PacketHit& hit, const Vec3f& origin_m, const Vec3f& direction) const;
  Rgb PathLight(ShadingPoint point,
                Vec3f direction,
                int bounce,
                bool ends_in_coarse_light,
                RandomStream& random) const;
  CoarseLight::PointEstimate CoarseIrradiance(const Vec3f& origin_m,
                                              const Vec3f& normal,
                                              RandomStream& random) const;
  Rgb Sunlight(const ShadingPoint& point, const Vec3f& direction, RandomStream& random) const;
  bool IsSmooth(const ShadingPoint& point) const;

  const RayScene& rays_;
  const SurfaceTable& surfaces_;
  const Lighting& lighting_;
  GatherOptions options_;
  int rays_across_;
  Rgb sun_irradiance_ = Rgb::Zero();
  Vec3f direction_to_sun_ = Vec3f::UnitZ();
  CoarseLight coarse_;
};

}  // namespace pfseq
