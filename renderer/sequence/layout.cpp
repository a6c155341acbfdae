// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/layout.h"

#include "renderer/core/check.h"
#include "renderer/core/error.h"

#include <algorithm>
#include <charconv>

namespace pfseq {
namespace {

constexpr size_t kNumFrameDigits = 6;

std::string_view Extension(Output output) {
  switch (output) {
    case Output::kRealistic:
    case Output::kClean:
    case Output::kSky:
      return ".png";
    case Output::kRealisticJpeg:
      return ".jpg";
    default:
      return ".exr";
  }
}

std::optional<int> FrameFromStem(const std::string& stem) {
  int frame = 0;
  const char* end = stem.data() + stem.size();
  const auto [last, error] = std::from_chars(stem.data(), end, frame);
  if (error != std::errc() || last != end || frame < 0 || stem.size() < kNumFrameDigits) {
    return std::nullopt;
  }
  return frame;
}

}  // namespace

std::string_view OutputName(Output output) {
  switch (output) {
    case Output::kRealistic:
    case Output::kRealisticJpeg:
      return "realistic";
    case Output::kClean:
      return "clean";
    case Output::kLinear:
      return "linear";
    case Output::kDistance:
      return "distance";
    case Output::kSky:
      return "sky";
    case Output::kBlur:
      return "blur";
    case Output::kRealisticLinear:
      return "realistic_linear";
    case Output::kFlare:
      return "flare";
  }
  PFSEQ_CHECK(false, "output {}", static_cast<int>(output));
}

Output OutputFromName(std::string_view name) {
  for (const Output output : kAllOutputs) {
    if (OutputName(output) == name) {
      return output;
    }
  }
  throw InputError(
      "output: expected realistic, clean, linear, distance, sky, blur, realistic_linear or flare, got "
      "'{}'",
      name);
}

std::string TrajectoryFile(std::string_view camera) {
  return fmt::format("trajectory_{}.txt", camera);
}

std::string ExposureFile(std::string_view camera) {
  return fmt::format("exposure_{}.txt", camera);
}

std::filesystem::path FrameFile::RelativePath() const {
  return std::filesystem::path(lens) / camera / OutputName(output) /
         fmt::format("{:06}{}", frame, Extension(output));
}

std::optional<FrameFile> FrameFile::FromRelativePath(const std::filesystem::path& path) {
  const std::vector<std::filesystem::path> parts(path.begin(), path.end());
  if (parts.size() != 4) {
    return std::nullopt;
  }
  for (const Output output : kAllOutputs) {
    if (parts[2] == OutputName(output)) {
      const std::optional<int> frame = FrameFromStem(path.stem().string());
      if (!frame.has_value()) {
        return std::nullopt;
      }
      FrameFile file{parts[0].string(), parts[1].string(), output, *frame};
      if (file.RelativePath() == path) {
        return file;
      }
    }
  }
  return std::nullopt;
}

bool BelongsToSequence(const std::filesystem::path& relative_path) {
  const std::string name = relative_path.string();
  for (const std::string_view known : {kSequenceFile,
                                       kSceneFile,
                                       kRigFile,
                                       kPosesFile,
                                       kTumInputFile,
                                       kCsvInputFile,
                                       kExrSkyMapFile,
                                       kHdrSkyMapFile}) {
    if (name == known) {
      return true;
    }
  }
  const bool has_poses = !relative_path.has_parent_path() && name.ends_with(".txt") &&
                         (name.starts_with("trajectory_") || name.starts_with("exposure_"));
  return has_poses || FrameFile::FromRelativePath(relative_path).has_value();
}

std::vector<std::filesystem::path> SequenceFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::filesystem::path relative_path = entry.path().lexically_relative(folder);
    if (entry.is_regular_file() && BelongsToSequence(relative_path)) {
      paths.push_back(relative_path);
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace pfseq
