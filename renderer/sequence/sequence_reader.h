// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/rigid_transform.h"
#include "renderer/lens/lens.h"
#include "renderer/lens/trajectory.h"
#include "renderer/sequence/layout.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pfseq {

/// A sequence's folder as data: calibration, poses and frames, read from rig.yaml, poses.csv and
/// the frames' files. The manifest is not needed: an unfinished sequence can be read.
class SequenceReader {
 public:
  /// InputError when rig.yaml or poses.csv is missing or wrong.
  explicit SequenceReader(std::filesystem::path folder);

  const std::filesystem::path& Folder() const { return folder_; }

  /// In the order of rig.yaml; the first camera is the reference.
  const std::vector<std::string>& Cameras() const { return cameras_; }
  const std::vector<std::string>& Lenses() const { return lenses_; }
  int WidthPx() const { return width_px_; }
  int HeightPx() const { return height_px_; }
  /// Distances beyond this are +inf in the maps.
  double MaxDistanceM() const { return max_distance_m_; }

  /// InputError that lists the known names when there is no such lens or camera.
  const Lens& LensOf(const std::string& lens) const;
  const RigidTransform& RigFromCamera(const std::string& camera) const;

  /// The rig's pose of each frame at mid-exposure, by frame number 0, 1, ...
  const std::vector<StampedPose>& Poses() const { return poses_; }
  RigidTransform WorldFromCamera(const std::string& camera, int frame) const;

  /// The frames that have a file of this kind, ascending.
  std::vector<int> Frames(const std::string& lens, const std::string& camera, Output output) const;

  /// 8-bit RGB. InputError when missing, damaged or of another size than rig.yaml says; so below.
  Image<uint8_t> ReadClean(const std::string& lens, const std::string& camera, int frame) const;
  /// Metres, one channel: +inf for sky and beyond MaxDistanceM, 0 outside the image circle.
  Image<float> ReadDistance(const std::string& lens, const std::string& camera, int frame) const;
  /// One channel: 255 where the pixel centre's ray meets nothing, else 0.
  Image<uint8_t> ReadSky(const std::string& lens, const std::string& camera, int frame) const;

 private:
  std::filesystem::path PathOf(const FrameFile& file) const;

  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  std::vector<std::string> lenses_;
  int width_px_ = 0;
  int height_px_ = 0;
  double max_distance_m_ = 0.0;
  std::map<std::string, Lens> lens_by_name_;
  std::map<std::string, RigidTransform> rig_from_camera_;
  std::vector<StampedPose> poses_;
};

}  // namespace pfseq
