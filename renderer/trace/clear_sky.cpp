// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/clear_sky.h"

#include "renderer/core/check.h"
#include "renderer/trace/color.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

/// Preetham et al. 1999, appendix A.2: zenith luminance in kcd/m^2.
double ZenithLuminance(double turbidity, double sun_zenith_rad) {
  const double chi_rad =
      (4.0 / 9.0 - turbidity / 120.0) * (std::numbers::pi - 2.0 * sun_zenith_rad);
  return (4.0453 * turbidity - 4.9710) * std::tan(chi_rad) - 0.2155 * turbidity + 2.4192;
}

/// Ibid.: a chromaticity coordinate at the zenith; rows of the matrix by falling power of the
/// turbidity.
double ZenithChromaticity(const std::array<std::array<double, 4>, 3>& matrix,
                          double turbidity,
                          double theta) {
  const auto cubic = [theta](const std::array<double, 4>& row) {
    return ((row[0] * theta + row[1]) * theta + row[2]) * theta + row[3];
  };
  return (cubic(matrix[0]) * turbidity + cubic(matrix[1])) * turbidity + cubic(matrix[2]);
}

constexpr std::array<std::array<double, 4>, 3> kZenithX = {{{0.00166, -0.00375, 0.00209, 0.0},
                                                            {-0.02903, 0.06377, -0.03202, 0.00394},
                                                            {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr std::array<std::array<double, 4>, 3> kZenithY = {{{0.00275, -0.00610, 0.00317, 0.0},
                                                            {-0.04214, 0.08970, -0.04153, 0.00516},
                                                            {0.15346, -0.26756, 0.06670, 0.26688}}};

}  // namespace

double ClearSky::Perez::At(double cos_zenith, double gamma_rad, double cos_gamma) const {
  return (1.0 + a * std::exp(b / cos_zenith)) *
         (1.0 + c * std::exp(d * gamma_rad) + e * cos_gamma * cos_gamma);
}

ClearSky::ClearSky(const Vec3d& direction_to_sun, double turbidity, double strength)
    : direction_to_sun_(
          direction_to_sun.x(), direction_to_sun.y(), std::max(0.0, direction_to_sun.z())) {
  PFSEQ_CHECK(turbidity >= kMinTurbidity && turbidity <= kMaxTurbidity, "turbidity {}", turbidity);
  direction_to_sun_ =
      direction_to_sun_.norm() > 0.0 ? direction_to_sun_.normalized() : Vec3d(Vec3d::UnitX());
  const double t = turbidity;
  // Ibid., appendix A.2: distribution coefficients of x, y and Y.
  perez_ = {Perez{-0.0193 * t - 0.2592,
                  -0.0665 * t + 0.0008,
                  -0.0004 * t + 0.2125,
                  -0.0641 * t - 0.8989,
                  -0.0033 * t + 0.0452},
            Perez{-0.0167 * t - 0.2608,
                  -0.0950 * t + 0.0092,
                  -0.0079 * t + 0.2102,
                  -0.0441 * t - 1.6537,
                  -0.0109 * t + 0.0529},
            Perez{0.1787 * t - 1.4630,
                  -0.3554 * t + 0.4275,
                  -0.0227 * t + 5.3251,
                  0.1206 * t - 2.5771,
                  -0.0670 * t + 0.3703}};
  const double cos_sun = std::min(1.0, direction_to_sun_.z());
  const double sun_zenith_rad = std::acos(cos_sun);
  scale_ = {ZenithChromaticity(kZenithX, t, sun_zenith_rad),
            ZenithChromaticity(kZenithY, t, sun_zenith_rad),
            ZenithLuminance(t, sun_zenith_rad) * strength};
  for (size_t i = 0; i < 3; ++i) {
    scale_[i] /= perez_[i].At(1.0, sun_zenith_rad, cos_sun);
  }
}

Rgb ClearSky::Radiance(const Vec3d& direction) const {
  // At the horizon itself exp(b / cos) is 0, its limit.
  const double cos_zenith = std::max(direction.z(), 1e-9);
  const double cos_gamma = std::clamp(direction.dot(direction_to_sun_), -1.0, 1.0);
  const double gamma_rad = std::acos(cos_gamma);
  const double x = scale_[0] * perez_[0].At(cos_zenith, gamma_rad, cos_gamma);
  const double y = scale_[1] * perez_[1].At(cos_zenith, gamma_rad, cos_gamma);
  const double luminance =
      std::max(0.0, scale_[2] * perez_[2].At(cos_zenith, gamma_rad, cos_gamma));
  return RgbFromXyz(Vec3d(x / y, 1.0, (1.0 - x - y) / y) * luminance).max(0.0F);
}

}  // namespace pfseq
