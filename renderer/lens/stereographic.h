// SPDX-License-Identifier: Apache-2.0
// Stereographic projection: r = 2 f tan(theta / 2); conformal. One-to-one for theta in [0, pi).
#pragma once

#include <cmath>
#include <numbers>

namespace pfseq {

struct Stereographic {
  static constexpr const char* kName = "stereographic";
  static constexpr bool kReachesLimit = false;

  double ImageHeight(double theta_rad) const { return 2.0 * std::tan(0.5 * theta_rad); }
  double IncidenceAngleRad(double height) const { return 2.0 * std::atan(0.5 * height); }
  double LimitAngleRad() const { return std::numbers::pi; }
};

}  // namespace pfseq
