// SPDX-License-Identifier: Apache-2.0
// Equisolid angle projection: r = 2 f sin(theta / 2); equal solid angles have equal areas.
// One-to-one for theta in [0, pi].
#pragma once

#include <cmath>
#include <numbers>

namespace pfseq {

struct Equisolid {
  static constexpr const char* kName = "equisolid";
  static constexpr bool kReachesLimit = true;

  double ImageHeight(double theta_rad) const { return 2.0 * std::sin(0.5 * theta_rad); }
  double IncidenceAngleRad(double height) const { return 2.0 * std::asin(0.5 * height); }
  double LimitAngleRad() const { return std::numbers::pi; }
};

}  // namespace pfseq
