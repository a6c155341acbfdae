// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/build_context.h"

namespace pfseq {

enum class VehicleKind { kHatchback, kSaloon, kOffRoader, kVan, kLorry };

/// Length and width over all.
Vec2d VehicleSize(VehicleKind kind);

/// A closed vehicle on its wheels. The frame's origin is the middle of its footprint on the road,
/// `right` points to its front; colours are drawn.
void BuildVehicle(const BuildContext& context,
                  VehicleKind kind,
                  const SurfaceFrame& frame,
                  RandomStream& random);

}  // namespace pfseq
