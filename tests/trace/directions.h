// SPDX-License-Identifier: Apache-2.0
// Directions, and integrals over them.
#pragma once

#include "renderer/core/units.h"
#include "renderer/core/vector.h"

#include <cmath>
#include <numbers>

namespace pfseq {

/// Azimuth counter-clockwise from +X.
inline Vec3d DirectionAt(double elevation_deg, double azimuth_deg) {
  const double elevation_rad = RadFromDeg(elevation_deg);
  const double azimuth_rad = RadFromDeg(azimuth_deg);
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

/// Integral of a function of direction over the sphere, on a grid of equal solid angles that has
/// nothing to do with how skies are stored.
template <typename Function>
double IntegrateSphere(const Function& function, int num_rows = 640) {
  const int num_columns = 2 * num_rows;
  double sum = 0.0;
  for (int i = 0; i < num_rows; ++i) {
    for (int j = 0; j < num_columns; ++j) {
      const double z = 2.0 * (i + 0.5) / num_rows - 1.0;
      const double azimuth_rad = 2.0 * std::numbers::pi * (j + 0.5) / num_columns;
      const double radius = std::sqrt(1.0 - z * z);
      sum += function(Vec3d(radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), z));
    }
  }
  return sum * 4.0 * std::numbers::pi / (static_cast<double>(num_rows) * num_columns);
}

}  // namespace pfseq
