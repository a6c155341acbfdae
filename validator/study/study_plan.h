// SPDX-License-Identifier: Apache-2.0
// The sequences that a study renders and measures.
#pragma once

#include "validator/study/study_spec.h"

#include <string>
#include <vector>

namespace pfseq {

/// One sequence of a study.
struct StudyVariant {
  /// Of its folder: "base", "exposure_0.05"; "exposure_0.05__2" in the second of several
  /// repetitions.
  std::string name;
  /// A level of each factor.
  std::vector<size_t> level_idx;
  size_t repetition_idx = 0;
  SequenceSpec spec;
};

/// Repetition by repetition; in each, one at a time: the base, then the other levels of each
/// factor; all combinations: the last factor's levels vary fastest. InputError for what a sequence
/// cannot be.
std::vector<StudyVariant> PlanVariants(const StudySpec& study);

/// "2 factors (exposure 5 levels, lens 3 levels), one at a time, 2 repetitions: 14 variants".
std::string PlanSummary(const StudySpec& study, size_t num_variants);

}  // namespace pfseq
