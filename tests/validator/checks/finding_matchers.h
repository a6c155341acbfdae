// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/checks/check_report.h"

#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace pfseq {

inline void PrintTo(const Finding& finding, std::ostream* stream) {
  *stream << (finding.severity == Severity::kFault ? "fault: " : "note: ") << finding.file << ": "
          << finding.text;
}

/// A fault of a file whose text contains a phrase.
MATCHER_P2(IsFault, file, phrase, "") {
  return arg.severity == Severity::kFault && arg.file == std::string(file) &&
         arg.text.find(phrase) != std::string::npos;
}

MATCHER_P2(IsNote, file, phrase, "") {
  return arg.severity == Severity::kNote && arg.file == std::string(file) &&
         arg.text.find(phrase) != std::string::npos;
}

}  // namespace pfseq
