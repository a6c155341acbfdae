// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "validator/benchmark.h"

#include <string>
#include <vector>

namespace pfseq {

/// Matches within this distance in the world are drawn as correct.
inline constexpr double kPictureToleranceM = 0.10;

/// Both views side by side at reduced size, a dot at each end of every attempted match and lines
/// for some 200 of them, evenly chosen: green where the match is correct, red where not. A caption
/// below tells the counts.
Image<uint8_t> MatchPicture(const Image<uint8_t>& first_rgb,
                            const Image<uint8_t>& second_rgb,
                            const std::vector<JudgedMatch>& matches,
                            const std::string& title);

}  // namespace pfseq
