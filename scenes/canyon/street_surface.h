// SPDX-License-Identifier: Apache-2.0
// Carriageways with their markings, kerbs and pavements, lamps.
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/street_plan.h"

namespace pfseq {

/// The asphalt under all streets (z = 0), markings and covers.
void BuildCarriageways(const BuildContext& context, const StreetPlan& plan);

/// The raised island of a block: kerb and slabs.
void BuildPavement(const BuildContext& context, const Block& block);

/// Lamp posts along an island's kerbs on streets.
void BuildLamps(const BuildContext& context, const Block& block, const StreetPlan& plan);

}  // namespace pfseq
