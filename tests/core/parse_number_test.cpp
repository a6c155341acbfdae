// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/parse_number.h"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(ParseNumber, ReadsWholeNumbersAndFractions) {
  EXPECT_EQ(ParseNumber<double>("-1.25e2"), -125.0);
  EXPECT_EQ(ParseNumber<double>("+0.1"), 0.1);
  EXPECT_EQ(ParseNumber<double>("7"), 7.0);
  EXPECT_EQ(ParseNumber<int>("-12"), -12);
  EXPECT_EQ(ParseNumber<uint64_t>("18446744073709551615"), UINT64_MAX);
}

TEST(ParseNumber, RefusesEverythingElse) {
  for (const std::string text :
       {"", "+", "-", "+-1", "++1", " 1", "1 ", "1,5", "1x", "inf", "nan", "1e999", "0x10"}) {
    EXPECT_EQ(ParseNumber<double>(text), std::nullopt) << '"' << text << '"';
  }
  EXPECT_EQ(ParseNumber<int>("1.0"), std::nullopt);
  EXPECT_EQ(ParseNumber<int>("2147483648"), std::nullopt);
  EXPECT_EQ(ParseNumber<uint64_t>("-1"), std::nullopt);
}

}  // namespace
}  // namespace pfseq
