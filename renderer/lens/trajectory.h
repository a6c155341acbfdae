// SPDX-License-Identifier: Apache-2.0
// Where the rig is at any time.
#pragma once

#include "renderer/core/rigid_transform.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace pfseq {

/// A pose of the rig in the world at a time.
struct StampedPose {
  double time_s = 0.0;
  RigidTransform world_from_rig;
};

/// A path through time, in double precision. Outside its span the rig stands at the nearest end.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  virtual RigidTransform WorldFromRig(double time_s) const = 0;
};

/// Rotation by a yaw angle about the world's Z axis, at a position.
RigidTransform PoseFromYaw(const Vec3d& position_m, double yaw_rad);

/// The yaw of a rig: angle of its X axis in the world's XY plane, in (-pi, pi].
double YawRad(const RigidTransform& world_from_rig);

}  // namespace pfseq
