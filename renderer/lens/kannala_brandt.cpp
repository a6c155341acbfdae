// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/kannala_brandt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace pfseq {
namespace {

double EvaluatePolynomial(const std::vector<double>& coefficients, double x) {
  double value = 0.0;
  for (size_t i = coefficients.size(); i-- > 0;) {
    value = value * x + coefficients[i];
  }
  return value;
}

/// A sign change of the polynomial in [low, high], whose ends have values of different signs, by
/// bisection to rounding.
double Bisect(const std::vector<double>& coefficients, double low, double high) {
  const bool is_positive_low = EvaluatePolynomial(coefficients, low) > 0.0;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) {
      return low;
    }
    ((EvaluatePolynomial(coefficients, middle) > 0.0) == is_positive_low ? low : high) = middle;
  }
}

/// All sign changes of a polynomial in (0, end), ascending. Between neighbouring extrema, which are
/// the sign changes of the derivative, there is at most one.
std::vector<double> SignChanges(const std::vector<double>& coefficients, double end) {
  if (coefficients.size() < 2) {
    return {};
  }
  std::vector<double> derivative;
  for (size_t i = 1; i < coefficients.size(); ++i) {
    derivative.push_back(static_cast<double>(i) * coefficients[i]);
  }
  std::vector<double> borders = SignChanges(derivative, end);
  borders.push_back(end);
  std::vector<double> roots;
  double low = 0.0;
  for (const double high : borders) {
    if ((EvaluatePolynomial(coefficients, low) > 0.0) !=
        (EvaluatePolynomial(coefficients, high) > 0.0)) {
      roots.push_back(Bisect(coefficients, low, high));
    }
    low = high;
  }
  return roots;
}

}  // namespace

KannalaBrandt::KannalaBrandt(const std::array<double, 4>& coefficients)
    : coefficients_(coefficients), limit_angle_rad_(std::numbers::pi) {
  // The slope is a polynomial of degree 4 in the square of the angle.
  const std::vector<double> slope = {1.0,
                                     3.0 * coefficients[0],
                                     5.0 * coefficients[1],
                                     7.0 * coefficients[2],
                                     9.0 * coefficients[3]};
  const std::vector<double> roots = SignChanges(slope, std::numbers::pi * std::numbers::pi);
  if (!roots.empty()) {
    limit_angle_rad_ = std::sqrt(roots.front());
  }
}

double KannalaBrandt::ImageHeight(double theta_rad) const {
  const double t2 = theta_rad * theta_rad;
  const auto& [k1, k2, k3, k4] = coefficients_;
  return theta_rad * (1.0 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4))));
}

double KannalaBrandt::Slope(double theta_rad) const {
  const double t2 = theta_rad * theta_rad;
  const auto& [k1, k2, k3, k4] = coefficients_;
  return 1.0 + t2 * (3.0 * k1 + t2 * (5.0 * k2 + t2 * (7.0 * k3 + t2 * (9.0 * k4))));
}

double KannalaBrandt::IncidenceAngleRad(double height) const {
  if (!(height <= ImageHeight(limit_angle_rad_))) {
    return std::numeric_limits<double>::infinity();
  }
  double low = 0.0;
  double high = limit_angle_rad_;
  double theta_rad = std::min(height, high);
  // Halving alone ends within 60 rounds; Newton's steps take 3 to 6.
  while (true) {
    const double excess = ImageHeight(theta_rad) - height;
    if (excess == 0.0) {
      return theta_rad;
    }
    (excess > 0.0 ? high : low) = theta_rad;
    double next = theta_rad - excess / Slope(theta_rad);
    if (!(next > low && next < high)) {
      next = 0.5 * (low + high);
    }
    if (std::abs(next - theta_rad) <= std::numeric_limits<double>::epsilon() * theta_rad ||
        next <= low || next >= high) {
      return next;
    }
    theta_rad = next;
  }
}

}  // namespace pfseq
