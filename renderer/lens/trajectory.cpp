// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/trajectory.h"

#include <cmath>

namespace pfseq {

RigidTransform PoseFromYaw(const Vec3d& position_m, double yaw_rad) {
  return {Eigen::Quaterniond(std::cos(0.5 * yaw_rad), 0.0, 0.0, std::sin(0.5 * yaw_rad)),
          position_m};
}

double YawRad(const RigidTransform& world_from_rig) {
  const Vec3d forward = world_from_rig.Direction(Vec3d::UnitX());
  return std::atan2(forward.y(), forward.x());
}

}  // namespace pfseq
