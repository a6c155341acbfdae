// SPDX-License-Identifier: Apache-2.0
// Key points by any detector of the grid.
#pragma once

#include "validator/features/features.h"
#include "validator/grid/setting.h"

#include <vector>

namespace pfseq {

/// Images with fewer pixels on a side have no key points.
inline constexpr int kMinImagePx = 16;

/// floor(log2(min(width, height))): the report's number of octaves for "auto".
int AutoOctaves(const cv::Mat& grey);

/// The key points of one setting, in the detector's order; of 8-bit grey. OpenCV's own calls give
/// the same. Points with a response of 0 each (OpenCV's corners) get one that falls in their order.
KeyPoints Detect(const cv::Mat& grey, const Setting& detector);

/// Key points of several settings of one family, each found once.
struct FamilyKeyPoints {
  /// All points, in the order in which the settings have them.
  KeyPoints points;
  /// Bit m of a point's mask: member m has it.
  std::vector<uint64_t> members;
};

/// Whether two settings differ only in thresholds that are filters, so that they share points: the
/// thresholds of SIFT, and all parameters of CenSurE.
bool SameFamily(const Setting& a, const Setting& b);

/// Detect for up to 64 settings of one family.
FamilyKeyPoints DetectFamily(const cv::Mat& grey, const std::vector<Setting>& members);

}  // namespace pfseq
