// SPDX-License-Identifier: Apache-2.0
// Carriageways with their markings, kerbs and pavements.
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/street_plan.h"

namespace pfseq {

/// The asphalt under all streets (z = 0), markings and covers.
void BuildCarriageways(const BuildContext& context, const StreetPlan& plan);

/// The raised island of a block: kerb and slabs.
void BuildPavement(const BuildContext& context, const Block& block);

}  // namespace pfseq
