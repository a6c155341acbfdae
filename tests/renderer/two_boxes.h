// SPDX-License-Identifier: Apache-2.0
// A small scene and a fisheye above it, for the tests of stored light.
#pragma once

#include "renderer/cached_light.h"
#include "renderer/core/units.h"
#include "renderer/frame_renderer.h"
#include "renderer/lens/lens.h"
#include "renderer/lens/lens_raster.h"
#include "tests/trace/gathered_scene.h"
#include "tests/trace/shapes.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace pfseq {

/// Two Lambertian boxes on a Lambertian floor of 12 m.
inline Scene TwoBoxes() {
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb(0.6F, 0.6F, 0.5F)),
                     LambertianMaterial(Rgb(0.7F, 0.3F, 0.2F)),
                     LambertianMaterial(Rgb(0.2F, 0.4F, 0.7F))};
  scene.meshes = {FloorMesh(6.0F, 0)};
  AddBox({-2.0F, -1.5F, 0.0F}, {1.2F, 2.0F, 1.8F}, 1, &scene.meshes);
  AddBox({0.7F, -0.4F, 0.0F}, {1.5F, 1.1F, 0.9F}, 2, &scene.meshes);
  return scene;
}

inline Lighting TwoBoxesLight() {
  return SunAndConstantSky({0.7, 0.4, 1.0}, Rgb(9.0F, 8.0F, 7.0F), Rgb(0.9F, 1.0F, 1.3F));
}

/// Stored light for tests: coarser and with fewer rays than that of a sequence.
inline RenderSpec CoarseLightSpec() {
  RenderSpec spec;
  spec.light_quality = 0.4;
  return spec;
}

/// A scene with its light and a camera that looks straight down at it from 4 m.
class TwoBoxesStage {
 public:
  static constexpr int kSizePx = 48;

  explicit TwoBoxesStage(Scene scene = TwoBoxes(), Lighting lighting = TwoBoxesLight())
      : lens_(Equidistant{},
              Vec2d::Constant(
                  Lens::FocalFromCirclePx(Equidistant{}, kSizePx - 2.0, RadFromDeg(85.0))),
              Vec2d::Constant(0.5 * kSizePx),
              RadFromDeg(85.0)),
        raster_(lens_, kSizePx, kSizePx, 1),
        rays_(std::make_shared<const Scene>(std::move(scene))),
        textures_(rays_.PlainScene()),
        lighting_(std::move(lighting)) {}

  /// Camera x to the east, y to the south, z down.
  View MakeView(uint64_t frame = 0, const Vec3d& position_m = Vec3d(0.1, 0.2, 4.0)) const {
    Eigen::Matrix3d rotation;
    rotation << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    return {&lens_,
            RigidTransform{Eigen::Quaterniond(rotation), position_m},
            kSizePx,
            kSizePx,
            1,
            frame,
            0};
  }

  std::unique_ptr<CachedLight> MakeCachedLight(const LightCacheOptions& options = {},
                                               const std::string& content_hash = "two boxes",
                                               const RenderSpec& spec = CoarseLightSpec()) const {
    return std::make_unique<CachedLight>(rays_,
                                         textures_,
                                         lighting_,
                                         spec,
                                         std::vector<Vec3d>{{0.1, 0.2, 4.0}},
                                         content_hash,
                                         options);
  }

  const Lens& OwnLens() const { return lens_; }
  const LensRaster& Raster() const { return raster_; }
  const RayScene& Rays() const { return rays_; }
  const TextureSet& Textures() const { return textures_; }
  const Lighting& Light() const { return lighting_; }

 private:
  Lens lens_;
  LensRaster raster_;
  RayScene rays_;
  TextureSet textures_;
  Lighting lighting_;
};

}  // namespace pfseq
