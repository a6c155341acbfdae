// SPDX-License-Identifier: Apache-2.0
// A description with all that it refers to, read and built.
#pragma once

#include "renderer/sequence_renderer.h"

namespace pfseq {

/// Builds the scene, settles the light and reads the description's other files.
SequenceInput LoadSequenceInput(const SequenceSpec& spec);

/// Makes an input that of another description with the same LitSceneKey: scene, light and files
/// stay.
void ChangeCameras(const SequenceSpec& spec, SequenceInput& input);

}  // namespace pfseq
