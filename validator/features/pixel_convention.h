// SPDX-License-Identifier: Apache-2.0
// The border between OpenCV's pixel coordinates and ours.
#pragma once

#include "renderer/core/vector.h"

namespace pfseq {

/// OpenCV's origin is the centre of the first pixel, ours the image's outer upper-left corner: its
/// (0, 0) is our (0.5, 0.5). The only place where the two meet.
inline Vec2d PixelFromOpenCv(double x_px, double y_px) { return {x_px + 0.5, y_px + 0.5}; }

}  // namespace pfseq
