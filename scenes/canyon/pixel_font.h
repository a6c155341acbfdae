// SPDX-License-Identifier: Apache-2.0
// Capital letters as 5 x 7 pixels, for shop signs.
#pragma once

namespace pfseq {

inline constexpr int kFontColumns = 5;
inline constexpr int kFontRows = 7;

/// Whether a pixel (from the upper left) of a letter A to Z is set; all other characters are blank.
bool FontPixel(char letter, int column, int row);

}  // namespace pfseq
