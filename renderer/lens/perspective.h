// SPDX-License-Identifier: Apache-2.0
// Perspective (pinhole) projection: r = f tan(theta). One-to-one for theta in [0, pi / 2).
#pragma once

#include <cmath>
#include <numbers>

namespace pfseq {

struct Perspective {
  static constexpr const char* kName = "perspective";
  static constexpr bool kReachesLimit = false;

  double ImageHeight(double theta_rad) const { return std::tan(theta_rad); }
  double IncidenceAngleRad(double height) const { return std::atan(height); }
  double LimitAngleRad() const { return 0.5 * std::numbers::pi; }
};

}  // namespace pfseq
