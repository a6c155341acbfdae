// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/cached_light.h"
#include "renderer/sequence/sequence_spec.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/path_tracer.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/texture.h"

#include <memory>
#include <string>

namespace pfseq {

struct SequenceInput;

/// The part of a description that scene and light depend on, as text: sequences of which it is the
/// same may share one LitScene. They differ in image, lenses, cameras, shutter, optics, sensor and
/// samples alone.
std::string LitSceneKey(const SequenceSpec& spec);

/// A scene with its light, ready for rays: all that does not depend on cameras.
class LitScene {
 public:
  /// Keeps the input's scene and lighting, nothing else of it.
  explicit LitScene(const SequenceInput& input);
  LitScene(const LitScene&) = delete;
  LitScene& operator=(const LitScene&) = delete;

  const std::string& Key() const { return key_; }
  const RayScene& Rays() const { return rays_; }
  const Lighting& Light() const { return *lighting_; }
  const PathTracer& Tracer() const { return tracer_; }

  /// The stored light; the first call loads it, with its options.
  CachedLight& Stored(const LightCacheOptions& options);

 private:
  std::string key_;
  std::string light_hash_;
  RenderSpec render_;
  std::vector<Vec3d> positions_m_;
  RayScene rays_;
  TextureSet textures_;
  std::shared_ptr<const Lighting> lighting_;
  PathTracer tracer_;
  std::unique_ptr<CachedLight> stored_;
};

}  // namespace pfseq
