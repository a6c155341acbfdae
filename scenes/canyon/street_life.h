// SPDX-License-Identifier: Apache-2.0
// Where things stand and hang in the streets.
#pragma once

#include "scenes/canyon/build_context.h"
#include "scenes/canyon/street_plan.h"

namespace pfseq {

/// What stands along the kerbs of a block, on its pavement and parked before it, by
/// BuildContext::street_life. Nothing comes nearer to the drive than 1.5 m.
void FurnishBlock(const BuildContext& context,
                  const Block& block,
                  const StreetPlan& plan,
                  uint64_t seed);

/// Wires, lamps and flags across the streets, hung between fronts that face each other.
void HangWires(const BuildContext& context, const StreetPlan& plan, uint64_t seed);

}  // namespace pfseq
