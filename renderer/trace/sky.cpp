// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/sky.h"

#include "renderer/core/check.h"
#include "renderer/trace/color.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

constexpr int kNumRows = 64;
constexpr int kNumColumns = 128;
/// Points a side at which a cell's mean luminance is taken.
constexpr int kNumCellPoints = 3;
constexpr double kCellSolidAngle = 4.0 * std::numbers::pi / (kNumRows * kNumColumns);
/// Share of samples that go uniformly to all directions, so that no direction with light is without
/// samples.
constexpr double kUniformShare = 0.02;
constexpr float kGroundAlbedo = 0.2F;

/// The direction of a point of the table, both coordinates in [0, 1]: rows from the nadir up,
/// columns from +X counter-clockwise.
Vec3d DirectionAt(double column, double row) {
  const double z = 2.0 * row - 1.0;
  const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
  const double azimuth_rad = 2.0 * std::numbers::pi * column;
  return {radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), z};
}

/// Index of the interval of a running sum (first element 0, last the total) that holds `value`, and
/// the place in it.
struct Interval {
  int index;
  double fraction;
};

Interval FindInterval(const double* cdf, int num_intervals, double value) {
  const double* above = std::upper_bound(cdf + 1, cdf + num_intervals, value);
  const auto index = static_cast<int>(above - cdf) - 1;
  const double width = cdf[index + 1] - cdf[index];
  const double fraction = width > 0.0 ? (value - cdf[index]) / width : 0.5;
  return {index, std::clamp(fraction, 0.0, 1.0 - 0x1.0p-53)};
}

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

double Sky::Perez::At(double cos_zenith, double gamma_rad, double cos_gamma) const {
  return (1.0 + a * std::exp(b / cos_zenith)) *
         (1.0 + c * std::exp(d * gamma_rad) + e * cos_gamma * cos_gamma);
}

Sky Sky::Constant(const Rgb& radiance) {
  Sky sky;
  sky.constant_ = radiance;
  sky.is_black_ = radiance.maxCoeff() <= 0.0F;
  sky.Tabulate();
  return sky;
}

Sky Sky::Clear(const Vec3d& direction_to_sun, double turbidity, double strength) {
  PFSEQ_CHECK(turbidity >= kMinTurbidity && turbidity <= kMaxTurbidity, "turbidity {}", turbidity);
  Sky sky;
  sky.is_constant_ = false;
  sky.is_black_ = strength <= 0.0;
  sky.direction_to_sun_ =
      Vec3d(direction_to_sun.x(), direction_to_sun.y(), std::max(0.0, direction_to_sun.z()));
  sky.direction_to_sun_ = sky.direction_to_sun_.norm() > 0.0 ? sky.direction_to_sun_.normalized()
                                                             : Vec3d(Vec3d::UnitX());
  const double t = turbidity;
  // Ibid., appendix A.2: distribution coefficients of x, y and Y.
  sky.perez_ = {Perez{-0.0193 * t - 0.2592,
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
  const double cos_sun = std::min(1.0, sky.direction_to_sun_.z());
  const double sun_zenith_rad = std::acos(cos_sun);
  sky.scale_ = {ZenithChromaticity(kZenithX, t, sun_zenith_rad),
                ZenithChromaticity(kZenithY, t, sun_zenith_rad),
                ZenithLuminance(t, sun_zenith_rad) * strength};
  for (size_t i = 0; i < 3; ++i) {
    sky.scale_[i] /= sky.perez_[i].At(1.0, sun_zenith_rad, cos_sun);
  }
  sky.constant_ = sky.HorizontalIrradiance() * (kGroundAlbedo * std::numbers::inv_pi_v<float>);
  sky.Tabulate();
  return sky;
}

Rgb Sky::RadianceAbove(const Vec3d& direction) const {
  if (is_constant_) {
    return constant_;
  }
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

Rgb Sky::Radiance(const Vec3d& direction) const {
  return direction.z() >= 0.0 ? RadianceAbove(direction) : constant_;
}

Rgb Sky::HorizontalIrradiance() const {
  // Midpoint rule in equal steps of azimuth and of the squared cosine; their density cancels the
  // cosine, so E = pi mean(L).
  constexpr int kNumSteps = 128;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int i = 0; i < kNumSteps; ++i) {
    for (int j = 0; j < kNumSteps; ++j) {
      const double z = std::sqrt((i + 0.5) / kNumSteps);
      sum += RadianceAbove(DirectionAt((j + 0.5) / kNumSteps, 0.5 * (z + 1.0))).cast<double>();
    }
  }
  return (sum * (std::numbers::pi / (kNumSteps * kNumSteps))).cast<float>();
}

void Sky::Tabulate() {
  cell_density_.assign(kNumRows * kNumColumns, 1.0);
  double total = 0.0;
  for (int row = 0; row < kNumRows; ++row) {
    for (int column = 0; column < kNumColumns; ++column) {
      double sum = 0.0;
      for (int point = 0; point < kNumCellPoints * kNumCellPoints; ++point) {
        const double x = (point % kNumCellPoints + 0.5) / kNumCellPoints;
        const double y = (point / kNumCellPoints + 0.5) / kNumCellPoints;
        sum += Luminance(Radiance(DirectionAt((column + x) / kNumColumns, (row + y) / kNumRows)));
      }
      cell_density_[static_cast<size_t>(row * kNumColumns + column)] = sum;
      total += sum;
    }
  }
  const double uniform = 1.0 / (kNumRows * kNumColumns);
  row_cdf_.assign(kNumRows + 1, 0.0);
  column_cdf_.assign(kNumRows * (kNumColumns + 1), 0.0);
  for (int row = 0; row < kNumRows; ++row) {
    double* cdf = &column_cdf_[static_cast<size_t>(row * (kNumColumns + 1))];
    for (int column = 0; column < kNumColumns; ++column) {
      double& density = cell_density_[static_cast<size_t>(row * kNumColumns + column)];
      density =
          total > 0.0 ? (1.0 - kUniformShare) * density / total + kUniformShare * uniform : uniform;
      cdf[column + 1] = cdf[column] + density;
    }
    row_cdf_[static_cast<size_t>(row) + 1] = row_cdf_[static_cast<size_t>(row)] + cdf[kNumColumns];
  }
}

Sky::DirectionSample Sky::SampleDirection(const Vec2d& sample) const {
  const Interval row = FindInterval(row_cdf_.data(), kNumRows, sample.y() * row_cdf_.back());
  const double* cdf = &column_cdf_[static_cast<size_t>(row.index * (kNumColumns + 1))];
  const Interval column = FindInterval(cdf, kNumColumns, sample.x() * cdf[kNumColumns]);
  const Vec3d direction = DirectionAt((column.index + column.fraction) / kNumColumns,
                                      (row.index + row.fraction) / kNumRows);
  const double probability =
      cell_density_[static_cast<size_t>(row.index * kNumColumns + column.index)];
  return {direction, probability / kCellSolidAngle};
}

double Sky::Pdf(const Vec3d& direction) const {
  double turn = std::atan2(direction.y(), direction.x()) / (2.0 * std::numbers::pi);
  turn -= std::floor(turn);
  const int column = std::min(static_cast<int>(turn * kNumColumns), kNumColumns - 1);
  const int row =
      std::clamp(static_cast<int>((0.5 * direction.z() + 0.5) * kNumRows), 0, kNumRows - 1);
  return cell_density_[static_cast<size_t>(row * kNumColumns + column)] / kCellSolidAngle;
}

}  // namespace pfseq
