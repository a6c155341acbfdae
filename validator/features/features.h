// SPDX-License-Identifier: Apache-2.0
// What detectors and descriptors make of an image, in OpenCV's terms.
#pragma once

#include "validator/grid/setting.h"

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace pfseq {

/// Key points in OpenCV's pixel coordinates (see pixel_convention.h) of the image they were found
/// in. `size` is the diameter in pixels that the detector gives.
using KeyPoints = std::vector<cv::KeyPoint>;

/// Descriptors of some key points, one row each.
struct Descriptors {
  Norm norm = Norm::kL2;
  /// CV_8U, or CV_32F with the Euclidean norm.
  cv::Mat rows;
  /// Which key point each row describes; ascending. Points that cannot be described (near the
  /// border, without texture) are left out.
  std::vector<int> key_point_idx;
};

}  // namespace pfseq
