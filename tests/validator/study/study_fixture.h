// SPDX-License-Identifier: Apache-2.0
// Studies by hand, on the small sequence that ships.
#pragma once

#include "renderer/core/file.h"
#include "tests/support/temp_folder.h"
#include "validator/study/study_plan.h"

#include <string>

#include <fmt/format.h>

namespace pfseq {

inline const std::string kTinySequence =
    std::string(PFSEQ_SOURCE_DIR) + "/data/sequences/tiny.yaml";

/// The parts of a study that every one needs.
inline std::string StudyText(const std::string& factors, const std::string& more = "") {
  return fmt::format(
      "base: {}\npairs: [0, 2]\ngrid: {{settings: [SIFT nopol 0.04 5.0 1.6 SIFT BruteForce, "
      "SIFT nopol 0.04 5.0 1.6 FREAK 44.0 BruteForce]}}\n{}factors:\n{}",
      kTinySequence,
      more,
      factors);
}

inline StudySpec StudyOf(const TempFolder& folder, const std::string& text) {
  WriteFileAtomically(folder / "study.yaml", text);
  return ReadStudy(folder / "study.yaml");
}

inline const std::string kTwoFactors =
    "  exposure: {key: shutter.exposure_s, values: [0, 0.1, 0.2], base: 0.1}\n"
    "  lens:\n    levels:\n"
    "      - {label: as it is}\n"
    "      - {label: small, set: {lenses.equisolid.circle_px: 600, image.size_px: 64}}\n";

}  // namespace pfseq
