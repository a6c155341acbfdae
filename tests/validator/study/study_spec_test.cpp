// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_spec.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"
#include "tests/validator/study/study_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

TEST(ReadStudy, TakesDefaultsAndLabels) {
  const TempFolder folder;
  const StudySpec study = StudyOf(folder, StudyText(kTwoFactors));
  EXPECT_EQ(study.name, "study");
  EXPECT_EQ(study.pairs, "0,2");
  EXPECT_EQ(study.design, StudyDesign::kOneAtATime);
  ASSERT_EQ(study.factors.size(), 2U);
  EXPECT_EQ(study.factors[0].title, "shutter.exposure_s");
  EXPECT_EQ(study.factors[0].base_idx, 1U);
  EXPECT_TRUE(study.factors[0].IsNumeric());
  EXPECT_EQ(study.factors[0].levels[2].number, 0.2);
  EXPECT_FALSE(study.factors[1].IsNumeric());
  EXPECT_EQ(study.repetitions.size(), 1U);
  EXPECT_EQ(study.grid.TripletNames().size(), 2U);
}

TEST(ReadStudy, ReadsTheStudiesThatShip) {
  const std::filesystem::path folder = std::filesystem::path(PFSEQ_SOURCE_DIR) / "data/studies";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const StudySpec study = ReadStudy(entry.path());
    EXPECT_GE(PlanVariants(study).size(), 3U) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(ReadStudy, TellsFaultsInOneLine) {
  const TempFolder folder;
  const auto fault = [&](const std::string& factors, const std::string& more = "") {
    return MessageOf<InputError>([&] { StudyOf(folder, StudyText(factors, more)); });
  };
  const std::string good = "  a: {key: image.size_px, values: [9, 10]}\n";
  EXPECT_THAT(fault("  a: {key: image.size_px, values: []}\n"),
              HasSubstr("study.yaml:5: factors.a.values: expected a list of values"));
  EXPECT_THAT(fault("  a: {key: image.size_px, values: [9]}\n"), HasSubstr("expected 2 to"));
  EXPECT_THAT(fault("  a: {key: image.size_px, values: [9, 10, 9]}\n"),
              HasSubstr("label '9' given twice"));
  EXPECT_THAT(fault("  a: {key: image.size_px, values: [9, 10], base: 7}\n"),
              HasSubstr("expected one of 9, 10, got 7"));
  EXPECT_THAT(fault("  a: {key: image.size_px}\n"), HasSubstr("either key and values, or levels"));
  EXPECT_THAT(fault("  a: {key: image.size_px, value: [9, 10]}\n"),
              HasSubstr("did you mean values"));
  EXPECT_THAT(fault(good + "  b: {key: image.size_px, values: [1, 2]}\n"),
              HasSubstr("sets image.size_px, as factor a does"));
  EXPECT_THAT(fault(""), HasSubstr("at least one factor"));
  EXPECT_THAT(fault(good, "repetitions: {render.seed: [1, 2], scene.canyon.seed: [3]}\n"),
              HasSubstr("expected 2 values as above, got 1"));
  EXPECT_THAT(fault(good, "tolerance_m: 0.033\n"), HasSubstr("tolerance_m: expected one of"));
  EXPECT_THAT(fault(good, "design: some\n"), HasSubstr("one at a time, all combinations"));
  EXPECT_THAT(fault(good, "compare: [[SIFT, ORB]]\n"), HasSubstr("has no setting 'SIFT'"));
  EXPECT_THAT(fault(good, "colour: red\n"), HasSubstr("colour"));
  EXPECT_THAT(MessageOf<InputError>([&] { StudyOf(folder, "factors: {}\n"); }), HasSubstr("base"));
}

}  // namespace
}  // namespace pfseq
