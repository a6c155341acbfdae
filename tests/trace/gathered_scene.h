// SPDX-License-Identifier: Apache-2.0
// A scene with all that stored light needs, in the order in which it is made.
#pragma once

#include "renderer/trace/light_gatherer.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/surface_table.h"
#include "renderer/trace/texture.h"

#include <memory>
#include <optional>
#include <utility>

namespace pfseq {

inline Lighting ConstantSkyLight(const Rgb& radiance) {
  return {std::nullopt, Sky::Constant(radiance)};
}

/// A sun of half a degree under a constant sky.
inline Lighting SunAndConstantSky(const Vec3d& direction_to_sun,
                                  const Rgb& sun_irradiance,
                                  const Rgb& sky_radiance) {
  return {SunDisc(direction_to_sun.normalized(), sun_irradiance, 0.0093),
          Sky::Constant(sky_radiance)};
}

struct GatheredScene {
  GatheredScene(Scene scene, Lighting scene_lighting, const GatherOptions& options = {})
      : rays(std::make_shared<const Scene>(std::move(scene))),
        textures(rays.PlainScene()),
        lighting(std::move(scene_lighting)),
        surfaces(rays.PlainScene(), textures),
        gatherer(rays, surfaces, lighting, options) {}

  RayScene rays;
  TextureSet textures;
  Lighting lighting;
  SurfaceTable surfaces;
  LightGatherer gatherer;
};

}  // namespace pfseq
