// SPDX-License-Identifier: Apache-2.0
#include "renderer/studio.h"

#include "renderer/core/file.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/sequence/sequence_schema.h"

namespace pfseq {
namespace {

/// Standard error of a pixel at which it gets no more samples, relative to its value.
constexpr float kNoiseTolerance = 0.06F;

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

}  // namespace

Studio::Studio(const SequenceInput& input, int num_threads)
    : input_(input),
      spec_(input.spec),
      rig_(MakeRigFile(input.spec)),
      poses_(FramePoses(input.spec.trajectory)),
      trajectory_(MakeTrajectory(input.spec.trajectory)),
      scene_(input.scene),
      textures_(*input.scene),
      lighting_(input.lighting != nullptr ? input.lighting
                                          : std::make_shared<const Lighting>(
                                                MakeLighting(input.spec.light, input.scene->sun))),
      tracer_(scene_,
              textures_,
              *lighting_,
              PathTracerOptions{.max_bounces = input.spec.render.max_bounces,
                                .min_indirect_roughness =
                                    static_cast<float>(input.spec.render.min_indirect_roughness)}) {
  for (const auto& lens : rig_.lenses) {
    rasters_.push_back(
        std::make_unique<LensRaster>(lens.value, rig_.width_px, rig_.height_px, num_threads));
    optics_.push_back(std::make_unique<Optics>(spec_.optics, lens.value, rig_.width_px));
  }
}

void Studio::LoadLight(const LightCacheOptions& options) {
  std::vector<Vec3d> positions_m;
  for (const StampedPose& pose : poses_) {
    positions_m.push_back(pose.world_from_rig.translation_m);
  }
  light_ = std::make_unique<CachedLight>(
      scene_, textures_, *lighting_, spec_.render, positions_m, LightHash(input_), options);
}

PixelSampling Studio::Sampling() const {
  // White paint in the open, without the sun, is pi times as bright as this.
  const float reference = Luminance(lighting_->sky.HorizontalIrradiance()) / 10.0F;
  return {spec_.render.samples, spec_.render.max_samples, kNoiseTolerance, reference};
}

View Studio::ViewOf(const Record& record) const {
  // Keyed by the place in the description, not in the selection: a frame is the same whatever
  // else is rendered.
  constexpr uint64_t kMaxLenses = 1024;
  return {.lens = &rig_.lenses[record.lens_idx].value,
          .world_from_camera = poses_[static_cast<size_t>(record.frame)].world_from_rig *
                               rig_.cameras[record.camera_idx].rig_from_camera,
          .width_px = rig_.width_px,
          .height_px = rig_.height_px,
          .seed = spec_.render.seed,
          .frame = static_cast<uint64_t>(record.frame),
          .view_idx = record.camera_idx * kMaxLenses + record.lens_idx};
}

RigidTransform Studio::WorldFromCamera(const Record& record, double after_s) const {
  const double time_s = poses_[static_cast<size_t>(record.frame)].time_s + after_s;
  return trajectory_->WorldFromRig(time_s) * rig_.cameras[record.camera_idx].rig_from_camera;
}

ExposurePoses Studio::ExposureOf(const Record& record) const {
  return {Shutter(spec_.shutter),
          *trajectory_,
          rig_.cameras[record.camera_idx].rig_from_camera,
          poses_[static_cast<size_t>(record.frame)].time_s};
}

FrameFile Studio::FileOf(const Record& record, Output output) const {
  return {rig_.lenses[record.lens_idx].name,
          rig_.cameras[record.camera_idx].name,
          output,
          record.frame};
}

}  // namespace pfseq
