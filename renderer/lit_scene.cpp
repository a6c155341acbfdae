// SPDX-License-Identifier: Apache-2.0
#include "renderer/lit_scene.h"

#include "renderer/core/file.h"
#include "renderer/sequence/layout.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/sequence/sequence_schema.h"
#include "renderer/sequence_renderer.h"

namespace pfseq {
namespace {

/// Stands for all that the light in a scene depends on.
std::string LightHash(const SequenceInput& input) {
  LightSpec light = input.spec.light;
  // Its bytes count, not its name.
  light.sky.map.clear();
  std::string text = CanonicalYaml(light);
  for (const DescriptionFile& file : input.files) {
    if (file.name == kSceneFile || file.name == kExrSkyMapFile || file.name == kHdrSkyMapFile) {
      text += Sha256Hex(file.bytes);
    }
  }
  return Sha256Hex(text);
}

std::vector<Vec3d> RigPositionsM(const TrajectorySpec& trajectory) {
  std::vector<Vec3d> positions_m;
  for (const StampedPose& pose : FramePoses(trajectory)) {
    positions_m.push_back(pose.world_from_rig.translation_m);
  }
  return positions_m;
}

}  // namespace

std::string LitSceneKey(const SequenceSpec& spec) {
  SequenceSpec key;
  key.trajectory = spec.trajectory;
  key.scene = spec.scene;
  key.light = spec.light;
  key.render = spec.render;
  const RenderSpec defaults;
  key.render.light = defaults.light;
  key.render.seed = defaults.seed;
  key.render.samples = defaults.samples;
  key.render.max_samples = defaults.max_samples;
  return CanonicalYaml(key);
}

LitScene::LitScene(const SequenceInput& input)
    : key_(LitSceneKey(input.spec)),
      light_hash_(LightHash(input)),
      render_(input.spec.render),
      positions_m_(RigPositionsM(input.spec.trajectory)),
      rays_(input.scene),
      textures_(*input.scene),
      lighting_(input.lighting != nullptr ? input.lighting
                                          : std::make_shared<const Lighting>(
                                                MakeLighting(input.spec.light, input.scene->sun))),
      tracer_(rays_,
              textures_,
              *lighting_,
              PathTracerOptions{.max_bounces = input.spec.render.max_bounces,
                                .min_indirect_roughness =
                                    static_cast<float>(input.spec.render.min_indirect_roughness)}) {
}

CachedLight& LitScene::Stored(const LightCacheOptions& options) {
  if (stored_ == nullptr) {
    stored_ = std::make_unique<CachedLight>(
        rays_, textures_, *lighting_, render_, positions_m_, light_hash_, options);
  }
  return *stored_;
}

}  // namespace pfseq
