// SPDX-License-Identifier: Apache-2.0
// What a benchmark needs of a sequence: images with calibration, poses and ground truth, wherever
// they come from.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/rigid_transform.h"
#include "renderer/lens/lens.h"
#include "renderer/trace/ray_scene.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pfseq {

/// A frame of a camera.
struct ViewName {
  std::string camera;
  int frame = 0;

  bool operator==(const ViewName&) const = default;
};

/// Faults of files are InputError, one line of path, fault and what was expected; so are names that
/// there are not.
class ViewSource {
 public:
  virtual ~ViewSource() = default;

  /// Of the folder or description, for messages and records.
  virtual std::string Name() const = 0;
  virtual std::vector<std::string> Cameras() const = 0;
  virtual std::vector<std::string> Lenses() const = 0;
  virtual const Lens& LensOf(const std::string& lens) const = 0;
  virtual RigidTransform WorldFromCamera(const ViewName& view) const = 0;

  /// "realistic", "clean": kinds of images that exist.
  virtual std::vector<std::string> Variants() const = 0;
  /// Frames of a camera that have an image, ascending.
  virtual std::vector<int> Frames(const std::string& lens,
                                  const std::string& camera,
                                  const std::string& variant) const = 0;
  /// 8-bit, 1, 3 or 4 channels.
  virtual Image<uint8_t> ReadImage(const std::string& lens,
                                   const ViewName& view,
                                   const std::string& variant) const = 0;
  /// Euclidean metres along the pixel centres' rays; +inf or 0 where there is none.
  virtual Image<float> ReadDistance(const std::string& lens, const ViewName& view) const = 0;
  /// The scene for exact rays. Null when there is none.
  virtual std::shared_ptr<const RayScene> Scene() const = 0;
  virtual double MaxDistanceM() const = 0;
};

/// A folder of pfseq, or a dataset's description (a .yaml file, see dataset_views.h).
std::unique_ptr<ViewSource> OpenViews(const std::filesystem::path& path);

}  // namespace pfseq
