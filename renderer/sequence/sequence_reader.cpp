// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sequence_reader.h"

#include "renderer/core/error.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/poses_file.h"
#include "renderer/sequence/rig_file.h"

#include <algorithm>
#include <utility>

namespace pfseq {
namespace {

template <typename T>
void ExpectShape(
    const Image<T>& image, int width_px, int height_px, int num_channels, const std::string& path) {
  if (image.WidthPx() != width_px || image.HeightPx() != height_px ||
      image.NumChannels() != num_channels) {
    throw InputError("{}: expected {} x {} px with {} channels, got {} x {} px with {}",
                     path,
                     width_px,
                     height_px,
                     num_channels,
                     image.WidthPx(),
                     image.HeightPx(),
                     image.NumChannels());
  }
}

template <typename T>
const T& Find(const std::map<std::string, T>& values, const std::string& name, const char* kind) {
  const auto found = values.find(name);
  if (found != values.end()) {
    return found->second;
  }
  std::string known;
  for (const auto& [key, value] : values) {
    known += (known.empty() ? "" : ", ") + key;
  }
  throw InputError("{} '{}': the sequence has {}", kind, name, known);
}

}  // namespace

SequenceReader::SequenceReader(std::filesystem::path folder) : folder_(std::move(folder)) {
  if (!std::filesystem::is_directory(folder_)) {
    throw InputError("{}: expected the folder of a sequence", folder_.string());
  }
  const RigFile rig = RigFile::Read(folder_ / kRigFile);
  width_px_ = rig.width_px;
  height_px_ = rig.height_px;
  max_distance_m_ = rig.max_distance_m;
  for (const RigCamera& camera : rig.cameras) {
    cameras_.push_back(camera.name);
    rig_from_camera_.emplace(camera.name, camera.rig_from_camera);
  }
  for (const Named<Lens>& lens : rig.lenses) {
    lenses_.push_back(lens.name);
    lens_by_name_.emplace(lens.name, lens.value);
  }
  poses_ = ReadPosesCsv(folder_ / kPosesFile);
}

const Lens& SequenceReader::LensOf(const std::string& lens) const {
  return Find(lens_by_name_, lens, "lens");
}

const RigidTransform& SequenceReader::RigFromCamera(const std::string& camera) const {
  return Find(rig_from_camera_, camera, "camera");
}

RigidTransform SequenceReader::WorldFromCamera(const std::string& camera, int frame) const {
  if (frame < 0 || static_cast<size_t>(frame) >= poses_.size()) {
    throw InputError(
        "frame {}: the sequence has poses of frames 0 to {}", frame, poses_.size() - 1);
  }
  return poses_[static_cast<size_t>(frame)].world_from_rig * RigFromCamera(camera);
}

std::vector<int> SequenceReader::Frames(const std::string& lens,
                                        const std::string& camera,
                                        Output output) const {
  std::vector<int> frames;
  const std::filesystem::path folder = PathOf({lens, camera, output, 0}).parent_path();
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const auto file = FrameFile::FromRelativePath(entry.path().lexically_relative(folder_));
      // Realistic frames of both formats lie in one folder.
      if (file.has_value() && file->output == output) {
        frames.push_back(file->frame);
      }
    }
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

Image<uint8_t> SequenceReader::ReadClean(const std::string& lens,
                                         const std::string& camera,
                                         int frame) const {
  const std::filesystem::path path = PathOf({lens, camera, Output::kClean, frame});
  Image<uint8_t> image = ReadImage8(path);
  ExpectShape(image, width_px_, height_px_, 3, path.string());
  return image;
}

Image<float> SequenceReader::ReadDistance(const std::string& lens,
                                          const std::string& camera,
                                          int frame) const {
  const std::filesystem::path path = PathOf({lens, camera, Output::kDistance, frame});
  Image<float> image = ReadExr(path);
  ExpectShape(image, width_px_, height_px_, 1, path.string());
  return image;
}

Image<uint8_t> SequenceReader::ReadSky(const std::string& lens,
                                       const std::string& camera,
                                       int frame) const {
  const std::filesystem::path path = PathOf({lens, camera, Output::kSky, frame});
  Image<uint8_t> image = ReadImage8(path);
  ExpectShape(image, width_px_, height_px_, 1, path.string());
  return image;
}

std::filesystem::path SequenceReader::PathOf(const FrameFile& file) const {
  return folder_ / file.RelativePath();
}

}  // namespace pfseq
