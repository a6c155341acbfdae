// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/checks/check_context.h"
#include "validator/checks/check_report.h"

namespace pfseq {

/// Times increase, yaw_deg is that of the quaternion, and each trajectory_CAMERA.txt
/// (world_from_camera) is poses.csv times the camera's place in rig.yaml, to 1e-6 (metres, radians,
/// seconds). When all cameras' trajectories contradict a frame's pose, the pose is named, otherwise
/// the trajectory.
void CheckPoses(const CheckContext& context, CheckReport& report);

}  // namespace pfseq
