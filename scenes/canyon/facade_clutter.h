// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/build_context.h"
#include "scenes/canyon/window.h"

namespace pfseq {

/// What people fix to their windows: a box of flowers, an air conditioner, a dish, a flag, washing;
/// mostly nothing.
void BuildWindowClutter(const BuildContext& context,
                        const SurfaceFrame& facade,
                        const Opening& opening,
                        bool has_balcony,
                        RandomStream& random);

/// A board or a box that stands out over the pavement, its lower edge 2.7 m above it.
void BuildHangingSign(const BuildContext& context,
                      const SurfaceFrame& facade,
                      double along_m,
                      double head_m,
                      RandomStream& random);

}  // namespace pfseq
