// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"

#include <vector>

namespace pfseq {

/// Closes a house above its eave: parapet and flat roof, mansard or gable, with dormers, chimneys
/// and what stands on roofs. `lods` has one entry for each edge.
void BuildRoof(const BuildContext& context, const Building& building, const std::vector<Lod>& lods);

}  // namespace pfseq
