// SPDX-License-Identifier: Apache-2.0
// A dataset from elsewhere (the archive of 2014, ...) through a small description:
//
//   lenses:                       by name; files in the form of data/lenses/
//     equisolid: pfseq-equisolid.yaml
//   image_size_px: [1200, 1200]
//   max_distance_m: 500           optional; points beyond are sky
//   axes: opencv                  camera axes of the poses: opencv (x right, y down, z along the
//                                 axis; default) or opengl (x right, y up, z against the axis)
//   poses: poses.csv              world_from_rig: TUM (.txt, row i is frame i) or CSV with frame,
//                                 x_m, y_m and yaw_deg (and z_m)
//   distance:                     how maps are stored; optional
//     kind: distance              distance (along the ray; default) or depth (along the axis)
//     scale_m: 0.001              metres a unit; default 1 (float files), 0 and NaN: none
//   scene: scene.glb              optional; for --judge ray
//   cameras:                      the first one is the reference
//     front:
//       images: front/Image*.png  a glob, numbered from 0 in order of names, or with {frame:04}
//       distances: front/Depth{frame:04}.exr    optional, likewise
//       position_m: [0, 0, 0]     in the rig; default 0
//       rotation_deg: [0, 0, 0]   about X, Y, Z, "gimbal Euler XZY" (Ry Rz Rx); default 0
//     rear:
//       poses: rear.txt           instead of the rig's: world_from_camera
//       images: {realistic: rear/Image*.png, clean: rear_clean/Image*.png}
//
// Paths are relative to the description; {lens} stands for the lens's name. Images: any 8-bit file;
// distances: .exr, or 16-bit .png and .tiff.
#pragma once

#include "renderer/lens/trajectory.h"
#include "validator/benchmark/view_source.h"

#include <map>
#include <optional>
#include <vector>

namespace pfseq {

class DatasetViews : public ViewSource {
 public:
  /// InputError with file, line and key.
  explicit DatasetViews(const std::filesystem::path& path);

  std::string Name() const override { return path_.stem().string(); }
  std::vector<std::string> Cameras() const override;
  std::vector<std::string> Lenses() const override;
  const Lens& LensOf(const std::string& lens) const override;
  RigidTransform WorldFromCamera(const ViewName& view) const override;
  std::vector<std::string> Variants() const override;
  std::vector<int> Frames(const std::string& lens,
                          const std::string& camera,
                          const std::string& variant) const override;
  Image<uint8_t> ReadImage(const std::string& lens,
                           const ViewName& view,
                           const std::string& variant) const override;
  Image<float> ReadDistance(const std::string& lens, const ViewName& view) const override;
  std::shared_ptr<const RayScene> Scene() const override;
  double MaxDistanceM() const override { return max_distance_m_; }

 private:
  struct Camera {
    std::string name;
    /// Patterns by variant.
    std::vector<std::pair<std::string, std::string>> images;
    std::string distances;
    RigidTransform rig_from_camera;
    /// By frame; empty: the rig's.
    std::vector<StampedPose> poses;
  };

  const Camera& CameraOf(const std::string& name) const;
  /// The files that a pattern stands for, by frame.
  std::map<int, std::filesystem::path> FilesOf(const std::string& pattern,
                                               const std::string& lens) const;
  Image<float> ReadRaster(const std::filesystem::path& path) const;

  std::filesystem::path path_;
  std::vector<std::pair<std::string, Lens>> lenses_;
  std::vector<Camera> cameras_;
  std::vector<StampedPose> poses_;
  int width_px_ = 0;
  int height_px_ = 0;
  double max_distance_m_ = 500.0;
  bool is_opengl_ = false;
  bool is_depth_ = false;
  double scale_m_ = 1.0;
  std::string scene_;
};

}  // namespace pfseq
