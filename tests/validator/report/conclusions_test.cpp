// SPDX-License-Identifier: Apache-2.0
#include "validator/report/conclusions.h"

#include "tests/support/temp_folder.h"
#include "tests/validator/report/report_fixture.h"
#include "validator/report/ranking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

const char* const kGeneral = "SIFT nopol 0.02 20.0 1.6 SIFT BruteForce";
const char* const kEasy = "SIFT nopol 0.04 5.0 1.6 SIFT BruteForce";
const char* const kFreak = "SIFT nopol 0.04 5.0 1.6 FREAK 44.0 BruteForce";

/// What the report found, in short.
std::vector<FakeSetting> AsIn2014() {
  return {{kGeneral, {0.36, 0.38, 0.17}, {9000, 9000, 2000}},
          {kEasy, {0.51, 0.51, 0.25}, {900, 900, 90}},
          {kFreak, {0.46, 0.50, 0.31}, {800, 800, 100}},
          {"SIFT nopol 0.04 5.0 1.6 SIFT RatioTest", {0.2, 0.2, 0.1}, {300, 300, 100}},
          {"SIFT pol 0.02 20.0 3.0 SIFT BruteForce", {0.3, 0.3, 0.2}, {900, 900, 900}},
          {"CenSurE nopol 16 10 7 ORB 2 BruteForce", {0.4, 0.3, 0.9}, {300, 300, 20}},
          {"BRISK nopol 30 1.0 BRISK 1.0 BruteForce", {0.1, 0.1, 0.1}, {300, 300, 300}}};
}

std::vector<Conclusion> Judged(const std::vector<FakeSetting>& settings,
                               const std::string& variant = "realistic") {
  const TempFolder folder;
  WriteFakeResults(folder.Path(), settings, variant);
  return JudgeConclusions(ReadResults({folder.Path()}), Reference2014());
}

std::vector<Judgement> Judgements(const std::vector<FakeSetting>& settings) {
  std::vector<Judgement> judgements;
  for (const Conclusion& conclusion : Judged(settings)) {
    judgements.push_back(conclusion.judgement);
  }
  return judgements;
}

TEST(Conclusions, AllHoldOnWhatTheReportFound) {
  EXPECT_THAT(Judgements(AsIn2014()), testing::Each(Judgement::kHolds));
}

TEST(Conclusions, EachFailsOnItsOpposite) {
  struct Opposite {
    const char* claim;
    std::function<void(std::vector<FakeSetting>&)> change;
    Judgement judgement;
  };
  const Opposite opposites[] = {
      {"SIFT is the best",
       [](auto& all) {
         all[6].shares = {0.9, 0.9, 0.9};
       },
       Judgement::kFails},
      {"CenSurE is out", [](auto& all) { all[5].counts[2] = 100; }, Judgement::kFails},
      {"Polar rectification",
       [](auto& all) {
         all[4].shares = {0.6, 0.6, 0.0};
       },
       Judgement::kFails},
      {"Polar rectification", [](auto& all) { all[4].shares[0] = 0.6; }, Judgement::kPartly},
      {"Corners",
       [](auto& all) {
         all[6].shares = {0.9, 0.9, 0.9};
       },
       Judgement::kFails},
      {"Brute force",
       [](auto& all) {
         all[3].shares = {0.9, 0.9, 0.9};
       },
       Judgement::kFails},
      {"FREAK", [](auto& all) { all[2].shares[2] = 0.24; }, Judgement::kFails},
      {"SIFT 0.02 20 1.6",
       [](auto& all) {
         all[0].shares = {0.29, 0.29, 0.21};
       },
       Judgement::kFails},
      {"SIFT 0.04 5 1.6", [](auto& all) { all[1].shares[0] = 0.44; }, Judgement::kPartly}};
  for (const Opposite& opposite : opposites) {
    std::vector<FakeSetting> settings = AsIn2014();
    opposite.change(settings);
    size_t num_found = 0;
    for (const Conclusion& conclusion : Judged(settings)) {
      if (conclusion.claim.starts_with(opposite.claim)) {
        ++num_found;
        EXPECT_EQ(conclusion.judgement, opposite.judgement)
            << conclusion.claim << ": " << conclusion.ours;
      }
    }
    EXPECT_EQ(num_found, 1u) << opposite.claim;
  }
}

TEST(Conclusions, CannotBeSaidWhereThereIsNothingToGoBy) {
  EXPECT_THAT(Judgements({{"AKAZE nopol 0.001 AKAZE BruteForce", {0.5}, {500}}}),
              testing::Each(Judgement::kUnknown));
  for (const Conclusion& conclusion : Judged(AsIn2014(), "clean")) {
    EXPECT_EQ(conclusion.judgement == Judgement::kUnknown, conclusion.claim.starts_with("FREAK"))
        << conclusion.claim;
  }
}

TEST(Conclusions, TheirFiguresAreThoseOfTheReport) {
  const Reference2014 reference;
  EXPECT_EQ(reference.Find({"matching_score", "0", kEasy}, 0.04), 0.51);
  EXPECT_EQ(reference.Find({"matching_score", "24", kFreak}, 0.15), 0.47);
  EXPECT_EQ(reference.Find({"matches", "0", "SIFT nopol 0.02 20.0 1.0"}, 0.01), 3559);
  EXPECT_EQ(reference.Find({"matches", "0", "SIFT nopol 0.02 20.0 9.0"}, 0.01), std::nullopt);
  // -1 in the report.
  EXPECT_EQ(reference.Find({"repeatability", "24", "CenSurE nopol 16 10 7"}, 0.04), std::nullopt);
}

TEST(Verdict, GoesToTheHighestMeanOfThoseWithEnoughMatches) {
  const TempFolder folder;
  WriteFakeResults(folder.Path(), AsIn2014());
  const ResultSet results = ReadResults({folder.Path()});
  const std::vector<VerdictLine> verdict = Verdict(results);
  ASSERT_EQ(verdict.size(), 4u);
  EXPECT_EQ(verdict[0].label, "over all");
  // The easy setting has too few on pair 24, CenSurE as well.
  EXPECT_EQ(results.triplets.settings[verdict[0].entries[1].best->setting_idx].name, kFreak);
  EXPECT_NEAR(verdict[0].entries[1].best->value, (0.46 + 0.50 + 0.31) / 3, 1e-6);
  EXPECT_EQ(results.triplets.settings[verdict[1].entries[1].best->setting_idx].name, kEasy);
  EXPECT_FALSE(verdict[0].entries[0].best.has_value());  // No detectors.
}

TEST(Verdict, TellsWhenNoneHasEnoughMatches) {
  const TempFolder folder;
  WriteFakeResults(folder.Path(),
                   {{kGeneral, {0.2}, {99}}, {kEasy, {0.3}, {10}}, {kFreak, {0.9}, {9}}});
  const ResultSet results = ReadResults({folder.Path()});
  const VerdictEntry entry = Verdict(results).at(0).entries.at(1);
  EXPECT_FALSE(entry.has_enough);
  EXPECT_EQ(results.triplets.settings[entry.best->setting_idx].name, kEasy);
  EXPECT_EQ(entry.best->count, 10);
}

}  // namespace
}  // namespace pfseq
