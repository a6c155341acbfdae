// SPDX-License-Identifier: Apache-2.0
// What a detector and a descriptor make of one image.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"

#include <cstdint>
#include <vector>

namespace pfseq {

/// Descriptors of 8-bit components: one row a key point.
using ByteDescriptors = Image<uint8_t>;

/// Key points and their descriptors; row i of the descriptors is that of point i.
struct Features {
  /// Continuous pixel coordinates, origin at the image's outer upper-left corner.
  std::vector<Vec2d> pixels_px;
  ByteDescriptors descriptors;
};

}  // namespace pfseq
