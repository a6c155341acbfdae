// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/bytes.h"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(ByteReader, TakesWhatWasAppendedAndLeavesTheRest) {
  std::string bytes;
  AppendBytes(uint16_t{513}, bytes);
  AppendBytes(-0.25F, bytes);
  ASSERT_EQ(bytes.size(), sizeof(uint16_t) + sizeof(float));
  bytes += "rest";

  ByteReader reader(bytes);
  uint16_t whole = 0;
  float real = 0.0F;
  ASSERT_TRUE(reader.Take(whole));
  ASSERT_TRUE(reader.Take(real));
  EXPECT_EQ(whole, 513);
  EXPECT_EQ(real, -0.25F);
  EXPECT_EQ(reader.Rest(), "rest");
  EXPECT_FALSE(reader.IsAtEnd());
}

TEST(ByteReader, TakesNothingWhereTheRestIsTooShort) {
  ByteReader reader("abc");
  uint32_t value = 7;
  EXPECT_FALSE(reader.Take(value));
  EXPECT_EQ(value, 7U);
  EXPECT_EQ(reader.Rest(), "abc");
  uint8_t first = 0;
  EXPECT_TRUE(reader.Take(first));
  EXPECT_EQ(first, 'a');
}

}  // namespace
}  // namespace pfseq
