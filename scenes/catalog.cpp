// SPDX-License-Identifier: Apache-2.0
#include "scenes/catalog.h"

#include "scenes/canyon/canyon.h"
#include "scenes/canyon/facade_photos.h"
#include "scenes/gltf/gltf_reader.h"

namespace pfseq {

Scene LoadScene(const SequenceSpec& spec, const std::filesystem::path& spec_folder) {
  if (!spec.scene.gltf.empty()) {
    return ReadGltf(spec_folder / spec.scene.gltf);
  }
  Scene scene = BuildCanyon(spec.scene.canyon, spec.trajectory.drive);
  scene.Validate("scene.canyon");
  return scene;
}

std::string SceneCredits(const SequenceSpec& spec, const std::filesystem::path& spec_folder) {
  if (!spec.scene.gltf.empty()) {
    return ReadGltfCopyright(spec_folder / spec.scene.gltf);
  }
  return spec.scene.canyon.facades.empty() ? "" : ReadFacadeCredits(spec.scene.canyon.facades);
}

}  // namespace pfseq
