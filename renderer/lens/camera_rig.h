// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/rigid_transform.h"

#include <array>
#include <string>
#include <vector>

namespace pfseq {

/// A camera on the rig. The camera frame: x to the right, y down in the image, z along the optical
/// axis.
struct RigCamera {
  std::string name;
  RigidTransform rig_from_camera;
};

/// Rotation of "gimbal Euler XZY": Ry * Rz * Rx, so X is applied first, then Z, then Y. Angles
/// about X, Y and Z.
Eigen::Quaterniond RotationFromXzy(const std::array<double, 3>& angles_rad);

}  // namespace pfseq
