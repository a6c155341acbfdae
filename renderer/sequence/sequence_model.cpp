// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sequence_model.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/lens/pose_spline.h"
#include "renderer/lens/trajectory_file.h"

#include <cmath>
#include <string>
#include <utility>

namespace pfseq {
namespace {

/// The poses of the trajectory's file, or none when it has no file.
std::vector<StampedPose> FilePoses(const TrajectorySpec& spec) {
  if (!spec.tum.empty()) {
    return ReadTum(spec.tum);
  }
  if (!spec.csv.empty()) {
    return ReadPoseCsv(spec.csv, spec.frame_rate_hz, spec.height_m);
  }
  return {};
}

DriveTrajectory MakeDrive(const TrajectorySpec& spec) {
  const DriveSpec& drive = spec.drive;
  return {MakeDrivePath(drive),
          {.cruise_mps = drive.cruise_speed_mps,
           .corner_mps = drive.corner_speed_mps,
           .acceleration_mps2 = drive.acceleration_mps2,
           .stop_s = drive.stop_s},
          spec.height_m};
}

}  // namespace

std::vector<std::string> LensModelNames() {
  return {Equidistant::kName,
          Equisolid::kName,
          Stereographic::kName,
          Orthographic::kName,
          Perspective::kName,
          KannalaBrandt::kName};
}

LensModel MakeLensModel(const LensSpec& spec) {
  if (spec.model == Equidistant::kName) {
    return Equidistant{};
  }
  if (spec.model == Equisolid::kName) {
    return Equisolid{};
  }
  if (spec.model == Stereographic::kName) {
    return Stereographic{};
  }
  if (spec.model == Orthographic::kName) {
    return Orthographic{};
  }
  if (spec.model == Perspective::kName) {
    return Perspective{};
  }
  if (spec.model == KannalaBrandt::kName) {
    return KannalaBrandt(spec.coefficients);
  }
  throw InputError("lens model: there is no {}", spec.model);
}

Lens MakeLens(const LensSpec& spec, const std::array<int, 2>& image_size_px) {
  const LensModel model = MakeLensModel(spec);
  const double max_angle_rad = 0.5 * RadFromDeg(spec.fov_deg);
  const double scale =
      spec.image_width_px > 0 ? static_cast<double>(image_size_px[0]) / spec.image_width_px : 1.0;
  Vec2d focal_px(spec.focal_px[0], spec.focal_px[1]);
  if (spec.circle_px > 0.0) {
    focal_px.setConstant(Lens::FocalFromCirclePx(model, spec.circle_px, max_angle_rad));
  }
  Vec2d principal_point_px(0.5 * image_size_px[0], 0.5 * image_size_px[1]);
  if (spec.principal_point_px) {
    principal_point_px =
        scale * Vec2d((*spec.principal_point_px)[0], (*spec.principal_point_px)[1]);
  }
  return Lens(model, scale * focal_px, principal_point_px, max_angle_rad);
}

std::array<int, 2> ImageSizePxOfLens(const LensSpec& spec) {
  if (spec.image_width_px > 0) {
    return {spec.image_width_px, spec.image_width_px};
  }
  const double circle_px =
      spec.circle_px > 0.0 ? spec.circle_px : MakeLens(spec, {1, 1}).CirclePx();
  const int size_px = static_cast<int>(std::ceil(circle_px));
  return {size_px, size_px};
}

std::vector<Named<Lens>> MakeLenses(const SequenceSpec& spec) {
  std::vector<Named<Lens>> lenses;
  for (const auto& [name, lens] : spec.lenses) {
    lenses.push_back({name, MakeLens(lens, spec.image.size_px)});
  }
  return lenses;
}

RigCamera MakeCamera(const Named<CameraSpec>& camera) {
  const auto& [position_m, angles_deg] = camera.value;
  return {camera.name,
          {RotationFromXzy(
               {RadFromDeg(angles_deg[0]), RadFromDeg(angles_deg[1]), RadFromDeg(angles_deg[2])}),
           {position_m[0], position_m[1], position_m[2]}}};
}

std::vector<RigCamera> MakeCameras(const SequenceSpec& spec) {
  std::vector<RigCamera> cameras;
  for (const Named<CameraSpec>& camera : spec.cameras) {
    cameras.push_back(MakeCamera(camera));
  }
  return cameras;
}

DrivePath MakeDrivePath(const DriveSpec& spec) {
  return DrivePath({.first_street_m = spec.first_street_m,
                    .cross_street_m = spec.cross_street_m,
                    .last_street_m = spec.last_street_m,
                    .corner_radius_m = spec.corner_radius_m,
                    .turn = spec.turn == "right" ? Turn::kRight : Turn::kLeft});
}

std::unique_ptr<Trajectory> MakeTrajectory(const TrajectorySpec& spec) {
  std::vector<StampedPose> poses = FilePoses(spec);
  if (!poses.empty()) {
    return std::make_unique<PoseSpline>(std::move(poses));
  }
  return std::make_unique<DriveTrajectory>(MakeDrive(spec));
}

std::vector<StampedPose> FramePoses(const TrajectorySpec& spec) {
  std::vector<StampedPose> poses = FilePoses(spec);
  const auto num_frames = static_cast<size_t>(spec.num_frames);
  if (!poses.empty()) {
    if (num_frames > poses.size()) {
      throw InputError("{}: expected at least num_frames ({}) poses, got {}",
                       spec.tum.empty() ? spec.csv : spec.tum,
                       num_frames,
                       poses.size());
    }
    poses.resize(num_frames == 0 ? poses.size() : num_frames);
    return poses;
  }
  const DriveTrajectory drive = MakeDrive(spec);
  for (int frame = 0; frame < spec.num_frames; ++frame) {
    const double time_s = frame / spec.frame_rate_hz;
    poses.push_back({time_s, drive.WorldFromRig(time_s)});
  }
  return poses;
}

}  // namespace pfseq
