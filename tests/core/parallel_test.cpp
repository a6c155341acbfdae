// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(ParallelFor, RunsEachIndexOnceForAnyNumberOfThreads) {
  for (const int num_threads : {1, 2, 7}) {
    std::vector<std::atomic<int>> counts(1000);
    ParallelFor(counts.size(), num_threads, [&](size_t i) { ++counts[i]; });
    for (const std::atomic<int>& count : counts) {
      ASSERT_EQ(count.load(), 1);
    }
  }
}

TEST(ParallelFor, RethrowsWhatABodyThrows) {
  for (const int num_threads : {1, 3}) {
    const auto fail_at_500 = [](size_t i) {
      if (i == 500) {
        throw std::runtime_error("at 500");
      }
    };
    EXPECT_THROW(ParallelFor(1000, num_threads, fail_at_500), std::runtime_error);
  }
}

TEST(ParallelFor, DoesNothingForNoWork) {
  ParallelFor(0, 2, [](size_t) { FAIL(); });
}

}  // namespace
}  // namespace pfseq
