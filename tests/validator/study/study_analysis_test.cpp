// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_analysis.h"

#include "tests/validator/report/report_fixture.h"
#include "tests/validator/study/study_fixture.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kSift = "SIFT nopol 0.04 5.0 1.6 SIFT BruteForce";
const std::string kFreak = "SIFT nopol 0.04 5.0 1.6 FREAK 44.0 BruteForce";

/// A study of exposures 0, 0.1 (the base) and 0.2 in two repetitions, and its results by hand:
/// SIFT falls with the exposure, FREAK does not; pair 40 is easier than 0, and there is some
/// scatter.
struct FakeStudy {
  TempFolder folder;
  StudySpec study;
  std::vector<StudyVariant> variants;
  ResultSet results;

  explicit FakeStudy(
      const std::string& factor =
          "  exposure: {key: shutter.exposure_s, values: [0, 0.1, 0.2], base: 0.1}\n",
      const std::string& more = "repetitions: {scene.canyon.seed: [4, 5]}\n")
      : study(StudyOf(folder, StudyText(factor, more))), variants(PlanVariants(study)) {
    std::vector<std::filesystem::path> folders;
    for (const StudyVariant& variant : variants) {
      const double exposure_s = variant.spec.shutter.exposure_s;
      const double scatter = variant.repetition_idx == 0 ? 0.0 : 0.01 * exposure_s;
      const double sift = 0.5 - 2.0 * exposure_s + scatter;
      folders.push_back(folder / variant.name);
      WriteFakeResults(folders.back(),
                       {{kSift, {sift, sift + 0.2 + 0.1 * scatter}, {200, 200}},
                        {kFreak, {0.25, 0.45}, {200, 200}}});
    }
    results = ReadResults(folders);
  }
};

TEST(TableOfFactor, HasEachSampleAtEveryLevel) {
  const FakeStudy fake;
  const FactorTable table = TableOfFactor(fake.study, fake.variants, fake.results, 0);
  ASSERT_EQ(table.NumSamples(), 4U);
  for (size_t level = 0; level < 3; ++level) {
    for (size_t sample = 0; sample < 4; ++sample) {
      const ReportCase& one = fake.results.cases[table.cases[level][sample]];
      const ReportCase& at_base = fake.results.cases[table.cases[1][sample]];
      EXPECT_EQ(fake.variants[one.source_idx].level_idx[0], level);
      EXPECT_EQ(one.pair, at_base.pair);
      EXPECT_EQ(fake.variants[one.source_idx].repetition_idx,
                fake.variants[at_base.source_idx].repetition_idx);
    }
  }
}

TEST(TableOfFactor, OneAtATimeHasTheOthersAtTheirBase) {
  const FakeStudy fake(kTwoFactors, "");
  EXPECT_EQ(TableOfFactor(fake.study, fake.variants, fake.results, 0).NumSamples(), 2U);
  EXPECT_EQ(TableOfFactor(fake.study, fake.variants, fake.results, 1).NumSamples(), 2U);
  const FakeStudy crossed(kTwoFactors, "design: all combinations\n");
  EXPECT_EQ(TableOfFactor(crossed.study, crossed.variants, crossed.results, 0).NumSamples(), 4U);
  EXPECT_EQ(TableOfFactor(crossed.study, crossed.variants, crossed.results, 1).NumSamples(), 6U);
}

TEST(EffectOf, IsPairedBySamples) {
  const FakeStudy fake;
  const FactorTable table = TableOfFactor(fake.study, fake.variants, fake.results, 0);
  const size_t tolerance = *fake.results.ToleranceIdx(0.04);
  const size_t sift = *fake.results.triplets.Find(kSift);
  const Effect effect =
      EffectOf(ValuesOf(table, fake.results.triplets, "matching_score", sift, tolerance), 1);
  EXPECT_NEAR(effect.levels[0].mean, 0.6, 1e-6);
  EXPECT_NEAR(effect.changes[0].mean, 0.2, 1e-3);
  EXPECT_EQ(effect.changes[1].mean, 0.0);
  EXPECT_NEAR(effect.changes[2].mean, -0.2, 1e-3);
  // Pairs differ by 0.2, but alike at all levels: the paired interval is far narrower.
  EXPECT_GT(effect.levels[0].high - effect.levels[0].low, 0.1);
  EXPECT_LT(effect.changes[0].high - effect.changes[0].low, 0.01);
  EXPECT_NEAR(effect.Range(), 0.4, 2e-3);
  EXPECT_GT(effect.shares.levels, 0.6);
}

