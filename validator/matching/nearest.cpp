// SPDX-License-Identifier: Apache-2.0
#include "validator/matching/nearest.h"

#include "renderer/core/check.h"
#include "renderer/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace pfseq {
namespace {

constexpr int kTileGroups = 32;    // Of SIFT 64 KiB, which stay in the second-level cache.
constexpr int kRowsPerTask = 512;  // A multiple of any kernel's num_queries.
constexpr int kMaxBytes = 2048;
constexpr int kMaxHammingBytes = 124;
constexpr int kMaxFloats = 8192;

int RoundUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

KernelMetric MetricOf(const Descriptors& descriptors) {
  switch (descriptors.norm) {
    case Norm::kL2:
      return descriptors.rows.type() == CV_32F ? KernelMetric::kFloats : KernelMetric::kBytes;
    case Norm::kHamming:
      return KernelMetric::kHamming;
    case Norm::kHamming2:
      return KernelMetric::kHamming2;
  }
  PFSEQ_CHECK(false, "norm {}", static_cast<int>(descriptors.norm));
}

int32_t Bits(float value) {
  int32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// Keys below this are of real rows. Half of what padding rows have, because the norms of packed
/// bytes may be negative.
int32_t FarKey(KernelMetric metric) {
  return metric == KernelMetric::kFloats ? Bits(0.5F * kFarFloat) : kFarInteger / 2;
}

/// Which side of the comparison rows are packed for.
enum class Side { kFirst, kSecond };

/// One row as words of the kernel, and what is added to its distances.
class RowPacker {
 public:
  RowPacker(const Descriptors& descriptors, const Kernel& kernel, Side side)
      : rows_(descriptors.rows),
        metric_(MetricOf(descriptors)),
        packs_bytes_(kernel.packs_bytes),
        side_(side) {}

  int NumWords() const {
    const int per_word = metric_ == KernelMetric::kFloats                   ? 1
                         : metric_ == KernelMetric::kBytes && !packs_bytes_ ? 2
                                                                            : 4;
    return std::max(1, (rows_.cols + per_word - 1) / per_word);
  }

  int32_t Pack(int row, std::vector<uint32_t>& words) const {
    std::fill(words.begin(), words.end(), 0U);
    if (metric_ == KernelMetric::kFloats) {
      return PackFloats(rows_.ptr<float>(row), words);
    }
    const uint8_t* bytes = rows_.ptr<uint8_t>(row);
    if (metric_ != KernelMetric::kBytes) {
      std::memcpy(words.data(), bytes, rows_.cols);
      return 0;
    }
    int32_t square = 0;
    int32_t sum = 0;
    for (int i = 0; i < rows_.cols; ++i) {
      square += bytes[i] * bytes[i];
      sum += bytes[i];
      if (packs_bytes_) {
        // Padding of the first set is 0, so that of the second does not matter.
        const uint32_t byte = side_ == Side::kFirst ? bytes[i] : (bytes[i] - 128U) & 0xffU;
        words[i / 4] |= byte << (8 * (i % 4));
      } else {
        words[i / 2] |= static_cast<uint32_t>(bytes[i]) << (16 * (i % 2));
      }
    }
    return packs_bytes_ && side_ == Side::kFirst ? square - 256 * sum : square;
  }

  KernelMetric Metric() const { return metric_; }

 private:
  int32_t PackFloats(const float* values, std::vector<uint32_t>& words) const {
    float square = 0.0F;
    for (int i = 0; i < rows_.cols; ++i) {
      std::memcpy(&words[i], &values[i], sizeof(float));
      square = std::fma(values[i], values[i], square);
    }
    return Bits(square);
  }

  const cv::Mat& rows_;
  KernelMetric metric_;
  bool packs_bytes_;
  Side side_;
};

/// Rows sorted by class, each class padded to whole blocks.
struct PackedSet {
  PackedSet(const ClassedDescriptors& set, const Kernel& kernel, Side side)
      : num_classes(set.num_classes), packer(*set.descriptors, kernel, side) {
    const int lanes = side == Side::kFirst ? 1 : kernel.num_lanes;
    const int block =
        side == Side::kFirst ? kernel.num_queries : kernel.num_groups * kernel.num_lanes;
    const int num_words = packer.NumWords();
    std::vector<std::vector<int>> rows_of_class(num_classes);
    for (size_t row = 0; row < set.row_class.size(); ++row) {
      rows_of_class[set.row_class[row]].push_back(static_cast<int>(row));
    }
    class_begin.push_back(0);
    for (const std::vector<int>& rows : rows_of_class) {
      original.insert(original.end(), rows.begin(), rows.end());
      original.resize(RoundUp(static_cast<int>(original.size()), block), -1);
      class_begin.push_back(static_cast<int>(original.size()));
    }
    const bool is_float = packer.Metric() == KernelMetric::kFloats;
    norms.assign(original.size(), is_float ? Bits(kFarFloat) : kFarInteger);
    words.assign(original.size() * num_words, 0U);
    std::vector<uint32_t> row_words(num_words);
    for (size_t i = 0; i < original.size(); ++i) {
      if (original[i] < 0) {
        continue;
      }
      norms[i] = packer.Pack(original[i], row_words);
      uint32_t* to = words.data() + i / lanes * lanes * num_words + i % lanes;
      for (int word = 0; word < num_words; ++word) {
        to[static_cast<size_t>(word) * lanes] = row_words[word];
      }
    }
  }

  int num_classes;
  RowPacker packer;
  /// Of each packed row its row of the set; -1 for padding.
  std::vector<int> original;
  /// Packed rows [class_begin[c], class_begin[c + 1]).
  std::vector<int> class_begin;
  std::vector<uint32_t> words;
  std::vector<int32_t> norms;
};

/// The pass over some packed rows of one class of the first set and all of the second.
class NearestPass {
 public:
  NearestPass(const PackedSet& first, const PackedSet& second, const Kernel& kernel)
      : first_(first),
        second_(second),
        kernel_(kernel),
        far_key_(FarKey(first.packer.Metric())),
        second_distance_(second.original.size(), std::numeric_limits<int32_t>::max()),
        second_idx_(second.original.size(), -1) {}

  void Run(int begin_row, int end_row, std::vector<std::vector<Nearest>>& of_first) {
    for (int begin = begin_row; begin < end_row; begin += kRowsPerTask) {
      const int end = std::min(begin + kRowsPerTask, end_row);
      for (int c = 0; c < second_.num_classes; ++c) {
        RunClass(begin, end, c, of_first[c]);
      }
    }
  }

  /// Takes what the second set's rows have found so far into a table; ties go to smaller indices.
  void Collect(std::vector<Nearest>& of_second) const {
    for (size_t i = 0; i < second_idx_.size(); ++i) {
      if (second_.original[i] >= 0 && second_idx_[i] >= 0 && second_distance_[i] < far_key_) {
        Nearest& nearest = of_second[second_.original[i]];
        nearest = Merge(nearest, {first_.original[second_idx_[i]], second_distance_[i], kNoSecond});
      }
    }
  }

 private:
  static constexpr int32_t kNoSecond = std::numeric_limits<int32_t>::max();

  void RunClass(int begin, int end, int second_class, std::vector<Nearest>& of_first) {
    const int lanes = kernel_.num_lanes;
    const size_t size = static_cast<size_t>(end - begin) * lanes;
    first_distance_.assign(size, std::numeric_limits<int32_t>::max());
    first_second_.assign(size, std::numeric_limits<int32_t>::max());
    first_idx_.assign(size, -1);
    const KernelSets sets = {first_.words.data(),
                             first_.norms.data(),
                             second_.words.data(),
                             second_.norms.data(),
                             first_.packer.NumWords()};
    const KernelBest best = {first_distance_.data(),
                             first_second_.data(),
                             first_idx_.data(),
                             second_distance_.data(),
                             second_idx_.data()};
    const int end_group = second_.class_begin[second_class + 1] / lanes;
    for (int group = second_.class_begin[second_class] / lanes; group < end_group;
         group += kTileGroups) {
      const KernelTile tile = {begin, end, group, std::min(group + kTileGroups, end_group)};
      kernel_.compare(first_.packer.Metric(), sets, tile, best);
    }
    for (int row = begin; row < end; ++row) {
      if (first_.original[row] >= 0) {
        of_first[first_.original[row]] = OfLanes(static_cast<size_t>(row - begin) * lanes);
      }
    }
  }

  Nearest OfLanes(size_t offset) const {
    Nearest nearest;
    for (size_t i = offset; i < offset + kernel_.num_lanes; ++i) {
      if (first_idx_[i] >= 0 && first_distance_[i] < far_key_) {
        nearest = Merge(nearest,
                        {second_.original[first_idx_[i]],
                         first_distance_[i],
                         first_second_[i] < far_key_ ? first_second_[i] : kNoSecond});
      }
    }
    return nearest;
  }

  const PackedSet& first_;
  const PackedSet& second_;
  const Kernel& kernel_;
  int32_t far_key_;
  std::vector<int32_t> second_distance_;
  std::vector<int32_t> second_idx_;
  std::vector<int32_t> first_distance_;
  std::vector<int32_t> first_second_;
  std::vector<int32_t> first_idx_;
};

void CheckSets(const Descriptors& first, const Descriptors& second) {
  PFSEQ_CHECK(first.norm == second.norm && first.rows.cols == second.rows.cols &&
                  first.rows.type() == second.rows.type(),
              "{} and {} columns",
              first.rows.cols,
              second.rows.cols);
  const KernelMetric metric = MetricOf(first);
  const int most = metric == KernelMetric::kFloats  ? kMaxFloats
                   : metric == KernelMetric::kBytes ? kMaxBytes
                                                    : kMaxHammingBytes;
  PFSEQ_CHECK(first.rows.cols <= most, "{} columns", first.rows.cols);
}

}  // namespace

ClassedDescriptors ClassedDescriptors::Whole(const Descriptors& descriptors) {
  return {&descriptors, std::vector<int>(descriptors.rows.rows, 0), 1};
}

const Kernel& BestKernel() {
  static const Kernel& best = []() -> const Kernel& {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vnni") &&
        __builtin_cpu_supports("avx512vpopcntdq")) {
      return kAvx512Kernel;
    }
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? kAvx2Kernel
                                                                           : kPlainKernel;
  }();
  return best;
}

