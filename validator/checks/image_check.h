// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/checks/check_context.h"
#include "validator/checks/check_report.h"

namespace pfseq {

/// Each image can be read and has the size, channels and type of its kind; radiance is finite and
/// not negative; distances are positive inside the image circle, 0 outside it, and finite only up
/// to the maximum; sky masks hold 0 and 255 alone, 255 only at infinite distance, and 0 at infinite
/// distance only where the scene lies beyond the maximum.
void CheckImages(const CheckContext& context, CheckReport& report);

}  // namespace pfseq
