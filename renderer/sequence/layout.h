// SPDX-License-Identifier: Apache-2.0
// Names of the files of a sequence's folder; the one place that spells them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

/// What is written for each frame, camera and lens.
enum class Output {
  kRealistic,      ///< realistic/NNNNNN.png: with shutter, optics and sensor; 8 or 16 bits
  kRealisticJpeg,  ///< realistic/NNNNNN.jpg: the same, where the sensor writes JPEG
  kClean,          ///< clean/NNNNNN.png: 8-bit sRGB, no blur, no aberrations
  kLinear,         ///< linear/NNNNNN.exr: half-float linear Rec. 709 radiance of the clean frame
  kDistance,       ///< distance/NNNNNN.exr: float32, one channel Y, metres
  kSky,            ///< sky/NNNNNN.png: 0 or 255
  kBlur,           ///< blur/NNNNNN.exr: float32, channels X, Y: way in px while the shutter is open
  kRealisticLinear,  ///< realistic_linear/NNNNNN.exr: half-float radiance of the realistic frame
                     ///< before its sensor
  kFlare,          ///< flare/NNNNNN.exr: half-float linear Rec. 709 radiance of sun star and ghosts
};

inline constexpr Output kAllOutputs[] = {Output::kRealistic,
                                         Output::kRealisticJpeg,
                                         Output::kClean,
                                         Output::kLinear,
                                         Output::kDistance,
                                         Output::kSky,
                                         Output::kBlur,
                                         Output::kRealisticLinear,
                                         Output::kFlare};

/// The folder name of an output, which is its name on the command line too; realistic for both of
/// its formats.
std::string_view OutputName(Output output);

/// InputError with the known names when there is no such output; kRealistic for realistic.
Output OutputFromName(std::string_view name);

inline constexpr std::string_view kSequenceFile = "sequence.yaml";
inline constexpr std::string_view kManifestFile = "manifest.json";
inline constexpr std::string_view kSceneFile = "scene.glb";
inline constexpr std::string_view kRigFile = "rig.yaml";
inline constexpr std::string_view kPosesFile = "poses.csv";
/// A copy of the trajectory file that the description names, so that the folder can be rendered
/// again by itself.
inline constexpr std::string_view kTumInputFile = "trajectory_input.txt";
inline constexpr std::string_view kCsvInputFile = "trajectory_input.csv";
/// Likewise of the sky map, by its format.
inline constexpr std::string_view kExrSkyMapFile = "sky_map.exr";
inline constexpr std::string_view kHdrSkyMapFile = "sky_map.hdr";

/// trajectory_CAMERA.txt
std::string TrajectoryFile(std::string_view camera);

/// exposure_CAMERA.txt: where the camera is when the shutter opens and when it closes, two lines for
/// each frame; there when the shutter takes time.
std::string ExposureFile(std::string_view camera);

/// Path of a frame's file relative to the sequence's folder: LENS/CAMERA/OUTPUT/NNNNNN.EXT
struct FrameFile {
  std::string lens;
  std::string camera;
  Output output = Output::kClean;
  int frame = 0;

  std::filesystem::path RelativePath() const;
  /// The inverse of RelativePath; nothing when the path is not of that form.
  static std::optional<FrameFile> FromRelativePath(const std::filesystem::path& path);
};

/// True for the files of a sequence's folder that manifest.json lists: the description and the
/// frames' files.
bool BelongsToSequence(const std::filesystem::path& relative_path);

/// Paths, relative to `folder`, of all its files for which BelongsToSequence holds, sorted.
std::vector<std::filesystem::path> SequenceFiles(const std::filesystem::path& folder);

}  // namespace pfseq
