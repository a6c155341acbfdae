// SPDX-License-Identifier: Apache-2.0
// Colour spaces: CIE 1931 XYZ, linear Rec. 709 and its sRGB encoding.
#pragma once

#include "renderer/core/vector.h"

#include <algorithm>
#include <cmath>

namespace pfseq {

/// Linear Rec. 709 from CIE XYZ; the same Y goes in and out (primaries and D65 white of ITU-R
/// BT.709-6, table 1.3 and 1.4). Colours outside the gamut have negative values.
inline Rgb RgbFromXyz(const Vec3d& xyz) {
  return {static_cast<float>(3.2404542 * xyz.x() - 1.5371385 * xyz.y() - 0.4985314 * xyz.z()),
          static_cast<float>(-0.9692660 * xyz.x() + 1.8760108 * xyz.y() + 0.0415560 * xyz.z()),
          static_cast<float>(0.0556434 * xyz.x() - 0.2040259 * xyz.y() + 1.0572252 * xyz.z())};
}

/// Linear value of an sRGB-encoded one, both in [0, 1] (IEC 61966-2-1:1999, section 5.2).
inline float LinearFromSrgb(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

/// The inverse (IEC 61966-2-1:1999, section 5.3).
inline float SrgbFromLinear(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

}  // namespace pfseq
