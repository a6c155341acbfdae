// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/stroke_font.h"

#include <array>

namespace pfseq {
namespace {

/// Points on a grid of 5 columns (a to e) and 9 rows (0 to 8), two characters each; strokes are
/// separated by spaces. Letters first, then figures.
constexpr std::array<std::string_view, 36> kLetters = {
    "a0c8e0 b3d3",                          // A
    "a0a8c8d7d5c4a4 c4e3e1c0a0",            // B
    "e7d8b8a6a2b0d0e1",                     // C
    "a0a8c8e6e2c0a0",                       // D
    "e8a8a0e0 a4d4",                        // E
    "e8a8a0 a4d4",                          // F
    "e7d8b8a6a2b0d0e2e4c4",                 // G
    "a0a8 e0e8 a4e4",                       // H
    "c0c8 b0d0 b8d8",                       // I
    "a2b0c0d2d8",                           // J
    "a0a8 e8a3 b4e0",                       // K
    "a8a0e0",                               // L
    "a0a8c3e8e0",                           // M
    "a0a8e0e8",                             // N
    "b8a6a2b0d0e2e6d8b8",                   // O
    "a0a8d8e7e5d4a4",                       // P
    "b8a6a2b0d0e2e6d8b8 c3e0",              // Q
    "a0a8d8e7e5d4a4 c4e0",                  // R
    "e7d8b8a7a5b4d4e3e1d0b0a1",             // S
    "a8e8 c8c0",                            // T
    "a8a2b0d0e2e8",                         // U
    "a8c0e8",                               // V
    "a8b0c5d0e8",                           // W
    "a0e8 a8e0",                            // X
    "a8c4e8 c4c0",                          // Y
    "a8e8a0e0",                             // Z
    "b8a6a2b0d0e2e6d8b8 b2d6",              // 0
    "a6c8c0 b0d0",                          // 1
    "a6b8d8e6e5a0e0",                       // 2
    "a7b8d8e7e5d4c4 d4e3e1d0b0a1",          // 3
    "d0d8a3e3",                             // 4
    "e8a8a5d5e3e1d0a0",                     // 5
    "d8b8a5a2b0d0e2e3d5a4",                 // 6
    "a8e8c0",                               // 7
    "b8a7a5b4d4e5e7d8b8 b4a3a1b0d0e1e3d4",  // 8
    "e3d8b8a6a5b3d3e5e6 e5d1b0",            // 9
};

}  // namespace

std::vector<Stroke> StrokesOf(char letter) {
  size_t idx = kLetters.size();
  if (letter >= 'A' && letter <= 'Z') {
    idx = static_cast<size_t>(letter - 'A');
  } else if (letter >= '0' && letter <= '9') {
    idx = 26 + static_cast<size_t>(letter - '0');
  }
  std::vector<Stroke> strokes;
  if (idx == kLetters.size()) {
    return strokes;
  }
  const std::string_view code = kLetters[idx];
  strokes.emplace_back();
  for (size_t i = 0; i < code.size();) {
    if (code[i] == ' ') {
      strokes.emplace_back();
      ++i;
      continue;
    }
    strokes.back().emplace_back(0.7 * (code[i] - 'a') / 4.0, (code[i + 1] - '0') / 8.0);
    i += 2;
  }
  return strokes;
}

double TextWidth(std::string_view text) {
  return text.empty() ? 0.0
                      : kLetterAdvance * static_cast<double>(text.size()) - (kLetterAdvance - 0.7);
}

}  // namespace pfseq
