// SPDX-License-Identifier: Apache-2.0
// The loops for one instruction set. The including file defines, in an anonymous namespace before
// it:
//   Ints           a vector of 32-bit integers; kLanes, kQueries, kGroups
//   Load, Store, Set1, LaneIdx, Add, Min, Max, ChooseIfGreater(a, b, x, y): a > b ? x : y
//   BytesMetric, FloatsMetric, HammingMetric, Hamming2Metric: Sum, Zero(), Step(sum, a, b) and
//   Distance(sum, first norm, second norm)

/// Distances of kQueries rows to kGroups groups, into both sides' best. The loops over the register
/// block are unrolled, else the compiler keeps the sums in memory.
template <typename Metric>
inline void CompareBlock(const KernelSets& sets,
                         int row,
                         int row_in_tile,
                         int group,
                         const KernelBest& best) {
  const uint32_t* first = sets.first + static_cast<int64_t>(row) * sets.num_words;
  const int64_t stride = static_cast<int64_t>(sets.num_words) * kLanes;
  const uint32_t* second = sets.second + group * stride;
  typename Metric::Sum sums[kQueries][kGroups];
#pragma GCC unroll 8
  for (int q = 0; q < kQueries; ++q) {
#pragma GCC unroll 8
    for (int g = 0; g < kGroups; ++g) {
      sums[q][g] = Metric::Zero();
    }
  }
  for (int word = 0; word < sets.num_words; ++word) {
    Ints lanes[kGroups];
#pragma GCC unroll 8
    for (int g = 0; g < kGroups; ++g) {
      lanes[g] = Load(second + g * stride + static_cast<int64_t>(word) * kLanes);
    }
#pragma GCC unroll 8
    for (int q = 0; q < kQueries; ++q) {
      const Ints query =
          Set1(static_cast<int32_t>(first[static_cast<int64_t>(q) * sets.num_words + word]));
#pragma GCC unroll 8
      for (int g = 0; g < kGroups; ++g) {
        sums[q][g] = Metric::Step(sums[q][g], query, lanes[g]);
      }
    }
  }
#pragma GCC unroll 8
  for (int q = 0; q < kQueries; ++q) {
    const int64_t offset = static_cast<int64_t>(row_in_tile + q) * kLanes;
    Ints least = Load(best.first_distance + offset);
    Ints next = Load(best.first_second + offset);
    Ints whose = Load(best.first_idx + offset);
    const Ints norm = Set1(sets.first_norm[row + q]);
    const Ints row_idx = Set1(row + q);
#pragma GCC unroll 8
    for (int g = 0; g < kGroups; ++g) {
      const int second_row = (group + g) * kLanes;
      const Ints distance =
          Metric::Distance(sums[q][g], norm, Load(sets.second_norm + second_row));
      // Equal distances keep the earlier, smaller index.
      whose = ChooseIfGreater(least, distance, Add(Set1(second_row), LaneIdx()), whose);
      next = Min(next, Max(least, distance));
      least = Min(least, distance);
      const Ints of_second = Load(best.second_distance + second_row);
      Store(best.second_idx + second_row,
            ChooseIfGreater(of_second, distance, row_idx, Load(best.second_idx + second_row)));
      Store(best.second_distance + second_row, Min(of_second, distance));
    }
    Store(best.first_distance + offset, least);
    Store(best.first_second + offset, next);
    Store(best.first_idx + offset, whose);
  }
}

template <typename Metric>
void CompareTile(const KernelSets& sets, const KernelTile& tile, const KernelBest& best) {
  for (int row = tile.begin_row; row < tile.end_row; row += kQueries) {
    for (int group = tile.begin_group; group < tile.end_group; group += kGroups) {
      CompareBlock<Metric>(sets, row, row - tile.begin_row, group, best);
    }
  }
}

void Compare(KernelMetric metric,
             const KernelSets& sets,
             const KernelTile& tile,
             const KernelBest& best) {
  switch (metric) {
    case KernelMetric::kBytes:
      return CompareTile<BytesMetric>(sets, tile, best);
    case KernelMetric::kFloats:
      return CompareTile<FloatsMetric>(sets, tile, best);
    case KernelMetric::kHamming:
      return CompareTile<HammingMetric>(sets, tile, best);
    case KernelMetric::kHamming2:
      return CompareTile<Hamming2Metric>(sets, tile, best);
  }
}
