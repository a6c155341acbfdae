// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/simd.h"
#include "renderer/core/vector.h"

#include <array>

namespace pfseq {

/// Light that arrives at a point from one side, as the integral of radiance times direction over
/// the hemisphere, for each colour channel: x, y, z of the world, each red, green, blue and unused.
/// Its component along the hemisphere's axis is the irradiance there; along a normal tilted a
/// little against the axis it is that of the tilted surface but for what lies below its horizon.
struct VectorIrradiance {
  Eigen::Array4f x = Eigen::Array4f::Zero();
  Eigen::Array4f y = Eigen::Array4f::Zero();
  Eigen::Array4f z = Eigen::Array4f::Zero();

  /// Component along a direction.
  Rgb Along(const Vec3f& direction) const {
    return (x * direction.x() + y * direction.y() + z * direction.z()).head<3>();
  }
};

/// The same at eight points.
struct LightPacket {
  Rgb8 x;
  Rgb8 y;
  Rgb8 z;

  explicit LightPacket(const std::array<VectorIrradiance, kSimdWidth>& light) {
    std::array<std::array<std::array<float, kSimdWidth>, 3>, 3> parts;
    for (size_t lane = 0; lane < kSimdWidth; ++lane) {
      for (size_t channel = 0; channel < 3; ++channel) {
        const auto index = static_cast<Eigen::Index>(channel);
        parts[0][channel][lane] = light[lane].x[index];
        parts[1][channel][lane] = light[lane].y[index];
        parts[2][channel][lane] = light[lane].z[index];
      }
    }
    const auto load = [&](size_t part) {
      return Rgb8{Float8(parts[part][0]), Float8(parts[part][1]), Float8(parts[part][2])};
    };
    x = load(0);
    y = load(1);
    z = load(2);
  }

  Rgb8 Along(const Vec3x8& direction) const {
    return direction.x * x + direction.y * y + direction.z * z;
  }
};

}  // namespace pfseq
