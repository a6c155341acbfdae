// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/sequence/sequence_spec.h"
#include "renderer/trace/scene.h"

#include <filesystem>
#include <string>

namespace pfseq {

/// The scene that a sequence's description names: its glTF file, a path relative to `spec_folder`,
/// or else the canyon along its drive. InputError when the file cannot be read or the scene is not
/// valid.
Scene LoadScene(const SequenceSpec& spec, const std::filesystem::path& spec_folder);

/// Authors and licences of what the scene is made from, one line: of its photographs, or the
/// copyright of its glTF file; empty where there is nothing to say.
std::string SceneCredits(const SequenceSpec& spec, const std::filesystem::path& spec_folder);

}  // namespace pfseq
