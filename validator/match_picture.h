// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

/// An attempted match in the two images.
struct JudgedMatch {
  std::array<Vec2d, 2> pixels_px;
  /// Between the two points in the world; +inf when one of them has no place there.
  double distance_m = 0.0;
};

/// Matches within this distance in the world are drawn as correct.
inline constexpr double kPictureToleranceM = 0.10;

/// Both views (1, 3 or 4 channels) side by side at reduced size, a dot at each end of every
/// attempted match and lines for some 200 of them, evenly chosen: blue where the match is correct,
/// orange where not. A caption below tells the counts.
Image<uint8_t> MatchPicture(const Image<uint8_t>& first,
                            const Image<uint8_t>& second,
                            const std::vector<JudgedMatch>& matches,
                            const std::string& title);

/// Writes it as a PNG file into a folder, named after the title.
void WriteMatchPicture(const Image<uint8_t>& first,
                       const Image<uint8_t>& second,
                       const std::vector<JudgedMatch>& matches,
                       const std::string& title,
                       const std::filesystem::path& folder);

}  // namespace pfseq
