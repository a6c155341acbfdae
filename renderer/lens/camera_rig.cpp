// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/camera_rig.h"

namespace pfseq {

Eigen::Quaterniond RotationFromXzy(const std::array<double, 3>& angles_rad) {
  return (Eigen::AngleAxisd(angles_rad[1], Vec3d::UnitY()) *
          Eigen::AngleAxisd(angles_rad[2], Vec3d::UnitZ()) *
          Eigen::AngleAxisd(angles_rad[0], Vec3d::UnitX()))
      .normalized();
}

}  // namespace pfseq
