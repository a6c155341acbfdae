// SPDX-License-Identifier: Apache-2.0
// Lateral colour: the image height r of a lens holds for 550 nm; a wavelength w falls at
//   r_w = r + a(w) s ((1 - q) rho + q rho^3),   rho = r / R,
// R the radius of the image circle, s the rim's shift between the Fraunhofer lines C and F, q the
// cubic share, and a(w) the dispersion of glass by Cauchy's formula n = A + B / w^2, scaled so that
// a(C) - a(F) = 1 and a(550 nm) = 0.
#pragma once

#include <array>

namespace pfseq {

class LateralColor {
 public:
  static constexpr double kReferenceNm = 550.0;

  /// Shifts must be small against the radius, as those of real lenses.
  LateralColor(double rim_px, double cubic, double circle_radius_px);

  /// a(w).
  static double Dispersion(double wavelength_nm);

  /// r_w of the height r of the lens.
  double HeightPx(double wavelength_nm, double reference_height_px) const {
    return reference_height_px + Dispersion(wavelength_nm) * Shift(reference_height_px);
  }

  /// The inverse of HeightPx.
  double ReferenceHeightPx(double wavelength_nm, double height_px) const;

  /// c1 and c3 of the mean image height r + c1 r + c3 r^3 of red, green and blue, over what each
  /// collects of white light.
  std::array<std::array<double, 2>, 3> ChannelPolynomials() const;

 private:
  double Shift(double height_px) const {
    return height_px * (linear_ + cubic_per_px2_ * height_px * height_px);
  }

  double linear_;
  double cubic_per_px2_;
};

}  // namespace pfseq
