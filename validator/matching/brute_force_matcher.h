// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/features/features.h"

#include <cstdint>
#include <vector>

namespace pfseq {

/// An attempted match: rows of the two sets of descriptors.
struct DescriptorMatch {
  int first_idx = 0;
  int second_idx = 0;
  int32_t squared_distance = 0;

  bool operator==(const DescriptorMatch&) const = default;
};

/// Exact brute force with cross-check: the pairs of descriptors that are each other's nearest
/// neighbour by Euclidean distance, in the order of first_idx; of equal distances the smaller index
/// counts. The same as cv::BFMatcher(NORM_L2, crossCheck), but computed in integers, both
/// directions in one pass. Rows of at most 2048 components; both sets of the same length.
std::vector<DescriptorMatch> MatchBruteForce(const ByteDescriptors& first,
                                             const ByteDescriptors& second,
                                             int num_threads);

}  // namespace pfseq
