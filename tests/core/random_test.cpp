// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/random.h"

#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(HashKey, DependsOnOrderAndEachPart) {
  std::set<uint64_t> hashes;
  for (uint64_t a = 0; a < 30; ++a) {
    for (uint64_t b = 0; b < 30; ++b) {
      hashes.insert(HashKey({a, b}));
    }
  }
  EXPECT_EQ(hashes.size(), 900U);
  EXPECT_NE(HashKey({1}), HashKey({1, 0}));
}

TEST(HashKey, IsTheSameInEveryVersion) {
  // Pinned: sequences rendered earlier must be rendered again to the same bytes.
  EXPECT_EQ(HashKey({1, 2, 3}), 0xd306214c1fe59365ULL);
  EXPECT_EQ(MixBits(1), 0x5692161d100b05e5ULL);
}

TEST(MixBits, FlipsHalfOfTheBitsForAnyInputBit) {
  for (int bit = 0; bit < 64; ++bit) {
    double flipped = 0.0;
    constexpr int kTrials = 400;
    for (uint64_t i = 0; i < kTrials; ++i) {
      const uint64_t value = HashKey({i});
      flipped += std::popcount(MixBits(value) ^ MixBits(value ^ (1ULL << bit)));
    }
    EXPECT_NEAR(flipped / kTrials, 32.0, 1.2) << "bit " << bit;
  }
}

TEST(RandomStream, UniformHasMeanVarianceAndRangeOfUniform) {
  RandomStream stream{7, 8};
  double sum = 0.0;
  double sum_squares = 0.0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double value = stream.Uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    sum_squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.5, 0.004);
  EXPECT_NEAR(sum_squares / kCount, 1.0 / 3.0, 0.004);
}

TEST(RandomStream, IntegerReachesBothEndsEqually) {
  RandomStream stream{3};
  std::vector<int> counts(4, 0);
  for (int i = 0; i < 40000; ++i) {
    ++counts.at(static_cast<size_t>(stream.Integer(-1, 2) + 1));
  }
  for (const int count : counts) {
    EXPECT_NEAR(count, 10000, 400);
  }
}

}  // namespace
}  // namespace pfseq
