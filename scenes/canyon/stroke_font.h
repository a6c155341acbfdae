// SPDX-License-Identifier: Apache-2.0
// Capitals and figures as strokes, for shop signs, posters and number plates.
#pragma once

#include "renderer/core/vector.h"

#include <string_view>
#include <vector>

namespace pfseq {

/// One pen stroke: points in a letter's box, x to the right in [0, 0.7], y up in [0, 1].
using Stroke = std::vector<Vec2d>;

/// From one letter's left side to the next one's.
inline constexpr double kLetterAdvance = 0.95;

/// The strokes of a letter A to Z or a figure 0 to 9; none for all other characters.
std::vector<Stroke> StrokesOf(char letter);

/// Widths of the letters and the gaps between them, in units of the letters' height.
double TextWidth(std::string_view text);

}  // namespace pfseq
