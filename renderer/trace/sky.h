// SPDX-License-Identifier: Apache-2.0
// The radiance of the sky by direction. World frame, Z up; radiance in kcd/m^2, irradiance in klx
// (per channel of linear Rec. 709, so that the luminance of the colour is the photometric value).
#pragma once

#include "renderer/core/vector.h"

#include <array>
#include <vector>

namespace pfseq {

/// Least and greatest turbidity for which the clear sky's formulas give light everywhere.
inline constexpr double kMinTurbidity = 1.8;
inline constexpr double kMaxTurbidity = 10.0;

class Sky {
 public:
  /// The same radiance in all directions, below the horizon too.
  static Sky Constant(const Rgb& radiance);

  /// Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight": Perez's luminance
  /// distribution with coefficients by turbidity. A sun below the horizon counts as on it. Below
  /// the horizon the scene's geometry is thought to go on as a Lambertian ground of albedo 0.2 that
  /// the sky lights (not the sun): one radiance. `strength` multiplies it all. Turbidity must lie
  /// in [kMinTurbidity, kMaxTurbidity].
  static Sky Clear(const Vec3d& direction_to_sun, double turbidity, double strength);

  /// Toward a unit direction.
  Rgb Radiance(const Vec3d& direction) const;

  struct DirectionSample {
    Vec3d direction;
    /// By solid angle.
    double pdf;
  };

  /// A direction with a density near proportional to luminance, from two numbers in [0, 1).
  DirectionSample SampleDirection(const Vec2d& sample) const;

  /// SampleDirection's density, by solid angle.
  double Pdf(const Vec3d& direction) const;

  /// Irradiance on a horizontal surface that sees nothing but the sky above the horizon, by
  /// quadrature.
  Rgb HorizontalIrradiance() const;

  bool IsBlack() const { return is_black_; }

 private:
  /// Perez et al. 1993: F = (1 + A e^(B / cos theta)) (1 + C e^(D gamma) + E cos^2 gamma).
  struct Perez {
    double a, b, c, d, e;
    double At(double cos_zenith, double gamma_rad, double cos_gamma) const;
  };

  Sky() = default;
  Rgb RadianceAbove(const Vec3d& direction) const;
  void Tabulate();

  bool is_constant_ = true;
  bool is_black_ = true;
  /// Constant sky's radiance, or that of the clear sky's ground.
  Rgb constant_ = Rgb::Zero();
  Vec3d direction_to_sun_ = Vec3d::UnitZ();
  /// Of x, y and Y (CIE xyY), each with its value at the zenith over F there.
  std::array<Perez, 3> perez_{};
  std::array<double, 3> scale_{};
  /// Relative density of each cell, kNumRows rows of equal height in z by kNumColumns in azimuth
  /// (all cells have the same solid angle), and running sums for sampling.
  std::vector<double> cell_density_;
  std::vector<double> row_cdf_;
  std::vector<double> column_cdf_;
};

}  // namespace pfseq
