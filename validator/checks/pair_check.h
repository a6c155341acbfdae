// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/checks/check_context.h"
#include "validator/checks/check_report.h"

namespace pfseq {

/// The distance maps of each two cameras agree in 3D where both see the same surface, in both
/// directions.
///
/// For each sampled pixel of one camera with finite distance: P is its point from the map; the ray
/// cast at the scene tells the plane of the triangle. P is seen by the other camera when it falls
/// into its image circle and a ray from there reaches it (to 1e-4 of the distance and 1 mm). Of the
/// nine pixels around it, the nearest whose own ray meets the same plane is the common one; Q is
/// its point from the other map. The gap is |n . (Q - P)|; it agrees up to 1 mm + 1e-4 of the
/// distance. Less than 99.9 % agreement in a frame is a fault.
void CheckPairs(const CheckContext& context, CheckReport& report);

}  // namespace pfseq
