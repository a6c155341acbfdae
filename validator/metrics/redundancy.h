// SPDX-License-Identifier: Apache-2.0
// Rey-Otero, Delbracio, Morel, "A bias in the repeatability criteria" (arXiv 1409.2465): many
// overlapping detections of one place count once. A key point stands for a Gaussian of unit volume
// over its support; the number of non-redundant points is the volume under the maximum of all of
// them, at most their number.
#pragma once

#include "renderer/core/vector.h"

#include <vector>

namespace pfseq {

/// The support of a key point: a Gaussian of deviation size / 4, cut off at half the size.
struct Support {
  Vec2d pixel_px = Vec2d::Zero();
  double size_px = 0.0;
};

/// Counts supports one after the other over an image.
class NonRedundantCount {
 public:
  NonRedundantCount(int width_px, int height_px);

  void Add(const Support& support);
  double Count() const { return volume_; }

 private:
  int width_;
  int height_;
  std::vector<float> highest_;
  double volume_ = 0.0;
};

}  // namespace pfseq
