// SPDX-License-Identifier: Apache-2.0
// Attempted matches.
//
//   BruteForce  mutual nearest neighbours (cross-check)
//   RatioTest   a descriptor's nearest in the second set, where it is nearer than `ratio` times the
//               second nearest (Lowe 2004, section 7.1); nothing where there is no second
//   FLANN       RatioTest on the neighbours that randomised kd-trees find (Muja, Lowe 2009), of
//               float descriptors; its random numbers are seeded, so that it is repeatable
#pragma once

#include "validator/features/features.h"
#include "validator/matching/nearest.h"

#include <vector>

namespace pfseq {

/// Rows of two sets of descriptors that belong together.
struct RowMatch {
  int first = 0;
  int second = 0;

  bool operator==(const RowMatch&) const = default;
};

/// The neighbours of a subset of both sets: rows whose class has its bit in `classes`.
struct SubsetNeighbours {
  const NearestTables* tables = nullptr;
  const ClassedDescriptors* first = nullptr;
  const ClassedDescriptors* second = nullptr;
  /// Which classes of the first and second set belong to the subset.
  std::vector<bool> first_classes;
  std::vector<bool> second_classes;

  /// Of a row of the first set among the subset's rows of the second.
  Nearest OfFirst(int row) const;
  Nearest OfSecond(int row) const;
};

/// Ascending in rows of the first set; so below.
std::vector<RowMatch> CrossCheckedMatches(const SubsetNeighbours& neighbours);
std::vector<RowMatch> RatioMatches(const SubsetNeighbours& neighbours, double ratio);

struct FlannSetting {
  int trees = 4;
  int checks = 32;
  double ratio = 0.8;
};

/// Between some rows of two sets (ascending). One thread.
std::vector<RowMatch> FlannMatches(const Descriptors& first,
                                   const std::vector<int>& first_rows,
                                   const Descriptors& second,
                                   const std::vector<int>& second_rows,
                                   const FlannSetting& setting);

}  // namespace pfseq
