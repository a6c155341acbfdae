// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/pose_check.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "renderer/lens/trajectory.h"
#include "renderer/lens/trajectory_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// Files may hold rounded numbers; a micrometre and a microradian are far below what any map can
/// show.
constexpr double kTolerance = 1e-6;

/// The column yaw_deg of poses.csv, which nothing else reads. The file is known to be well-formed.
std::vector<double> ReadYawColumnDeg(const std::filesystem::path& path) {
  constexpr int kYawColumn = 4;
  std::istringstream stream(ReadFile(path));
  std::string line;
  std::getline(stream, line);
  std::vector<double> yaws_deg;
  while (std::getline(stream, line)) {
    std::string_view rest = line;
    for (int column = 0; column < kYawColumn; ++column) {
      rest.remove_prefix(rest.find(',') + 1);
    }
    double yaw_deg = 0.0;
    std::from_chars(rest.data(), rest.data() + rest.size(), yaw_deg);
    yaws_deg.push_back(yaw_deg);
  }
  return yaws_deg;
}

/// What contradicts between two poses, or nothing.
std::optional<std::string> Difference(const RigidTransform& found, const RigidTransform& expected) {
  const double distance_m = (found.translation_m - expected.translation_m).norm();
  const double angle_rad = found.rotation.angularDistance(expected.rotation);
  if (distance_m <= kTolerance && angle_rad <= kTolerance) {
    return std::nullopt;
  }
  return fmt::format("{:.6g} m and {:.6g} degrees", distance_m, DegFromRad(angle_rad));
}

void CheckPosesAlone(const CheckContext& context, CheckReport& report) {
  const std::string file(kPosesFile);
  const std::vector<StampedPose>& poses = context.reader.Poses();
  const std::vector<double> yaws_deg = ReadYawColumnDeg(context.reader.Folder() / file);
  for (size_t frame = 0; frame < poses.size(); ++frame) {
    if (frame > 0 && poses[frame].time_s <= poses[frame - 1].time_s) {
      report.AddFault(
          file, fmt::format("frame {}: its time is not after that of the frame before", frame));
    }
    const double expected_deg = DegFromRad(YawRad(poses[frame].world_from_rig));
    const double error_deg = std::remainder(yaws_deg.at(frame) - expected_deg, 360.0);
    if (RadFromDeg(std::abs(error_deg)) > kTolerance) {
      report.AddFault(
          file,
          fmt::format(
              "frame {}: yaw_deg {:.6f}, but the quaternion's yaw is {:.6f} degrees: edited pose?",
              frame,
              yaws_deg[frame],
              expected_deg));
    }
  }
}

/// Differences by frame between a camera's trajectory file and poses.csv; nothing when the file
/// itself is at fault.
std::optional<std::map<size_t, std::string>> CompareTrajectory(const CheckContext& context,
                                                               const std::string& camera,
                                                               CheckReport& report) {
  const std::string file = TrajectoryFile(camera);
  const std::filesystem::path path = context.reader.Folder() / file;
  const std::vector<StampedPose>& poses = context.reader.Poses();
  std::vector<StampedPose> world_from_camera;
  try {
    world_from_camera = ReadTum(path);
  } catch (const InputError& fault) {
    report.AddFault(file, WithoutPath(fault.what(), path));
    return std::nullopt;
  }
  if (world_from_camera.size() != poses.size()) {
    report.AddFault(
        file,
        fmt::format("{} poses, {} in {}", world_from_camera.size(), poses.size(), kPosesFile));
    return std::nullopt;
  }
  std::map<size_t, std::string> differences;
  for (size_t frame = 0; frame < poses.size(); ++frame) {
    const RigidTransform expected = context.reader.WorldFromCamera(camera, static_cast<int>(frame));
    std::optional<std::string> difference =
        Difference(world_from_camera[frame].world_from_rig, expected);
    const double late_s = world_from_camera[frame].time_s - poses[frame].time_s;
    if (!difference && std::abs(late_s) > kTolerance) {
      difference = fmt::format("{:.6g} s", late_s);
    }
    if (difference) {
      differences[frame] = *difference;
    }
  }
  return differences;
}

/// Two poses for each frame; a folder whose shutter takes no time has none.
void CheckExposure(const CheckContext& context, const std::string& camera, CheckReport& report) {
  const std::string file = ExposureFile(camera);
  const std::filesystem::path path = context.reader.Folder() / file;
  if (!std::filesystem::exists(path)) {
    return;
  }
  const std::vector<StampedPose>& poses = context.reader.Poses();
  try {
    // Not as a trajectory: the exposures of successive frames may overlap.
    const std::string text = ReadFile(path);
    const auto num_ends = static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
    if (num_ends != 2 * poses.size()) {
      report.AddFault(file,
                      fmt::format("{} poses, expected two for each of {} frames in {}",
                                  num_ends,
                                  poses.size(),
                                  kPosesFile));
    }
  } catch (const InputError& fault) {
    report.AddFault(file, WithoutPath(fault.what(), path));
  }
}

}  // namespace

void CheckPoses(const CheckContext& context, CheckReport& report) {
  CheckPosesAlone(context, report);
  std::map<std::string, std::map<size_t, std::string>> differences_by_camera;
  for (const std::string& camera : context.reader.Cameras()) {
    if (const auto differences = CompareTrajectory(context, camera, report)) {
      differences_by_camera[camera] = *differences;
    }
  }
  for (const std::string& camera : context.reader.Cameras()) {
    CheckExposure(context, camera, report);
  }
  const size_t num_frames = context.reader.Poses().size();
  for (size_t frame = 0; frame < num_frames; ++frame) {
    size_t num_contradicting = 0;
    for (const auto& [camera, differences] : differences_by_camera) {
      num_contradicting += differences.contains(frame) ? 1 : 0;
    }
    if (num_contradicting > 1 && num_contradicting == differences_by_camera.size()) {
      const auto& [camera, differences] = *differences_by_camera.begin();
      report.AddFault(
          std::string(kPosesFile),
          fmt::format(
              "frame {}: contradicts the trajectories of all cameras ({} by {}): edited pose?",
              frame,
              differences.at(frame),
              TrajectoryFile(camera)));
      continue;
    }
    for (const auto& [camera, differences] : differences_by_camera) {
      if (differences.contains(frame)) {
        report.AddFault(
            TrajectoryFile(camera),
            fmt::format("frame {}: {} from {} times the camera's place in {}: edited pose?",
                        frame,
                        differences.at(frame),
                        kPosesFile,
                        kRigFile));
      }
    }
  }
  report.num_poses = num_frames;
}

}  // namespace pfseq
