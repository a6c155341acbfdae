// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_report.h"

#include "tests/validator/report/report_fixture.h"
#include "tests/validator/study/study_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

const std::string kSetting = "SIFT nopol 0.04 5.0 1.6 SIFT BruteForce";

/// Scores of 0.3 and 0.5 on the pairs of the base, 0.1 less at the other level.
StudyReportOptions WriteStudyResults(const TempFolder& folder,
                                     const std::vector<StudyVariant>& variants) {
  StudyReportOptions options{{}, folder / "report", "pfseq study"};
  for (const StudyVariant& variant : variants) {
    const double less = 0.1 * static_cast<double>(variant.level_idx[0]);
    options.folders.push_back(folder / variant.name);
    WriteFakeResults(options.folders.back() / "bench",
                     {{kSetting, {0.3 - less, 0.5 - less}, {200, 100}}});
  }
  return options;
}

TEST(WriteStudyReport, TablesHoldMeansWithTheirIntervals) {
  const TempFolder folder;
  const StudySpec study = StudyOf(
      folder, StudyText("  fault: {key: shutter.exposure_s, title: Time (s), values: [0, 0.1]}\n"));
  const std::vector<StudyVariant> variants = PlanVariants(study);
  const ReportSummary summary =
      WriteStudyReport(study, variants, WriteStudyResults(folder, variants));
  // Two samples 0.2 apart: s / sqrt(2) = 0.1, t(1) = 12.706.
  EXPECT_EQ(
      ReadFile(folder / "report/tables/matching_score_over_fault.csv"),
      fmt::format("fault,{0},{0} low,{0} high\n0,0.400,-0.871,1.671\n0.1,0.300,-0.971,1.571\n",
                  kSetting));
  EXPECT_THAT(ReadFile(folder / "report/tables/matching_score_over_fault.tex"),
              HasSubstr("0 & \\textbf{0.400} {\\scriptsize$\\pm$1.271}"));
  EXPECT_THAT(
      ReadFile(folder / "report/tables/effects.csv"),
      HasSubstr(fmt::format(
          "fault,0.1,matching_score,{},0.04,2,0.3,-0.97062,1.57062,-0.1,-0.1,-0.0999999,0.2\n",
          kSetting)));
  EXPECT_THAT(ReadFile(folder / "report/figures/matching_score_over_fault.gp"),
              HasSubstr("(1 * $1):2:3:4 with yerrorlines"));
  EXPECT_THAT(ReadFile(summary.page), HasSubstr("Time (s)"));
  ASSERT_EQ(summary.remarks.size(), 2U);  // The sequences are not there.
  EXPECT_THAT(summary.remarks[0], HasSubstr("no picture"));
}

TEST(WriteStudyReport, WordsStandBesideEachOther) {
  const TempFolder folder;
  const StudySpec study = StudyOf(
      folder,
      StudyText("  fault:\n    levels: [{label: none}, {label: a blur, set: {render.seed: 2}}]\n"));
  const std::vector<StudyVariant> variants = PlanVariants(study);
  WriteStudyReport(study, variants, WriteStudyResults(folder, variants));
  const std::string script = ReadFile(folder / "report/figures/matching_score_over_fault.gp");
  EXPECT_THAT(script, HasSubstr("set xtics rotate by -30 (\"none\" 0, \"a blur\" 1)"));
  EXPECT_THAT(script, HasSubstr("($0 + 0.00):2:3:4 with yerrorbars"));
}

}  // namespace
}  // namespace pfseq
