// SPDX-License-Identifier: Apache-2.0
#include "tests/validator/matching/kernel_check.h"
#include "validator/matching/nearest.h"

namespace pfseq {
namespace {

TEST(Avx512Kernel, FindsTheNearestByTheDefinitions) {
  if (&BestKernel() != &kAvx512Kernel) {
    GTEST_SKIP() << "this processor has no such instructions";
  }
  EXPECT_EQ(kAvx512Kernel.num_lanes, 16);
  ExpectDefinitions(kAvx512Kernel);
}

}  // namespace
}  // namespace pfseq
