// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/sequence_views.h"

#include "renderer/core/error.h"
#include "renderer/core/parse_number.h"
#include "renderer/sequence/image_io.h"
#include "scenes/gltf/gltf_reader.h"
#include "validator/benchmark/dataset_views.h"

#include <algorithm>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// In order of preference.
constexpr const char* kVariants[] = {"realistic", "clean"};
/// Of pictures, likewise.
constexpr const char* kExtensions[] = {".png", ".jpg"};

}  // namespace

std::unique_ptr<ViewSource> OpenViews(const std::filesystem::path& path) {
  if (std::filesystem::is_regular_file(path)) {
    return std::make_unique<DatasetViews>(path);
  }
  return std::make_unique<SequenceViews>(path);
}

SequenceViews::SequenceViews(const std::filesystem::path& folder) : reader_(folder) {}

std::string SequenceViews::Name() const {
  return std::filesystem::weakly_canonical(reader_.Folder()).filename().string();
}

RigidTransform SequenceViews::WorldFromCamera(const ViewName& view) const {
  return reader_.WorldFromCamera(view.camera, view.frame);
}

std::filesystem::path SequenceViews::ImageFolder(const std::string& lens,
                                                 const std::string& camera,
                                                 const std::string& variant) const {
  return reader_.Folder() / lens / camera / variant;
}

std::vector<std::string> SequenceViews::Variants() const {
  std::vector<std::string> variants;
  for (const char* variant : kVariants) {
    bool found = false;
    for (const std::string& lens : reader_.Lenses()) {
      for (const std::string& camera : reader_.Cameras()) {
        found |= std::filesystem::is_directory(ImageFolder(lens, camera, variant));
      }
    }
    if (found) {
      variants.emplace_back(variant);
    }
  }
  return variants;
}

std::vector<int> SequenceViews::Frames(const std::string& lens,
                                       const std::string& camera,
                                       const std::string& variant) const {
  std::vector<int> frames;
  const std::filesystem::path folder = ImageFolder(lens, camera, variant);
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const auto frame = ParseNumber<int>(entry.path().stem().string());
      if (std::find(std::begin(kExtensions), std::end(kExtensions), entry.path().extension()) !=
              std::end(kExtensions) &&
          frame && *frame >= 0) {
        frames.push_back(*frame);
      }
    }
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

Image<uint8_t> SequenceViews::ReadImage(const std::string& lens,
                                        const ViewName& view,
                                        const std::string& variant) const {
  std::filesystem::path path =
      ImageFolder(lens, view.camera, variant) / fmt::format("{:06}{}", view.frame, kExtensions[0]);
  const std::filesystem::path other = std::filesystem::path(path).replace_extension(kExtensions[1]);
  if (!std::filesystem::exists(path) && std::filesystem::exists(other)) {
    path = other;
  }
  Image<uint8_t> image = ReadPicture8(path);
  if (image.WidthPx() != reader_.WidthPx() || image.HeightPx() != reader_.HeightPx() ||
      image.NumChannels() == 2) {
    throw InputError("{}: expected {} x {} px with 1, 3 or 4 channels, got {} x {} px with {}",
                     path.string(),
                     reader_.WidthPx(),
                     reader_.HeightPx(),
                     image.WidthPx(),
                     image.HeightPx(),
                     image.NumChannels());
  }
  return image;
}

Image<float> SequenceViews::ReadDistance(const std::string& lens, const ViewName& view) const {
  return reader_.ReadDistance(lens, view.camera, view.frame);
}

std::shared_ptr<const RayScene> SequenceViews::Scene() const {
  const std::filesystem::path path = reader_.Folder() / kSceneFile;
  if (!std::filesystem::exists(path)) {
    return nullptr;
  }
  return std::make_shared<const RayScene>(std::make_shared<const pfseq::Scene>(ReadGltf(path)));
}

}  // namespace pfseq
