// SPDX-License-Identifier: Apache-2.0
// The conclusions of the PFSeq report of 2014, judged by results of today.
#pragma once

#include "validator/report/reference_2014.h"
#include "validator/report/result_set.h"

#include <string>
#include <vector>

namespace pfseq {

enum class Judgement {
  kHolds,
  kPartly,  ///< on some of the pairs
  kFails,
  kUnknown,  ///< the results lack what it takes
};

struct Conclusion {
  std::string claim;
  /// What the report has to show for it.
  std::string theirs;
  /// What the results show, or what they lack.
  std::string ours;
  Judgement judgement = Judgement::kUnknown;
};

/// "holds", "holds in part", "does not hold", "cannot be said".
std::string JudgementText(Judgement judgement);

/// At kVerdictToleranceM, on the report's pairs 0 (translation), 40 (translation, blurred) and 24
/// (rotation, blurred), by matching score of settings with kEnoughMatches. Where the results have a
/// pair more than once (lenses, benchmarks), the first counts.
std::vector<Conclusion> JudgeConclusions(const ResultSet& results, const Reference2014& reference);

}  // namespace pfseq
