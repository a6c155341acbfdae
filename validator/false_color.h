// SPDX-License-Identifier: Apache-2.0
// Distances and sky as people can look at them.
#pragma once

#include "renderer/core/image.h"

#include <cstdint>

namespace pfseq {

/// Distances from here to there have colours of their own; nearer and further ones take the ends'.
inline constexpr double kNearestColorM = 2.0;
inline constexpr double kFurthestColorM = 200.0;

/// 8-bit RGB of a distance map in metres: "viridis" over the logarithm of the distance, from dark
/// (near) to light (far); +inf (sky, or beyond the map's reach) light grey, 0 (outside the circle)
/// black.
Image<uint8_t> DistanceInColor(const Image<float>& distance_m);

/// A bar of those colours with their metres beside it, `width_px` wide and 44 px high.
Image<uint8_t> DistanceLegend(int width_px);

}  // namespace pfseq
