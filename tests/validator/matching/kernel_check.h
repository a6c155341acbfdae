// SPDX-License-Identifier: Apache-2.0
// A kernel by itself, on sets in its own layout.
#pragma once

#include "renderer/core/random.h"
#include "validator/matching/nearest_kernel.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {

/// Compares two blocks of random words with norms of their own both ways; `distance` is that of
/// two rows by the definition, without the norms.
template <typename Distance>
void ExpectNearestOf(const Kernel& kernel,
                     KernelMetric metric,
                     uint32_t mask,
                     const Distance& distance) {
  constexpr int kWords = 5;
  const int num_first = 2 * kernel.num_queries;
  const int num_groups = 2 * kernel.num_groups;
  const int num_second = num_groups * kernel.num_lanes;
  RandomStream random{9};
  const auto draw = [&](int count) {
    std::vector<uint32_t> words(static_cast<size_t>(count));
    for (uint32_t& word : words) {
      word = static_cast<uint32_t>(random.Bits()) & mask;
    }
    return words;
  };
  const std::vector<uint32_t> first = draw(num_first * kWords);
  const std::vector<uint32_t> second = draw(num_second * kWords);
  // [group][word][lane]
  std::vector<uint32_t> packed(second.size());
  for (int row = 0; row < num_second; ++row) {
    for (int word = 0; word < kWords; ++word) {
      const int lane = row % kernel.num_lanes;
      const int group = row / kernel.num_lanes;
      packed[static_cast<size_t>((group * kWords + word) * kernel.num_lanes + lane)] =
          second[static_cast<size_t>(row * kWords + word)];
    }
  }
  std::vector<int32_t> first_norm;
  std::vector<int32_t> second_norm;
  for (int i = 0; i < num_first; ++i) {
    first_norm.push_back(random.Integer(0, 3));
  }
  for (int i = 0; i < num_second; ++i) {
    second_norm.push_back(random.Integer(0, 3));
  }
  constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
  const auto num_best = static_cast<size_t>(num_first * kernel.num_lanes);
  std::vector<int32_t> least(num_best, kMost);
  std::vector<int32_t> next(num_best, kMost);
  std::vector<int32_t> whose(num_best, -1);
  std::vector<int32_t> second_least(static_cast<size_t>(num_second), kMost);
  std::vector<int32_t> second_whose(static_cast<size_t>(num_second), -1);
  kernel.compare(
      metric,
      {first.data(), first_norm.data(), packed.data(), second_norm.data(), kWords},
      {0, num_first, 0, num_groups},
      {least.data(), next.data(), whose.data(), second_least.data(), second_whose.data()});

  const auto distance_of = [&](int i, int j) {
    return distance(&first[static_cast<size_t>(i * kWords)],
                    &second[static_cast<size_t>(j * kWords)],
                    kWords) +
           first_norm[static_cast<size_t>(i)] + second_norm[static_cast<size_t>(j)];
  };
  for (int i = 0; i < num_first; ++i) {
    for (int lane = 0; lane < kernel.num_lanes; ++lane) {
      std::vector<std::pair<int32_t, int>> all;
      for (int group = 0; group < num_groups; ++group) {
        const int j = group * kernel.num_lanes + lane;
        all.emplace_back(distance_of(i, j), j);
      }
      std::sort(all.begin(), all.end());
      const auto at = static_cast<size_t>(i * kernel.num_lanes + lane);
      EXPECT_EQ(least[at], all[0].first);
      EXPECT_EQ(whose[at], all[0].second);
      EXPECT_EQ(next[at], all[1].first);
    }
  }
  for (int j = 0; j < num_second; ++j) {
    std::pair<int32_t, int> best(kMost, -1);
    for (int i = 0; i < num_first; ++i) {
      best = std::min(best, {distance_of(i, j), i});
    }
    EXPECT_EQ(second_least[static_cast<size_t>(j)], best.first);
    EXPECT_EQ(second_whose[static_cast<size_t>(j)], best.second);
  }
}

/// The sum of `term` over the words of two rows.
template <typename Term>
auto SumOver(const Term& term) {
  return [term](const uint32_t* a, const uint32_t* b, int num_words) {
    int32_t sum = 0;
    for (int i = 0; i < num_words; ++i) {
      sum += term(a[i], b[i]);
    }
    return sum;
  };
}

/// All of a kernel's metrics of integers. Of bytes the norms are the caller's, so that -2 a.b is
/// left, of two 16-bit values a word or of four bytes, the second set's signed.
inline void ExpectDefinitions(const Kernel& kernel) {
  ExpectNearestOf(kernel, KernelMetric::kHamming, ~0U, SumOver([](uint32_t a, uint32_t b) {
                    return std::popcount(a ^ b);
                  }));
  ExpectNearestOf(kernel, KernelMetric::kHamming2, ~0U, SumOver([](uint32_t a, uint32_t b) {
                    int num_different = 0;
                    for (int symbol = 0; symbol < 32; symbol += 2) {
                      num_different += (a >> symbol & 3U) != (b >> symbol & 3U) ? 1 : 0;
                    }
                    return num_different;
                  }));
  const uint32_t mask = kernel.packs_bytes ? ~0U : 0x00ff00ffU;
  ExpectNearestOf(kernel, KernelMetric::kBytes, mask, SumOver([&](uint32_t a, uint32_t b) {
                    int product = 0;
                    for (int shift = 0; shift < 32; shift += kernel.packs_bytes ? 8 : 16) {
                      const auto byte_of_b = static_cast<int>(b >> shift & 0xffU);
                      product +=
                          static_cast<int>(a >> shift & 0xffU) *
                          (kernel.packs_bytes && byte_of_b > 127 ? byte_of_b - 256 : byte_of_b);
                    }
                    return -2 * product;
                  }));
}

}  // namespace pfseq
