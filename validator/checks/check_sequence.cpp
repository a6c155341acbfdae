// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/check_sequence.h"

#include "renderer/core/error.h"
#include "renderer/trace/ray_scene.h"
#include "scenes/gltf/gltf_reader.h"
#include "validator/checks/completeness_check.h"
#include "validator/checks/image_check.h"
#include "validator/checks/manifest_check.h"
#include "validator/checks/pair_check.h"
#include "validator/checks/pose_check.h"
#include "validator/checks/scene_check.h"

#include <memory>
#include <optional>
#include <string>

namespace pfseq {
namespace {

/// The file of the calibration that an error of SequenceReader is about.
std::string FileOfError(const std::filesystem::path& folder, const std::string& text) {
  const bool is_poses = text.starts_with((folder / kPosesFile).string());
  return std::string(is_poses ? kPosesFile : kRigFile);
}

std::unique_ptr<const RayScene> ReadScene(const std::filesystem::path& folder,
                                          CheckReport& report) {
  const std::filesystem::path path = folder / kSceneFile;
  try {
    return std::make_unique<const RayScene>(std::make_shared<const Scene>(ReadGltf(path)));
  } catch (const InputError& fault) {
    report.AddFault(std::string(kSceneFile),
                    WithoutPath(fault.what(), path) + ": nothing was checked by rays");
    return nullptr;
  }
}

}  // namespace

CheckReport CheckSequence(const std::filesystem::path& folder, const CheckOptions& options) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError("{}: expected the folder of a sequence", folder.string());
  }
  CheckReport report;
  CheckManifest(folder, options, report);

  std::optional<SequenceReader> reader;
  try {
    reader.emplace(folder);
  } catch (const InputError& fault) {
    const std::string file = FileOfError(folder, fault.what());
    report.AddFault(file, WithoutPath(fault.what(), folder / file));
    return report;
  }
  const std::unique_ptr<const RayScene> scene = ReadScene(folder, report);
  CheckContext context{*reader, scene.get(), CheckCompleteness(*reader, report), options};
  CheckPoses(context, report);
  CheckImages(context, report);
  CheckScene(context, report);
  CheckPairs(context, report);
  return report;
}

}  // namespace pfseq
