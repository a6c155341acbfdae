// SPDX-License-Identifier: Apache-2.0
// Trajectories as text files.
#pragma once

#include "renderer/lens/trajectory.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pfseq {

/// A TUM file (RGB-D benchmark of TU Munich): "timestamp tx ty tz qx qy qz qw", seconds, metres,
/// world_from_rig; lines that start with # are comments. Quaternions are normalised. InputError
/// with file and line when a row has not eight numbers, times do not ascend, a quaternion is not of
/// unit length to 1 %, or there is no pose at all.
std::vector<StampedPose> ReadTum(const std::filesystem::path& path);

/// The poses in that format: times with 9 decimals, all else with as many digits as give the same
/// double again, one space between columns, w of the quaternion not negative.
std::string TumText(std::span<const StampedPose> poses);

/// A CSV file with a header that names at least the columns frame, x_m, y_m and yaw_deg in any
/// order; others are not looked at. The time is frame / frame_rate_hz, the height is the given one.
/// InputError with file and line when a column is missing, a value is not a number, frames do not
/// ascend, or there is no pose at all.
std::vector<StampedPose> ReadPoseCsv(const std::filesystem::path& path,
                                     double frame_rate_hz,
                                     double height_m);

}  // namespace pfseq
