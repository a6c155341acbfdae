// SPDX-License-Identifier: Apache-2.0
// Exact nearest neighbours between two sets of descriptors, both ways in one pass over all
// distances.
#pragma once

#include "validator/features/features.h"
#include "validator/matching/nearest_kernel.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace pfseq {

/// The nearest row of the other set: of equal distances the one with the smaller index.
struct Nearest {
  /// -1: there is none.
  int idx = -1;
  /// An integer that orders as distances do; DistanceFromKey gives the distance.
  int32_t key = std::numeric_limits<int32_t>::max();
  /// Of the second nearest; the maximum when there is none.
  int32_t second_key = std::numeric_limits<int32_t>::max();
};

/// Rows in classes: key points of a family of settings, for instance by the thresholds that they
/// pass. Neighbours are found class by class, so that one pass serves each union of classes.
struct ClassedDescriptors {
  const Descriptors* descriptors = nullptr;
  /// Of each row, in [0, num_classes).
  std::vector<int> row_class;
  int num_classes = 1;

  /// All rows in one class.
  static ClassedDescriptors Whole(const Descriptors& descriptors);
};

struct NearestTables {
  /// [class of the second set][row of the first]
  std::vector<std::vector<Nearest>> of_first;
  /// [class of the first set][row of the second]; without second_key.
  std::vector<std::vector<Nearest>> of_second;
};

/// The fastest kernel that this processor has.
const Kernel& BestKernel();

/// Both sets have the same norm, type and length: at most 2048 bytes (Euclidean), 992 bits or 8192
/// floats. Integers are exact; float distances are computed in single precision, with the same
/// result for each kernel. Does not depend on the number of threads.
NearestTables FindNearest(const ClassedDescriptors& first,
                          const ClassedDescriptors& second,
                          int num_threads,
                          const Kernel& kernel = BestKernel());

/// The nearest over some classes, from their entries of a row: [class] -> Nearest.
Nearest Merge(const Nearest& a, const Nearest& b);

/// Euclidean distance, or the number of differing bits or symbols.
double DistanceFromKey(const Descriptors& descriptors, int32_t key);

}  // namespace pfseq
