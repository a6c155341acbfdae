// SPDX-License-Identifier: Apache-2.0
// |a - b|^2 = |a|^2 + |b|^2 - 2 a.b, with a.b from AVX2's pairwise 16-bit products. The second set
// is stored in groups of eight rows, component pairs interleaved, so that one instruction advances
// eight dot products by two components and no sum across lanes is needed.
#include "validator/matching/brute_force_matcher.h"

#include "renderer/core/check.h"
#include "renderer/core/parallel.h"

#include <algorithm>
#include <limits>

#include <immintrin.h>

namespace pfseq {
namespace {

constexpr int kLanes = 8;
constexpr int kQueries =
    4;  // Rows of the first set that are worked on together; with two groups of the
constexpr int kGroups = 2;          // second set they fill the registers.
constexpr int kTileGroups = 32;     // 64 KiB of SIFT descriptors stay in the second-level cache.
constexpr int kRowsPerTask = 1024;  // A multiple of kQueries.
constexpr int kMaxLength = 2048;    // Sums stay below kFar.
constexpr int32_t kFar = 1 << 29;   // Squared norm of padding rows: further than any real one.

int RoundUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

std::vector<int32_t> SquaredNorms(const ByteDescriptors& set, int num_padded) {
  std::vector<int32_t> norms(num_padded, kFar);
  for (int row = 0; row < set.HeightPx(); ++row) {
    norms[row] = 0;
    for (int i = 0; i < set.WidthPx(); ++i) {
      norms[row] += int32_t{set.At(i, row)} * set.At(i, row);
    }
  }
  return norms;
}

/// Rows of 16-bit components, padded with zeros; the first set.
struct PlainRows {
  PlainRows(const ByteDescriptors& set, int num_pairs)
      : num_padded(RoundUp(set.HeightPx(), kQueries)),
        stride(2 * num_pairs),
        values(static_cast<size_t>(num_padded) * stride, 0),
        norms(SquaredNorms(set, num_padded)) {
    for (int row = 0; row < set.HeightPx(); ++row) {
      std::copy_n(
          &set.At(0, row), set.WidthPx(), values.data() + static_cast<size_t>(row) * stride);
    }
  }

  int num_padded;
  int stride;
  std::vector<int16_t> values;
  std::vector<int32_t> norms;
};

/// [group][pair of components][lane][2]; the second set.
struct GroupedRows {
  GroupedRows(const ByteDescriptors& set, int num_pairs)
      : num_groups(RoundUp(set.HeightPx(), kLanes * kGroups) / kLanes),
        stride(2 * kLanes * num_pairs),
        values(static_cast<size_t>(num_groups) * stride, 0),
        norms(SquaredNorms(set, num_groups * kLanes)) {
    for (int row = 0; row < set.HeightPx(); ++row) {
      int16_t* lane =
          values.data() + static_cast<size_t>(row / kLanes) * stride + 2 * (row % kLanes);
      for (int i = 0; i < set.WidthPx(); ++i) {
        lane[i / 2 * 2 * kLanes + i % 2] = set.At(i, row);
      }
    }
  }

  int num_groups;
  int stride;
  std::vector<int16_t> values;
  std::vector<int32_t> norms;
};

/// Least distance so far and whose it is, for many rows.
struct Nearest {
  explicit Nearest(size_t count)
      : distance(count, std::numeric_limits<int32_t>::max()), idx(count, -1) {}

  std::vector<int32_t> distance;
  std::vector<int32_t> idx;
};

/// Eight distances and whose they are, on their way between memory and registers.
struct EightNearest {
  __m256i distance;
  __m256i idx;

  __attribute__((target("avx2"))) static EightNearest Load(const Nearest& from, size_t offset) {
    return {
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from.distance.data() + offset)),
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from.idx.data() + offset)),
    };
  }

  __attribute__((target("avx2"))) void Store(Nearest& to, size_t offset) const {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to.distance.data() + offset), distance);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to.idx.data() + offset), idx);
  }

  /// Takes the smaller distances; equal ones keep the earlier index.
  __attribute__((target("avx2"))) void KeepSmaller(__m256i new_distance, __m256i new_idx) {
    const __m256i smaller = _mm256_cmpgt_epi32(distance, new_distance);
    distance = _mm256_min_epi32(distance, new_distance);
    idx = _mm256_blendv_epi8(idx, new_idx, smaller);
  }
};

/// Products of kQueries rows of the first set with kGroups groups of the second. The loops over
/// the register block are unrolled, else the compiler keeps the sums in memory.
struct DotBlock {
  __m256i dot[kQueries][kGroups];

  __attribute__((target("avx2")))
  DotBlock(const int16_t* query, int query_stride, const int16_t* train, int train_stride) {
    const __m256i zero = _mm256_setzero_si256();
    __m256i sums[kQueries][kGroups] = {{zero, zero}, {zero, zero}, {zero, zero}, {zero, zero}};
    for (int i = 0; i < query_stride; i += 2) {
      const int16_t* lanes = train + static_cast<size_t>(i) * kLanes;
      const __m256i train_0 = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(lanes));
      const __m256i train_1 =
          _mm256_loadu_si256(reinterpret_cast<const __m256i*>(lanes + train_stride));
#pragma GCC unroll 4
      for (int q = 0; q < kQueries; ++q) {
        const __m256i pair = _mm256_castps_si256(_mm256_broadcast_ss(
            reinterpret_cast<const float*>(query + static_cast<size_t>(q) * query_stride + i)));
        sums[q][0] = _mm256_add_epi32(sums[q][0], _mm256_madd_epi16(pair, train_0));
        sums[q][1] = _mm256_add_epi32(sums[q][1], _mm256_madd_epi16(pair, train_1));
      }
    }
#pragma GCC unroll 4
    for (int q = 0; q < kQueries; ++q) {
      dot[q][0] = sums[q][0];
      dot[q][1] = sums[q][1];
    }
  }
};

