// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/pose_spline.h"

#include "renderer/core/check.h"

#include <algorithm>
#include <utility>

namespace pfseq {
namespace {

/// Slopes at the poses of the parabolas through each three neighbours; at the ends, that of the
/// outermost parabola.
std::vector<Vec3d> ParabolicVelocities(const std::vector<StampedPose>& poses) {
  const size_t count = poses.size();
  std::vector<Vec3d> velocities_mps(count, Vec3d::Zero());
  std::vector<Vec3d> secants_mps;
  std::vector<double> steps_s;
  for (size_t i = 0; i + 1 < count; ++i) {
    steps_s.push_back(poses[i + 1].time_s - poses[i].time_s);
    secants_mps.emplace_back(
        (poses[i + 1].world_from_rig.translation_m - poses[i].world_from_rig.translation_m) /
        steps_s[i]);
  }
  for (size_t i = 1; i + 1 < count; ++i) {
    velocities_mps[i] = (steps_s[i] * secants_mps[i - 1] + steps_s[i - 1] * secants_mps[i]) /
                        (steps_s[i - 1] + steps_s[i]);
  }
  if (count == 2) {
    velocities_mps[0] = velocities_mps[1] = secants_mps[0];
  } else if (count > 2) {
    velocities_mps[0] = 2.0 * secants_mps[0] - velocities_mps[1];
    velocities_mps[count - 1] = 2.0 * secants_mps[count - 2] - velocities_mps[count - 2];
  }
  // Where the rig stands it must not swing back and forth.
  for (size_t i = 0; i + 1 < count; ++i) {
    if (secants_mps[i].isZero(0.0)) {
      velocities_mps[i].setZero();
      velocities_mps[i + 1].setZero();
    }
  }
  return velocities_mps;
}

}  // namespace

PoseSpline::PoseSpline(std::vector<StampedPose> poses) : poses_(std::move(poses)) {
  PFSEQ_CHECK(!poses_.empty());
  for (size_t i = 1; i < poses_.size(); ++i) {
    PFSEQ_CHECK(poses_[i].time_s > poses_[i - 1].time_s,
                "pose {}: {} s after {} s",
                i,
                poses_[i].time_s,
                poses_[i - 1].time_s);
  }
  velocities_mps_ = ParabolicVelocities(poses_);
}

RigidTransform PoseSpline::WorldFromRig(double time_s) const {
  const auto after =
      std::upper_bound(poses_.begin(), poses_.end(), time_s, [](double t, const StampedPose& pose) {
        return t < pose.time_s;
      });
  if (after == poses_.begin()) {
    return poses_.front().world_from_rig;
  }
  const size_t i = static_cast<size_t>(after - poses_.begin()) - 1;
  if (after == poses_.end() || time_s == poses_[i].time_s) {
    return poses_[i].world_from_rig;
  }
  const double step_s = poses_[i + 1].time_s - poses_[i].time_s;
  const double u = (time_s - poses_[i].time_s) / step_s;
  const Vec3d& start_m = poses_[i].world_from_rig.translation_m;
  const Vec3d delta_m = poses_[i + 1].world_from_rig.translation_m - start_m;
  // Cubic Hermite basis functions.
  const double end_weight = u * u * (3.0 - 2.0 * u);
  const double start_slope_weight = u * (1.0 - u) * (1.0 - u) * step_s;
  const double end_slope_weight = -u * u * (1.0 - u) * step_s;
  return {poses_[i]
              .world_from_rig.rotation.slerp(u, poses_[i + 1].world_from_rig.rotation)
              .normalized(),
          start_m + end_weight * delta_m + start_slope_weight * velocities_mps_[i] +
              end_slope_weight * velocities_mps_[i + 1]};
}

}  // namespace pfseq
