// SPDX-License-Identifier: Apache-2.0
#include "tests/validator/matching/kernel_check.h"

namespace pfseq {
namespace {

TEST(PlainKernel, FindsTheNearestByTheDefinitions) {
  EXPECT_EQ(kPlainKernel.num_lanes, 1);
  ExpectDefinitions(kPlainKernel);
}

}  // namespace
}  // namespace pfseq
