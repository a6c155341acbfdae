// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/lens/trajectory.h"

namespace pfseq {

/// Drives along +X and turns about Z at even rates.
class Driving : public Trajectory {
 public:
  Driving(double speed_mps, double rate_radps) : speed_mps_(speed_mps), rate_radps_(rate_radps) {}
  RigidTransform WorldFromRig(double time_s) const override {
    return PoseFromYaw(Vec3d(speed_mps_ * time_s, 0.0, 0.0), rate_radps_ * time_s);
  }

 private:
  double speed_mps_;
  double rate_radps_;
};

}  // namespace pfseq