TEST(CompareSettings, TellsWhoOvertakesWhere) {
  const FakeStudy fake;
  const FactorTable table = TableOfFactor(fake.study, fake.variants, fake.results, 0);
  const std::vector<Comparison> comparisons =
      CompareSettings(fake.study, fake.study.factors[0], table, fake.results);
  ASSERT_EQ(comparisons.size(), 1U);
  EXPECT_NEAR(comparisons[0].differences[0].mean, 0.25, 1e-3);
  EXPECT_THAT(comparisons[0].text,
              testing::AllOf(StartsWith("SIFT falls behind FREAK 44.0 (SIFT nopol 0.04 5.0 1.6 "
                                        "points, BruteForce): ahead at 0, 0.1 (+5.1 ["),
                             HasSubstr("at 0.1), behind at 0.2 (\u221214.9 ["),
                             HasSubstr("cross at about 0.13.")));
}

TEST(CompareSettings, TakesTheStudysPairsInTheirOrder) {
  const FakeStudy fake(
      "  exposure: {key: shutter.exposure_s, values: [0, 0.1, 0.2]}\n",
      "repetitions: {scene.canyon.seed: [4, 5]}\ncompare: [[" + kFreak + ", " + kSift + "]]\n");
  const FactorTable table = TableOfFactor(fake.study, fake.variants, fake.results, 0);
  const std::vector<Comparison> comparisons =
      CompareSettings(fake.study, fake.study.factors[0], table, fake.results);
  ASSERT_EQ(comparisons.size(), 1U);
  EXPECT_THAT(comparisons[0].text, StartsWith("FREAK 44.0 overtakes SIFT"));
}

TEST(ComparisonText, SaysNothingWhereIntervalsHold0) {
  const FakeStudy fake;
  const ShortNames names = {"A", "B", ""};
  const Interval open = {3, 0.01, -0.01, 0.03}, ahead = {3, 0.02, 0.01, 0.03};
  const StudyFactor& factor = fake.study.factors[0];
  EXPECT_EQ(ComparisonText(factor, names, {open, open, open}),
            "A and B: no difference can be told at any level.");
  EXPECT_EQ(ComparisonText(factor, names, {open, ahead, ahead}),
            "A is ahead of B at 0.1, 0.2 (+2.0 [+1.0 to +3.0] at 0.2); at 0 no difference can be "
            "told.");
  EXPECT_EQ(
      ComparisonText(factor, names, {ahead, ahead, ahead}),
      "A is ahead of B at every level (+2.0 [+1.0 to +3.0] at 0, +2.0 [+1.0 to +3.0] at 0.2).");
}

TEST(EffectText, NamesTheGreatestChange) {
  const FakeStudy fake;
  const FactorTable table = TableOfFactor(fake.study, fake.variants, fake.results, 0);
  const Effect effect = EffectOf(
      ValuesOf(
          table, fake.results.triplets, "matching_score", *fake.results.triplets.Find(kSift), 4),
      1);
  EXPECT_THAT(
      EffectText(fake.study.factors[0], effect, "matching score"),
      StartsWith(
          "shutter.exposure_s: the matching score changes most from 0.1 to 0.2, by \u221219.9 ["));
}

TEST(MeanValuesOf, LeavesOutSettingsWithoutAValue) {
  const FakeStudy fake;
  ResultSet results = fake.results;
  const FactorTable table = TableOfFactor(fake.study, fake.variants, results, 0);
  MetricTable& scores = results.triplets.metrics.find("matching_score")->second;
  // SIFT at the last level's first sample.
  const size_t sift = *results.triplets.Find(kSift);
  scores.values[(sift * results.cases.size() + table.cases[2][0]) * scores.num_values + 4] =
      std::nanf("");
  const std::vector<std::vector<double>> means =
      MeanValuesOf(table, results.triplets, "matching_score", 4);
  EXPECT_THAT(means[0][0], testing::DoubleNear(0.25, 0.21));
  EXPECT_EQ(means[0][0], means[2][0]);  // FREAK alone at all levels of that sample.
  EXPECT_NE(means[0][1], means[2][1]);
}

}  // namespace
}  // namespace pfseq
