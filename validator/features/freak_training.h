// SPDX-License-Identifier: Apache-2.0
// The choice of FREAK's 512 pairs (Alahi et al. 2012, section 4.2): of all 903 pairs of fields,
// over many key points, those whose bit varies most (mean nearest 1/2) are taken first, and of
// these only those that correlate little with the ones taken before. The bound on the correlation
// starts low and is raised until there are enough.
#pragma once

#include "renderer/core/image.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pfseq {

struct FreakTraining {
  /// Pairs of fields, see freak.h.
  std::vector<std::array<int, 2>> pairs;
  size_t num_points = 0;
  /// The bound with which there were enough.
  double max_correlation = 0.0;
};

/// Trains on the key points (SIFT and FAST) of RGB or grey images. InputError with fewer than 1000.
FreakTraining ChooseFreakPairs(const std::vector<Image<uint8_t>>& images);

/// The table as C++ source of freak_pairs.cpp; `provenance` is one line on the images.
std::string FreakPairsSource(const FreakTraining& training, const std::string& provenance);

}  // namespace pfseq
