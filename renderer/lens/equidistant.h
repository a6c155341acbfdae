// SPDX-License-Identifier: Apache-2.0
// Equidistant projection: r = f theta. One-to-one for theta in [0, pi].
#pragma once

#include <numbers>

namespace pfseq {

struct Equidistant {
  static constexpr const char* kName = "equidistant";
  static constexpr bool kReachesLimit = true;

  double ImageHeight(double theta_rad) const { return theta_rad; }
  double IncidenceAngleRad(double height) const { return height; }
  double LimitAngleRad() const { return std::numbers::pi; }
};

}  // namespace pfseq
