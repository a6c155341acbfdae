// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/shutter.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

constexpr int kNumSteps = 128;

}  // namespace

double Shutter::MiddleS(const Vec2d& image_place) const {
  if (spec_.readout_s == 0.0) {
    return spec_.offset_s;
  }
  double place = image_place.y();
  if (spec_.readout == "up") {
    place = 1.0 - image_place.y();
  } else if (spec_.readout == "right") {
    place = image_place.x();
  } else if (spec_.readout == "left") {
    place = 1.0 - image_place.x();
  }
  return spec_.offset_s + (place - 0.5) * spec_.readout_s;
}

double Shutter::TimeS(const Vec2d& sample, const Vec2d& image_place) const {
  return MiddleS(image_place) +
         spec_.exposure_s * (sample.x() - 0.5 + spec_.ramp * (sample.y() - 0.5));
}

Vec2d Shutter::SpanS() const {
  const double half_s = 0.5 * (spec_.exposure_s * (1.0 + spec_.ramp) + spec_.readout_s);
  return {spec_.offset_s - half_s, spec_.offset_s + half_s};
}

ExposurePoses::ExposurePoses(const Shutter& shutter,
                             const Trajectory& trajectory,
                             const RigidTransform& rig_from_camera,
                             double frame_time_s)
    : shutter_(shutter) {
  const Vec2d span_s = shutter.SpanS();
  const double length_s = span_s.y() - span_s.x();
  start_s_ = span_s.x();
  steps_per_s_ = length_s > 0.0 ? kNumSteps / length_s : 0.0;
  const RigidTransform middle = trajectory.WorldFromRig(frame_time_s);
  for (int i = 0; i <= kNumSteps; ++i) {
    const RigidTransform world_from_rig =
        trajectory.WorldFromRig(frame_time_s + start_s_ + length_s * i / kNumSteps);
    is_still_ = is_still_ && world_from_rig.translation_m == middle.translation_m &&
                world_from_rig.rotation.coeffs() == middle.rotation.coeffs();
    const RigidTransform world_from_camera = world_from_rig * rig_from_camera;
    poses_.push_back({world_from_camera.translation_m.cast<float>(),
                      world_from_camera.rotation.toRotationMatrix().cast<float>()});
  }
}

ExposurePoses::Pose ExposurePoses::At(double time_s) const {
  const double step = std::clamp((time_s - start_s_) * steps_per_s_, 0.0, double{kNumSteps});
  const int first = std::min(static_cast<int>(step), kNumSteps - 1);
  const auto share = static_cast<float>(step - first);
  const Pose& before = poses_[static_cast<size_t>(first)];
  const Pose& after = poses_[static_cast<size_t>(first) + 1];
  return {before.origin_m + share * (after.origin_m - before.origin_m),
          before.world_from_camera + share * (after.world_from_camera - before.world_from_camera)};
}

}  // namespace pfseq
