// SPDX-License-Identifier: Apache-2.0
// The image that detectors and descriptors work on: the fisheye image or its polar rectification.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"
#include "renderer/lens/lens.h"
#include "validator/features/features.h"
#include "validator/features/polar_image.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pfseq {

/// 8-bit grey (ITU-R BT.601 weights) of an image of 1, 3 or 4 channels.
cv::Mat GreyOf(const Image<uint8_t>& image);

struct WorkImage {
  cv::Mat grey;
  /// Of a rectified image.
  std::optional<PolarMap> polar;

  static WorkImage Fisheye(const Image<uint8_t>& image);
  /// The lens must outlive this.
  static WorkImage Polar(const Image<uint8_t>& image, const Lens& lens);

  /// Whether a key point counts: a polar image shows what is near its seam twice.
  bool Owns(const cv::KeyPoint& point) const;

  /// Where a key point lies in the fisheye image, our pixel convention; nothing beyond the lens.
  std::optional<Vec2d> FisheyePixel(const cv::KeyPoint& point) const;
};

}  // namespace pfseq
