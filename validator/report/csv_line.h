// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

/// The columns of a line; quotes around one keep its commas.
inline std::vector<std::string> SplitCsvLine(std::string_view line) {
  std::vector<std::string> columns(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      columns.emplace_back();
    } else if (c != '\r') {
      columns.back() += c;
    }
  }
  return columns;
}

}  // namespace pfseq
