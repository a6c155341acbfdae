// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/checks/check_context.h"
#include "validator/checks/check_report.h"

#include <filesystem>

namespace pfseq {

/// Checks a sequence's folder from what is on disk alone: files, images, poses, distance maps
/// against the scene and between the cameras. Goes on after a fault with all that can still be
/// checked. Memory does not grow with the number of frames; the report does not depend on the
/// number of threads. InputError when there is no such folder.
CheckReport CheckSequence(const std::filesystem::path& folder, const CheckOptions& options);

}  // namespace pfseq
