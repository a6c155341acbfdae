// SPDX-License-Identifier: Apache-2.0
// Kannala and Brandt 2006, "A generic camera model and calibration method for conventional,
// wide-angle, and fish-eye lenses", equation (6), with the four coefficients that OpenCV, Kalibr
// and COLMAP use:
//   r = f (theta + k1 theta^3 + k2 theta^5 + k3 theta^7 + k4 theta^9)
// One-to-one up to the first angle where the polynomial stops growing (pi at most).
#pragma once

#include <array>

namespace pfseq {

class KannalaBrandt {
 public:
  static constexpr const char* kName = "kannala_brandt";
  static constexpr bool kReachesLimit = true;

  explicit KannalaBrandt(const std::array<double, 4>& coefficients);

  double ImageHeight(double theta_rad) const;
  /// Newton's method, kept inside a bracket; exact to rounding. Infinity for heights above that of
  /// the limit angle.
  double IncidenceAngleRad(double height) const;
  double LimitAngleRad() const { return limit_angle_rad_; }
  const std::array<double, 4>& Coefficients() const { return coefficients_; }

 private:
  double Slope(double theta_rad) const;

  std::array<double, 4> coefficients_;
  double limit_angle_rad_;
};

}  // namespace pfseq