Nearest Merge(const Nearest& a, const Nearest& b) {
  // No neighbour, -1, is the largest index.
  const bool a_first = std::pair(a.key, static_cast<unsigned>(a.idx)) <=
                       std::pair(b.key, static_cast<unsigned>(b.idx));
  const Nearest& near = a_first ? a : b;
  const Nearest& far = a_first ? b : a;
  return {near.idx, near.key, std::min(near.second_key, far.key)};
}

NearestTables FindNearest(const ClassedDescriptors& first,
                          const ClassedDescriptors& second,
                          int num_threads,
                          const Kernel& kernel) {
  NearestTables tables;
  tables.of_first.assign(second.num_classes, std::vector<Nearest>(first.row_class.size()));
  tables.of_second.assign(first.num_classes, std::vector<Nearest>(second.row_class.size()));
  if (first.row_class.empty() || second.row_class.empty()) {
    return tables;
  }
  CheckSets(*first.descriptors, *second.descriptors);
  const PackedSet packed_first(first, kernel, Side::kFirst);
  const PackedSet packed_second(second, kernel, Side::kSecond);
  for (int c = 0; c < first.num_classes; ++c) {
    // A share of the class's rows for each thread, in whole tasks.
    const int begin = packed_first.class_begin[c];
    const int end = packed_first.class_begin[c + 1];
    const int share =
        RoundUp(std::max(1, (end - begin + num_threads - 1) / num_threads), kRowsPerTask);
    const size_t num_shares = (end - begin + share - 1) / share;
    std::vector<NearestPass> passes(num_shares, NearestPass(packed_first, packed_second, kernel));
    ParallelFor(num_shares, num_threads, [&](size_t i) {
      const int share_begin = begin + static_cast<int>(i) * share;
      passes[i].Run(share_begin, std::min(share_begin + share, end), tables.of_first);
    });
    for (const NearestPass& pass : passes) {
      pass.Collect(tables.of_second[c]);
    }
  }
  return tables;
}

double DistanceFromKey(const Descriptors& descriptors, int32_t key) {
  switch (MetricOf(descriptors)) {
    case KernelMetric::kBytes:
      return std::sqrt(static_cast<double>(key));
    case KernelMetric::kFloats: {
      float square;
      std::memcpy(&square, &key, sizeof square);
      return std::sqrt(static_cast<double>(square));
    }
    case KernelMetric::kHamming:
    case KernelMetric::kHamming2:
      return key;
  }
  PFSEQ_CHECK(false, "norm {}", static_cast<int>(descriptors.norm));
}

}  // namespace pfseq
