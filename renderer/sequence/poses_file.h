// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/lens/trajectory.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

/// Text of poses.csv: a row for each frame with frame,time_s,x_m,y_m,yaw_deg,z_m,qx,qy,qz,qw. x, y,
/// z and the unit quaternion are world_from_rig at mid-exposure, written so that they read back to
/// the same bits; yaw_deg is the angle of the rig's X axis in the world's XY plane.
std::string PosesCsv(const std::vector<StampedPose>& world_from_rig_by_frame);

/// The poses of poses.csv. InputError with file and line when a row is not of that form, when
/// frames do not count 0, 1, 2, ... or when a quaternion is not of unit length.
std::vector<StampedPose> ReadPosesCsv(const std::filesystem::path& path);

}  // namespace pfseq
