// SPDX-License-Identifier: Apache-2.0
// CenSurE: Agrawal, Konolige, Blas, "CenSurE: Center surround extremas for realtime feature
// detection and matching" (ECCV 2008), in the star form.
//
// A star of size n is an upright square of half side n and a square turned by 45 degrees of half
// diagonal 3 n / 2, each with its own weight, so that pixels in both count twice. The response at a
// scale is the mean over the star of size n minus the mean over the ring between it and the star of
// size 2 n (grey values): the star's bi-level form of a Laplacian. Scales are half an octave apart:
// n = 1, 2, 3, 4, 6, 8, 11, 16, 23, 32, 45, 64, as far as 2 n <= maxSize. All are computed at full
// resolution, by running sums.
//
// A pixel's response is that of the scale where it is largest in absolute value. Key points are its
// extrema in a window of suppressNonmaxSize^2 pixels with |response| >= responseThreshold that lie
// on no line. An extremum over scale has a scale below and one above: the first and the last scale
// are there for their neighbours alone (a blob larger than all stars has no place of its own). Two
// second moment matrices tell lines, over 9 x 9 places around the point, a quarter of the star's
// size apart: of the gradient of the responses (projected), and of the gradient of "this pixel has
// the point's scale and sign" (binarized); a point is rejected where trace^2 >= threshold *
// determinant.
#pragma once

#include "validator/features/features.h"

#include <vector>

namespace pfseq {

struct CensureSetting {
  /// Of the outer star; 4 to 128. With less than 6 there is no scale with two neighbours.
  int max_size = 16;
  int response_threshold = 30;
  int line_threshold_projected = 10;
  int line_threshold_binarized = 8;
  /// Odd; even values count as the next odd one.
  int suppress_nonmax_size = 5;
};

/// Key points of one setting: size is that of the outer star, response is signed away (absolute),
/// angle -1. In the order of rows, then columns. 8-bit grey image of any size.
KeyPoints DetectCensure(const cv::Mat& grey, const CensureSetting& setting);

/// The same for several settings; the responses are computed once.
std::vector<KeyPoints> DetectCensure(const cv::Mat& grey,
                                     const std::vector<CensureSetting>& settings);

}  // namespace pfseq
