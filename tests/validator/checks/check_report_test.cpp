// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/check_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

TEST(CheckReport, NotesAreNoFaults) {
  CheckReport report;
  report.AddNote("a.txt", "odd");
  EXPECT_EQ(report.NumFaults(), 0U);
  EXPECT_THAT(report.Text(), HasSubstr("sound"));
  report.AddFault("b.txt", "wrong");
  EXPECT_EQ(report.NumFaults(), 1U);
  EXPECT_THAT(report.Text(), HasSubstr("1 fault found"));
}

TEST(CheckReport, TellsFaultsBeforeNotesWithTheirFiles) {
  CheckReport report;
  report.AddNote("a.txt", "odd");
  report.AddFault("b.txt", "wrong");
  EXPECT_THAT(report.Text(), testing::StartsWith("fault: b.txt: wrong\nnote: a.txt: odd\n"));
}

TEST(CheckReport, TellsHowCamerasAgree) {
  CheckReport report;
  PairAgreement total;
  total.lens = "equisolid";
  total.from_camera = "front";
  total.to_camera = "rear";
  total.num_sampled = 200;
  total.num_agreeing = 75;
  total.num_disagreeing = 25;
  total.num_occluded = 50;
  report.pair_totals.push_back(total);
  EXPECT_DOUBLE_EQ(total.AgreeingShare(), 0.75);
  const std::string text = report.Text();
  EXPECT_THAT(text, HasSubstr("front > rear"));
  EXPECT_THAT(text, HasSubstr("75.0000"));
  EXPECT_THAT(text, HasSubstr("25.0 %"));
}

TEST(CheckReport, NothingComparedIsNoDisagreement) {
  EXPECT_EQ(PairAgreement().AgreeingShare(), 1.0);
}

TEST(CheckReport, LeavesThePathOutOfAnErrorsText) {
  EXPECT_EQ(WithoutPath("x/a.png: damaged", "x/a.png"), "damaged");
  EXPECT_EQ(WithoutPath("x/a.csv:7: expected", "x/a.csv"), "line 7: expected");
  EXPECT_EQ(WithoutPath("something else", "x/a.csv"), "something else");
}

}  // namespace
}  // namespace pfseq
