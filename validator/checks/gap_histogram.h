// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pfseq {

/// Lengths counted in bins of equal ratio, 100 a decade from 1 pm to 1 km: quantiles of any number
/// of lengths in little memory, in any order of adding.
class GapHistogram {
 public:
  void Add(double gap_m);
  void Add(const GapHistogram& other);

  /// The upper end of the bin of the quantile, at most 2.4 % above it; 0 when there are none, 1 pm
  /// for all that is below, infinity for all beyond 1 km.
  double QuantileM(double share) const;

 private:
  static constexpr int kBinsPerDecade = 100;
  static constexpr int kFirstDecade = -12;
  static constexpr int kLastDecade = 3;
  /// One more at each end.
  static constexpr size_t kNumBins = (kLastDecade - kFirstDecade) * kBinsPerDecade + 2;

  std::array<uint64_t, kNumBins> counts_ = {};
  uint64_t total_ = 0;
};

}  // namespace pfseq
