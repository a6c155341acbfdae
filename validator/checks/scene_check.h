// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/checks/check_context.h"
#include "validator/checks/check_report.h"

namespace pfseq {

/// Casts the distance maps (and sky masks) again: each map must show scene.glb from the stored
/// pose, with a relative error of 1e-5 at most. A map that does not is tried with the poses of all
/// cameras and frames and with the other lenses, to tell a swapped file; when all maps of a frame,
/// a camera or a lens fail together, the pose or calibration that they share is named instead.
void CheckScene(const CheckContext& context, CheckReport& report);

}  // namespace pfseq
