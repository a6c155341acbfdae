// SPDX-License-Identifier: Apache-2.0
// From the description of a sequence to the objects that it describes: lenses, cameras and poses.
#pragma once

#include "renderer/lens/camera_rig.h"
#include "renderer/lens/drive.h"
#include "renderer/lens/lens.h"
#include "renderer/lens/trajectory.h"
#include "renderer/sequence/sequence_spec.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace pfseq {

/// The names of all lens models.
std::vector<std::string> LensModelNames();

/// The projection model of a lens without its pixel figures. InputError when the name is unknown.
LensModel MakeLensModel(const LensSpec& spec);

/// A lens at an image size. Circle, focal length and principal point are multiplied by
/// width / image_width_px when image_width_px is given; without a principal point it is the image's
/// centre. InputError when the model cannot have this field of view or neither circle nor focal
/// length is given.
Lens MakeLens(const LensSpec& spec, const std::array<int, 2>& image_size_px);

/// The image size that a lens file alone stands for: a square of its image_width_px, else one
/// around the image circle.
std::array<int, 2> ImageSizePxOfLens(const LensSpec& spec);

/// All lenses of a sequence at its image size, in the order of the file.
std::vector<Named<Lens>> MakeLenses(const SequenceSpec& spec);

RigCamera MakeCamera(const Named<CameraSpec>& camera);

/// All cameras of a sequence, in the order of the file; the first is the reference.
std::vector<RigCamera> MakeCameras(const SequenceSpec& spec);

/// The path of trajectory.drive on the ground; scenes are built along it.
DrivePath MakeDrivePath(const DriveSpec& spec);

/// Where the rig is at any time: the TUM or CSV file if one is given, else the drive. InputError
/// when a file is missing or wrong.
std::unique_ptr<Trajectory> MakeTrajectory(const TrajectorySpec& spec);

/// The rig's pose at mid-exposure of each frame. A drive has frame i at i / frame_rate_hz; a file
/// has its own times, of which the first num_frames are used (0: all). InputError as above, or when
/// the file has too few poses.
std::vector<StampedPose> FramePoses(const TrajectorySpec& spec);

}  // namespace pfseq
