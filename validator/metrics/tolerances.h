// SPDX-License-Identifier: Apache-2.0
// When do two points count as the same place? Within a distance in the world, or within an angle.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace pfseq {

/// The study's twelve tolerances.
inline constexpr std::array<double, 12> kTolerancesM = {
    0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.10, 0.15};

/// The distances of kTolerancesM, then angles, each ascending; metrics have one value for each.
struct Tolerances {
  std::vector<double> angles_rad;

  size_t Size() const { return kTolerancesM.size() + angles_rad.size(); }
  bool IsAngle(size_t i) const { return i >= kTolerancesM.size(); }
  /// Metres or radians.
  double Limit(size_t i) const {
    return IsAngle(i) ? angles_rad[i - kTolerancesM.size()] : kTolerancesM[i];
  }
};

}  // namespace pfseq
