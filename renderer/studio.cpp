// SPDX-License-Identifier: Apache-2.0
#include "renderer/studio.h"

#include "renderer/core/check.h"
#include "renderer/sequence/sequence_model.h"

namespace pfseq {
namespace {

/// Standard error of a pixel at which it gets no more samples, relative to its value.
constexpr float kNoiseTolerance = 0.06F;

}  // namespace

Studio::Studio(const SequenceInput& input, int num_threads)
    : spec_(input.spec),
      rig_(MakeRigFile(input.spec)),
      poses_(FramePoses(input.spec.trajectory)),
      trajectory_(MakeTrajectory(input.spec.trajectory)),
      scene_(input.lit_scene != nullptr ? input.lit_scene : std::make_shared<LitScene>(input)) {
  PFSEQ_CHECK(scene_->Key() == LitSceneKey(spec_), "the lit scene is that of another description");
  for (const auto& lens : rig_.lenses) {
    rasters_.push_back(
        std::make_unique<LensRaster>(lens.value, rig_.width_px, rig_.height_px, num_threads));
    optics_.push_back(std::make_unique<Optics>(spec_.optics, lens.value, rig_.width_px));
  }
}

PixelSampling Studio::Sampling() const {
  // White paint in the open, without the sun, is pi times as bright as this.
  const float reference = Luminance(scene_->Light().sky.HorizontalIrradiance()) / 10.0F;
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
  return WorldFromRig(time_s) * rig_.cameras[record.camera_idx].rig_from_camera;
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
