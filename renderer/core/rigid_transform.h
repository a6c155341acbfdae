// SPDX-License-Identifier: Apache-2.0
// Rotation and translation between two frames, named target_from_source: world_from_rig maps rig
// coordinates to world coordinates.
#pragma once

#include "renderer/core/vector.h"

namespace pfseq {

/// x_target = rotation * x_source + translation_m. Rotation is a unit quaternion; metres
/// throughout.
struct RigidTransform {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3d translation_m = Vec3d::Zero();

  /// Maps a point from the source frame to the target frame.
  Vec3d Point(const Vec3d& point_source_m) const {
    return rotation * point_source_m + translation_m;
  }

  /// Maps a direction (no translation).
  Vec3d Direction(const Vec3d& direction_source) const { return rotation * direction_source; }

  RigidTransform Inverse() const {
    const Eigen::Quaterniond inverse = rotation.conjugate();
    return {inverse, -(inverse * translation_m)};
  }
};

/// c_from_a = c_from_b * b_from_a.
inline RigidTransform operator*(const RigidTransform& c_from_b, const RigidTransform& b_from_a) {
  return {(c_from_b.rotation * b_from_a.rotation).normalized(),
          c_from_b.Point(b_from_a.translation_m)};
}

}  // namespace pfseq
