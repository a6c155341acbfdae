// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"

#include <vector>

namespace pfseq {

/// Bands, string courses, cornices, eaves and downpipes of a house; `lods` has one entry for each
/// edge.
void BuildMouldings(const BuildContext& context,
                    const Building& building,
                    const std::vector<Lod>& lods);

}  // namespace pfseq
