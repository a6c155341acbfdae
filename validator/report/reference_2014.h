// SPDX-License-Identifier: Apache-2.0
// The result tables of the PFSeq report (Moreau, Ambellouis, Ruichek 2014), data/reference/.
#pragma once

#include "validator/metrics/tolerances.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace pfseq {

/// Figures at the study's twelve distances; nothing where a table has none.
using ReferenceCurve = std::array<std::optional<double>, kTolerancesM.size()>;

class Reference2014 {
 public:
  Reference2014();

  struct Key {
    /// matches, repeatability, correct_matches or matching_score.
    std::string metric;
    /// 0 translation; 40 translation, blurred; 24 translation and rotation, blurred.
    std::string pair;
    std::string setup;
    auto operator<=>(const Key&) const = default;
  };
  const std::map<Key, ReferenceCurve>& Curves() const { return curves_; }

  /// Nothing when the report's tables do not have it.
  std::optional<double> Find(const Key& key, double tolerance_m) const;

 private:
  std::map<Key, ReferenceCurve> curves_;
};

}  // namespace pfseq
