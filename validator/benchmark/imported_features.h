// SPDX-License-Identifier: Apache-2.0
// Features made elsewhere, for instance by learned methods, from files.
//
// Key points of an image, as .npz:
//   keypoints     N x 2 (or N x 3 with the size): x, y in pixels
//   scores        N, optional: the larger the stronger
//   sizes         N, optional: diameters in pixels
//   descriptors   N x D (D x N is turned), optional: floats or bytes; bits as bytes with Hamming
// or as .csv with the columns x,y, and optionally size, score and d0, d1, ...
// Matches of a pair, as .npz: matches, M x 2, indices of key points (-1: none); or as .csv with the
// columns first,second.
#pragma once

#include "validator/benchmark/view_source.h"
#include "validator/features/features.h"
#include "validator/grid/grid.h"

#include <string>
#include <utility>
#include <vector>

namespace pfseq {

struct ImportedFeatures {
  /// Our pixel convention.
  std::vector<Vec2d> pixels_px;
  std::vector<double> sizes_px;
  std::vector<double> scores;
  /// One row a key point, or no rows at all.
  Descriptors descriptors;
};

/// A path with {lens}, {camera}, {variant} and {frame} or {frame:06} filled in. InputError for
/// another word in braces.
std::string FillPath(const std::string& pattern,
                     const std::vector<std::pair<std::string, std::string>>& words);

/// InputError with path and fault.
ImportedFeatures ReadImportedFeatures(const ImportedSetting& setting,
                                      const std::string& lens,
                                      const ViewName& view,
                                      const std::string& variant);

std::vector<std::pair<int, int>> ReadImportedMatches(const ImportedSetting& setting,
                                                     const std::string& lens,
                                                     const ViewName& first,
                                                     const ViewName& second);

}  // namespace pfseq
