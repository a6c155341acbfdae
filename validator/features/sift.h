// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "validator/features/features.h"

#include <cstdint>
#include <string>

namespace pfseq {

/// Lowe's SIFT ("Distinctive image features from scale-invariant keypoints", 2004) as OpenCV has
/// it, with OpenCV's names of the thresholds. All points are kept.
struct SiftSetting {
  int octave_layers = 3;
  double contrast_threshold = 0.04;
  double edge_threshold = 5.0;
  /// Gaussian of the first layer, pixels.
  double sigma_px = 1.6;

  /// The setting in the form of the 2014 study: "SIFT nopol 0.04 5.0 1.6" (nopol: not on a polar
  /// image).
  std::string Name() const;
};

/// Detects and describes on the 8-bit grey of an RGB image. The points are where OpenCV puts them:
/// its release 4.6 doubles the image such that they lie 0.25 pixels too far right and down (OpenCV
/// issue 23123), the same in each image. Same image, same features, in the same order, for any
/// number of threads.
Features DetectSift(const Image<uint8_t>& rgb, const SiftSetting& setting);

}  // namespace pfseq
