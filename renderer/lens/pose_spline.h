// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/lens/trajectory.h"

#include <vector>

namespace pfseq {

/// A smooth path through stamped poses. Position: cubic Hermite polynomials on the given times
/// whose slopes are those of the parabola through three neighbouring poses (non-uniform
/// Catmull-Rom; C1, exact for quadratic motion); a rig that stands between two poses stays exactly
/// where it is. Rotation: spherical linear interpolation along the shortest arc (Shoemake 1985,
/// "Animating rotation with quaternion curves"). Passes exactly through each pose at its time.
class PoseSpline : public Trajectory {
 public:
  /// At least one pose, times ascending.
  explicit PoseSpline(std::vector<StampedPose> poses);

  RigidTransform WorldFromRig(double time_s) const override;

 private:
  std::vector<StampedPose> poses_;
  /// Slope of the position at each pose.
  std::vector<Vec3d> velocities_mps_;
};

}  // namespace pfseq
