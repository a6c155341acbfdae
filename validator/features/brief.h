// SPDX-License-Identifier: Apache-2.0
// BRIEF: Calonder, Lepetit, Strecha, Fua, "BRIEF: Binary robust independent elementary features"
// (ECCV 2010): bits that compare smoothed grey values at pairs of places, drawn once from a
// Gaussian of variance S^2 / 25 in a patch of S = 33 pixels (section 3.2, G II); smoothing with
// sigma = 2 over 9 x 9 pixels (section 3.1). Neither scale nor orientation of a point counts.
#pragma once

#include "validator/features/features.h"

namespace pfseq {

/// Descriptors of 16 to 64 bytes; points whose patch leaves the image are left out.
Descriptors DescribeBrief(const cv::Mat& grey, const KeyPoints& points, int num_bytes);

}  // namespace pfseq
