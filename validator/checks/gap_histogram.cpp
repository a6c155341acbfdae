// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/gap_histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfseq {

void GapHistogram::Add(double gap_m) {
  size_t bin = kNumBins - 1;  // Also for NaN.
  if (gap_m <= std::pow(10.0, kFirstDecade)) {
    bin = 0;
  } else if (gap_m <= std::pow(10.0, kLastDecade)) {
    bin = static_cast<size_t>(std::ceil((std::log10(gap_m) - kFirstDecade) * kBinsPerDecade));
    bin = std::clamp<size_t>(bin, 1, kNumBins - 2);
  }
  ++counts_[bin];
  ++total_;
}

void GapHistogram::Add(const GapHistogram& other) {
  for (size_t bin = 0; bin < kNumBins; ++bin) {
    counts_[bin] += other.counts_[bin];
  }
  total_ += other.total_;
}

double GapHistogram::QuantileM(double share) const {
  const auto rank = static_cast<uint64_t>(std::ceil(share * static_cast<double>(total_)));
  uint64_t num_below = 0;
  for (size_t bin = 0; total_ > 0 && bin < kNumBins; ++bin) {
    num_below += counts_[bin];
    if (num_below >= std::max<uint64_t>(rank, 1)) {
      return bin == kNumBins - 1
                 ? std::numeric_limits<double>::infinity()
                 : std::pow(10.0, kFirstDecade + static_cast<double>(bin) / kBinsPerDecade);
    }
  }
  return 0.0;
}

}  // namespace pfseq
