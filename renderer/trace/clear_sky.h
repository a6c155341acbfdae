// SPDX-License-Identifier: Apache-2.0
// The cloudless sky, by formula. World frame, Z up; radiance in kcd/m^2 per channel of linear
// Rec. 709.
//
// Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight": Perez's distribution
// F = (1 + A e^(B / cos theta)) (1 + C e^(D gamma) + E cos^2 gamma) of x, y and Y (CIE xyY), theta
// the direction's angle to the zenith, gamma that to the sun, with coefficients and zenith values
// by turbidity.
#pragma once

#include "renderer/core/vector.h"

#include <array>

namespace pfseq {

/// Least and greatest turbidity for which the formulas give light everywhere.
inline constexpr double kMinTurbidity = 1.8;
inline constexpr double kMaxTurbidity = 10.0;

class ClearSky {
 public:
  /// A sun below the horizon counts as on it. Turbidity must lie in [kMinTurbidity, kMaxTurbidity].
  ClearSky(const Vec3d& direction_to_sun, double turbidity, double strength);

  /// Toward a unit direction; below the horizon as at it.
  Rgb Radiance(const Vec3d& direction) const;

 private:
  struct Perez {
    double a, b, c, d, e;
    double At(double cos_zenith, double gamma_rad, double cos_gamma) const;
  };

  Vec3d direction_to_sun_;
  /// Of x, y and Y, each with its value at the zenith over F there.
  std::array<Perez, 3> perez_{};
  std::array<double, 3> scale_{};
};

}  // namespace pfseq
