// SPDX-License-Identifier: Apache-2.0
// The vector types of the program: double for geometry and ground truth, float for colour and
// shading.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pfseq {

using Vec2d = Eigen::Vector2d;
using Vec3d = Eigen::Vector3d;
using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;

/// Linear Rec. 709 colour, one float a channel (red, green, blue).
using Rgb = Eigen::Array3f;

/// Photometric luminance of a linear Rec. 709 colour (ITU-R BT.709-6, item 3.2).
inline float Luminance(const Rgb& color) {
  return 0.2126F * color[0] + 0.7152F * color[1] + 0.0722F * color[2];
}

}  // namespace pfseq
