// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(DurationText, UsesTheUnitsOfAPerson) {
  EXPECT_EQ(DurationText(0.4), "0 s");
  EXPECT_EQ(DurationText(59.4), "59 s");
  EXPECT_EQ(DurationText(185.0), "3 min 05 s");
  EXPECT_EQ(DurationText(7620.0), "2 h 07 min");
}

TEST(Progress, TellsWhetherTheWorkWasDoneOrStopped) {
  testing::internal::CaptureStderr();
  {
    Progress progress("render", 2, false);
    progress.Advance(2);
  }
  {
    Progress progress("match", 2, false);
    progress.Advance();
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_THAT(text, testing::HasSubstr("render: done in 0 s"));
  EXPECT_THAT(text, testing::HasSubstr("match: stopped in 0 s"));
}

TEST(Progress, QuietPrintsNothing) {
  testing::internal::CaptureStderr();
  {
    Progress progress("render", 1, true);
    progress.Advance();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace pfseq