/// Squared distances of kQueries rows at `first_row` to kGroups groups at `group`, into both sides'
/// nearest: `by_first` has kLanes candidates for each row of the task, `by_second` one for each row
/// of the second set.
__attribute__((target("avx2"))) void CompareBlock(const PlainRows& first,
                                                  int first_row,
                                                  int first_row_in_task,
                                                  const GroupedRows& second,
                                                  int group,
                                                  Nearest& by_first,
                                                  Nearest& by_second) {
  const DotBlock block(first.values.data() + static_cast<size_t>(first_row) * first.stride,
                       first.stride,
                       second.values.data() + static_cast<size_t>(group) * second.stride,
                       second.stride);
  const __m256i lane_idx = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
#pragma GCC unroll 2
  for (int g = 0; g < kGroups; ++g) {
    const int second_row = (group + g) * kLanes;
    const __m256i train_norm =
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(second.norms.data() + second_row));
    const __m256i second_idx = _mm256_add_epi32(_mm256_set1_epi32(second_row), lane_idx);
    EightNearest of_second = EightNearest::Load(by_second, second_row);
#pragma GCC unroll 4
    for (int q = 0; q < kQueries; ++q) {
      const __m256i norms =
          _mm256_add_epi32(train_norm, _mm256_set1_epi32(first.norms[first_row + q]));
      const __m256i distance = _mm256_sub_epi32(norms, _mm256_slli_epi32(block.dot[q][g], 1));
      const size_t offset = static_cast<size_t>(first_row_in_task + q) * kLanes;
      EightNearest of_first = EightNearest::Load(by_first, offset);
      of_first.KeepSmaller(distance, second_idx);
      of_first.Store(by_first, offset);
      of_second.KeepSmaller(distance, _mm256_set1_epi32(first_row + q));
    }
    of_second.Store(by_second, second_row);
  }
}

/// Compares a task's rows of the first set with all of the second. `nearest_second` receives each
/// row's nearest.
void CompareTask(const PlainRows& first,
                 int begin_row,
                 int end_row,
                 const GroupedRows& second,
                 std::vector<int32_t>& nearest_second,
                 Nearest& by_second) {
  Nearest by_first(static_cast<size_t>(end_row - begin_row) * kLanes);
  for (int tile = 0; tile < second.num_groups; tile += kTileGroups) {
    const int tile_end = std::min(tile + kTileGroups, second.num_groups);
    for (int row = begin_row; row < end_row; row += kQueries) {
      for (int group = tile; group < tile_end; group += kGroups) {
        CompareBlock(first, row, row - begin_row, second, group, by_first, by_second);
      }
    }
  }
  for (int row = begin_row; row < end_row; ++row) {
    const size_t offset = static_cast<size_t>(row - begin_row) * kLanes;
    size_t best = offset;
    for (size_t i = offset + 1; i < offset + kLanes; ++i) {
      if (by_first.distance[i] < by_first.distance[best] ||
          (by_first.distance[i] == by_first.distance[best] &&
           by_first.idx[i] < by_first.idx[best])) {
        best = i;
      }
    }
    nearest_second[row] = by_first.idx[best];
  }
}

}  // namespace

std::vector<DescriptorMatch> MatchBruteForce(const ByteDescriptors& first,
                                             const ByteDescriptors& second,
                                             int num_threads) {
  if (first.HeightPx() == 0 || second.HeightPx() == 0) {
    return {};
  }
  const int length = first.WidthPx();
  PFSEQ_CHECK(
      length == second.WidthPx() && length <= kMaxLength, "{} and {}", length, second.WidthPx());
  const PlainRows plain(first, (length + 1) / 2);
  const GroupedRows grouped(second, (length + 1) / 2);

  const size_t num_tasks = (plain.num_padded + kRowsPerTask - 1) / kRowsPerTask;
  const size_t num_second = grouped.norms.size();
  std::vector<int32_t> nearest_second(plain.num_padded);
  std::vector<Nearest> by_second(num_tasks, Nearest(num_second));
  ParallelFor(num_tasks, num_threads, [&](size_t task) {
    const int begin_row = static_cast<int>(task) * kRowsPerTask;
    const int end_row = std::min(begin_row + kRowsPerTask, plain.num_padded);
    CompareTask(plain, begin_row, end_row, grouped, nearest_second, by_second[task]);
  });

  // Tasks are in ascending order of rows, so that of equal distances the first is the smallest
  // index.
  std::vector<const Nearest*> nearest_first(num_second, &by_second[0]);
  for (size_t row = 0; row < num_second; ++row) {
    for (const Nearest& task : by_second) {
      if (task.distance[row] < nearest_first[row]->distance[row]) {
        nearest_first[row] = &task;
      }
    }
  }
  std::vector<DescriptorMatch> matches;
  for (int row = 0; row < first.HeightPx(); ++row) {
    const int32_t second_idx = nearest_second[row];
    const Nearest& back = *nearest_first[second_idx];
    if (back.idx[second_idx] == row) {
      matches.push_back({row, second_idx, back.distance[second_idx]});
    }
  }
  return matches;
}

}  // namespace pfseq
