// SPDX-License-Identifier: Apache-2.0
#include "validator/report/reference_2014.h"

#include "renderer/core/check.h"
#include "renderer/core/parse_number.h"
#include "validator/report/csv_line.h"
#include "validator/report/embedded_files.h"

#include <algorithm>
#include <sstream>

namespace pfseq {

Reference2014::Reference2014() {
  std::istringstream lines{std::string(EmbeddedFile("data/reference/pfseq_2014_features.csv"))};
  std::string line;
  std::getline(lines, line);
  PFSEQ_CHECK(line.starts_with("pair,metric,setup,tolerance_m,value"),
              "columns of the 2014 tables: {}",
              line);
  while (std::getline(lines, line)) {
    const std::vector<std::string> columns = SplitCsvLine(line);
    PFSEQ_CHECK(columns.size() == 5, "a line of the 2014 tables: {}", line);
    const auto tolerance = std::find(
        kTolerancesM.begin(), kTolerancesM.end(), ParseNumber<double>(columns[3]).value_or(0.0));
    PFSEQ_CHECK(tolerance != kTolerancesM.end(), "a tolerance of the 2014 tables: {}", line);
    const std::optional<double> value = ParseNumber<double>(columns[4]);
    // The report has -1 where a setting found nothing to count.
    if (value && *value >= 0.0) {
      curves_[{columns[1], columns[0], columns[2]}]
             [static_cast<size_t>(tolerance - kTolerancesM.begin())] = value;
    }
  }
}

std::optional<double> Reference2014::Find(const Key& key, double tolerance_m) const {
  const auto curve = curves_.find(key);
  const auto tolerance = std::find(kTolerancesM.begin(), kTolerancesM.end(), tolerance_m);
  if (curve == curves_.end() || tolerance == kTolerancesM.end()) {
    return std::nullopt;
  }
  return curve->second[static_cast<size_t>(tolerance - kTolerancesM.begin())];
}

}  // namespace pfseq
