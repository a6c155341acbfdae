// SPDX-License-Identifier: Apache-2.0
// When a place of the film sees the scene.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/lens/trajectory.h"
#include "renderer/sequence/camera_spec.h"

#include <vector>

namespace pfseq {

/// Times are relative to the frame's pose. Opening and closing at an even rate, the shutter lets
/// light pass as a trapezoid of the width exposure_s at half its height, which is the sum of two
/// uniform random numbers of the widths exposure_s and ramp * exposure_s.
class Shutter {
 public:
  explicit Shutter(const ShutterSpec& spec) : spec_(spec) {}

  /// The time that a sample in [0, 1)^2 stands for, at a place of the image in [0, 1]^2 from its
  /// upper left corner.
  double TimeS(const Vec2d& sample, const Vec2d& image_place) const;

  /// Middle of the exposure at a place of the image.
  double MiddleS(const Vec2d& image_place) const;

  /// The first and the last time at which any place is exposed.
  Vec2d SpanS() const;

  double ExposureS() const { return spec_.exposure_s; }

 private:
  ShutterSpec spec_;
};

/// A camera's poses while a frame is exposed, for rendering: exact at 129 instants, linear between
/// them, which for a turn by an angle a in the exposure is (a / 128)^2 / 8 off at most; for 10
/// degrees 2.3e-7 rad.
class ExposurePoses {
 public:
  struct Pose {
    Vec3f origin_m;
    Eigen::Matrix3f world_from_camera;
  };

  ExposurePoses(const Shutter& shutter,
                const Trajectory& trajectory,
                const RigidTransform& rig_from_camera,
                double frame_time_s);

  /// At a time of Shutter; outside its span the nearest end.
  Pose At(double time_s) const;

  /// Whether the camera rests where the frame's pose has it.
  bool IsStill() const { return is_still_; }

  const Shutter& OwnShutter() const { return shutter_; }

 private:
  Shutter shutter_;
  double start_s_ = 0.0;
  double steps_per_s_ = 0.0;
  bool is_still_ = true;
  std::vector<Pose> poses_;
};

}  // namespace pfseq
