// SPDX-License-Identifier: Apache-2.0
// Orthographic projection: r = f sin(theta). One-to-one for theta in [0, pi / 2].
#pragma once

#include <cmath>
#include <numbers>

namespace pfseq {

struct Orthographic {
  static constexpr const char* kName = "orthographic";
  static constexpr bool kReachesLimit = true;

  double ImageHeight(double theta_rad) const { return std::sin(theta_rad); }
  double IncidenceAngleRad(double height) const { return std::asin(height); }
  double LimitAngleRad() const { return 0.5 * std::numbers::pi; }
};

}  // namespace pfseq
