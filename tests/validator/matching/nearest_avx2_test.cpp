// SPDX-License-Identifier: Apache-2.0
#include "tests/validator/matching/kernel_check.h"
#include "validator/matching/nearest.h"

namespace pfseq {
namespace {

TEST(Avx2Kernel, FindsTheNearestByTheDefinitions) {
  if (&BestKernel() == &kPlainKernel) {
    GTEST_SKIP() << "this processor has no such instructions";
  }
  EXPECT_EQ(kAvx2Kernel.num_lanes, 8);
  ExpectDefinitions(kAvx2Kernel);
}

}  // namespace
}  // namespace pfseq
