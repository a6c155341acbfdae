// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/lens/lens.h"
#include "validator/benchmark/benchmark.h"

#include <string>
#include <vector>

namespace pfseq {

/// Attempted matches in a range of some quantity of the first view's point.
struct FailureBin {
  std::string label;
  int attempted = 0;
  int correct = 0;
};

/// Where the matches of a setting on a case are right, within kPictureToleranceM.
struct FailureTable {
  size_t case_idx = 0;
  std::string setup;
  /// By distance from the image circle's centre, in tenths of its radius.
  std::vector<FailureBin> by_radius;
  /// By distance from the camera.
  std::vector<FailureBin> by_distance;
  /// By the way of the pixel's content during the exposure; empty where that is not known.
  std::vector<FailureBin> by_blur;
};

/// `lens` is the first view's; `blur_px` its blur map (two channels, the way in pixels), or null.
FailureTable FailuresOf(size_t case_idx,
                        const TripletMatches& matches,
                        const Lens& lens,
                        const Image<float>* blur_px);

}  // namespace pfseq
