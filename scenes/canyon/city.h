// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/sequence/sequence_spec.h"
#include "scenes/canyon/build_context.h"

namespace pfseq {

/// Builds all streets and houses around the drive with the context's materials. InputError when a
/// figure of the canyon is out of its range.
void BuildCity(const BuildContext& context, const CanyonSpec& canyon, const DriveSpec& drive);

}  // namespace pfseq
