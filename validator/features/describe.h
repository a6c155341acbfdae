// SPDX-License-Identifier: Apache-2.0
// Descriptors of any kind for key points of any detector.
//
// OpenCV expects points of its own detector; foreign ones are made to fit, on copies:
//   SIFT   the size counts as 2 sigma; octave and layer follow from it. The image's blur (sigma)
//   and
//          layers are those of a SIFT detector, else 1.6 and 3.
//   ORB    pyramid level round(log(size / 31) / log 1.2) in 0 ... 7; with an ORB detector its own
//          pyramid.
//   all    an angle of -1 (none) counts as 0.
// Sizes are taken as the detectors give them, as the report of 2014 does, although what OpenCV
// calls size differs (2 sigma for SIFT, the patch for ORB and BRISK); the descriptors' parameter
// sizeScale changes that: SIFT sizeScale=0.226 (7/31) suits ORB points.
#pragma once

#include "validator/features/features.h"
#include "validator/grid/setting.h"

namespace pfseq {

/// The descriptors of key points of `detector`, in the points' order. The same point has the same
/// descriptor, whatever the other points. ORB descriptors of bits all 0 (no texture) are left out.
Descriptors Describe(const cv::Mat& grey,
                     const KeyPoints& points,
                     const Setting& detector,
                     const Setting& descriptor);

}  // namespace pfseq
