// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/material.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/sampler.h"
#include "renderer/trace/texture.h"

namespace pfseq {

struct PathTracerOptions {
  /// Scattering events along a path at most; light that would need more is left out.
  int max_bounces = 6;
  /// Surfaces that a path meets after its first one count as at least this rough (glTF's
  /// roughness). 0: no bias. 0.3 or so blurs the rare paths from a matt surface by way of a smooth
  /// one to the sun, which otherwise leave bright points where there are few samples.
  float min_indirect_roughness = 0.0F;
};

/// Light along rays by path tracing: at each surface the sun and the sky are sampled once each,
/// both combined with sampling of the BSDF by the power heuristic (Veach 1997, "Robust Monte Carlo
/// Methods for Light Transport Simulation", section 9.2). Surfaces that emit are found by the paths
/// alone. Paths of little weight end by Russian roulette. Immutable: any number of threads may use
/// one.
class PathTracer {
 public:
  /// All must outlive this.
  PathTracer(const RayScene& scene,
             const TextureSet& textures,
             const Lighting& lighting,
             const PathTracerOptions& options);

  /// One estimate of the radiance that arrives at `origin_m` against the unit direction,
  /// always finite.
  Rgb Radiance(const Vec3d& origin_m, const Vec3d& direction, PixelSampler& sampler) const;

 private:
  Rgb EscapedLight(const Vec3d& direction, double bsdf_pdf) const;
  Rgb SunLight(const SurfacePoint& point, const Vec2d& sample) const;
  Rgb SkyLight(const SurfacePoint& point, const Vec2d& sample) const;

  const RayScene& scene_;
  const TextureSet& textures_;
  const Lighting& lighting_;
  PathTracerOptions options_;
};

}  // namespace pfseq
