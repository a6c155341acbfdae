// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/sequence/sequence_spec.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/scene.h"

#include <memory>

namespace pfseq {

/// What a camera's meter says of frame 0, seen by the first camera through the first lens: the
/// exposure that makes the geometric mean of the luminance over the image circle 0.18 (Reinhard et
/// al. 2002, "Photographic Tone Reproduction for Digital Images", equations 1 and 2), to three
/// digits. By few paths in a small image, whatever the size and samples of the sequence's frames.
double MeteredExposure(const SequenceSpec& spec,
                       const std::shared_ptr<const Scene>& scene,
                       const Lighting& lighting,
                       int num_threads);

}  // namespace pfseq
