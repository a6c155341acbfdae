// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/build_context.h"
#include "scenes/canyon/window.h"

namespace pfseq {

/// What people fix to their windows: a box of flowers, an air conditioner or a flag;
/// mostly nothing.
void BuildWindowClutter(const BuildContext& context,
                        const SurfaceFrame& facade,
                        const Opening& opening,
                        bool has_balcony,
                        RandomStream& random);

/// A board that stands out over the pavement, its lower edge at least 2.7 m above it. The facade's
/// origin is at the level of the carriageway.
void BuildHangingSign(const BuildContext& context,
                      const SurfaceFrame& facade,
                      double along_m,
                      double head_m,
                      RandomStream& random);

}  // namespace pfseq
