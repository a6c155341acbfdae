// SPDX-License-Identifier: Apache-2.0
#include "validator/report/result_set.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/report/report_fixture.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

const FakeSetting kFirst = {
    "SIFT nopol 0.04 5.0 1.6 FREAK 44.0 BruteForce", {0.5, 0.4}, {500, 400}};
const FakeSetting kSecond = {"ORB pol 500 ORB 2 RatioTest ratio=0.7", {0.3, 0.2}, {300, 200}};
const FakeSetting kDetector = {"CenSurE pol 16 10 7", {0.6, 0.7}, {600, 700}, false};

TEST(ResultSet, HasEachValueAtItsSettingPairAndTolerance) {
  const TempFolder folder;
  WriteFakeResults(folder.Path(), {kFirst, kSecond, kDetector});
  const ResultSet results = ReadResults({folder.Path()});
  ASSERT_EQ(results.cases.size(), 2u);
  EXPECT_EQ(results.cases[1].label, "pair 40");
  const size_t second = results.triplets.Find(kSecond.name).value();
  EXPECT_NEAR(results.triplets.Value("matching_score", second, 1, 4), 0.2, 1e-6);
  EXPECT_NEAR(results.triplets.Value("matching_score", second, 1, 5), 0.2001, 1e-6);
  EXPECT_EQ(results.triplets.Value("correct_matches", second, 0, 11), 300);
  EXPECT_EQ(results.triplets.Value("attempted", second, 0, 7), 1000);
  EXPECT_NEAR(results.detectors.Value("repeatability", 0, 1, 4), 0.7, 1e-6);
  EXPECT_TRUE(std::isnan(results.detectors.Value("matching_score", 0, 1, 4)));
}

TEST(ResultSet, ReadsAlgorithmsFromNames) {
  const TempFolder folder;
  WriteFakeResults(folder.Path(), {kFirst, kSecond, kDetector});
  const ResultSet results = ReadResults({folder.Path()});
  EXPECT_EQ(results.triplets.settings[0].detector, "SIFT");
  EXPECT_EQ(results.triplets.settings[0].descriptor, "FREAK");
  EXPECT_EQ(results.triplets.settings[0].matcher, "BruteForce");
  EXPECT_FALSE(results.triplets.settings[0].is_polar);
  EXPECT_EQ(results.triplets.settings[1].matcher, "RatioTest");
  EXPECT_TRUE(results.triplets.settings[1].is_polar);
  EXPECT_EQ(results.detectors.settings[0].detector, "CenSurE");
}

TEST(ResultSet, PutsSeveralBenchmarksSideBySide) {
  const TempFolder folder;
  WriteFakeResults(folder / "clear", {kFirst});
  WriteFakeResults(folder / "dusk", {kSecond});
  const ResultSet results = ReadResults({folder / "clear", folder / "dusk"});
  ASSERT_EQ(results.cases.size(), 4u);
  EXPECT_EQ(results.cases[2].label, "dusk: pair 0");
  EXPECT_TRUE(std::isnan(results.triplets.Value("matching_score", 0, 2, 4)));
  EXPECT_NEAR(results.triplets.Value("matching_score", 1, 2, 4), 0.3, 1e-6);
}

TEST(ResultSet, TimesOfAFamilyCountForAllOfItsSettings) {
  const TempFolder folder;
  const FakeSetting sibling = {
      "SIFT nopol 0.08 20.0 1.6 FREAK 44.0 BruteForce", {0.1, 0.1}, {1, 1}};
  WriteFakeResults(folder.Path(), {kFirst, sibling, kSecond});
  WriteFileAtomically(folder / "times.csv",
                      "lens,pair,unit,stage,cpu_s\n"
                      "equisolid,40,SIFT nopol 0.04 5.0 1.6 and 1 more,detect,1\n"
                      "equisolid,40,SIFT nopol 0.04 5.0 1.6 and 1 more,describe FREAK 44.0,2\n"
                      "equisolid,40,SIFT nopol 0.04 5.0 1.6 and 1 more,match FREAK 44.0,4\n"
                      "equisolid,40,SIFT nopol 0.04 5.0 1.6 and 1 more,judge,8\n");
  const ResultSet results = ReadResults({folder.Path()});
  EXPECT_EQ(results.triplets.Value("cpu_s", 0, 1, 0), 7);
  EXPECT_EQ(results.triplets.Value("cpu_s", 1, 1, 0), 7);
  EXPECT_TRUE(std::isnan(results.triplets.Value("cpu_s", 0, 0, 0)));
  EXPECT_TRUE(std::isnan(results.triplets.Value("cpu_s", 2, 1, 0)));
}

TEST(ResultSet, DamagedResultsAreRefusedWithTheFilesName) {
  const TempFolder folder;
  EXPECT_THAT(MessageOf<InputError>([&] { ReadResults({folder / "nothing"}); }),
              HasSubstr("nothing/results.json"));
  WriteFileAtomically(folder / "a" / "results.json", "{\"format\": ");
  EXPECT_THAT(MessageOf<InputError>([&] { ReadResults({folder / "a"}); }),
              HasSubstr("a/results.json"));
  WriteFileAtomically(folder / "b" / "results.json", "{\"format\": \"other\"}");
  EXPECT_THAT(MessageOf<InputError>([&] { ReadResults({folder / "b"}); }),
              HasSubstr("got 'other'"));
  WriteFakeResults(folder / "c", {kFirst}, "clean", [](nlohmann::json& json) {
    json["settings"][0]["pair"] = 9;
  });
  EXPECT_THAT(MessageOf<InputError>([&] { ReadResults({folder / "c"}); }), HasSubstr("pair 9"));
  WriteFakeResults(folder / "d", {kFirst}, "clean", [](nlohmann::json& json) {
    json["settings"][0]["matching_score"] = {0.5, "x"};
  });
  EXPECT_THAT(MessageOf<InputError>([&] { ReadResults({folder / "d"}); }),
              HasSubstr("d/results.json"));
  WriteFakeResults(folder / "e", {kFirst}, "clean", [](nlohmann::json& json) {
    json["tolerances_m"][0] = 0.25;
  });
  WriteFakeResults(folder / "f", {kFirst});
  EXPECT_THAT(MessageOf<InputError>([&] {
                ReadResults({folder / "f", folder / "e"});
              }),
              HasSubstr("tolerances_m"));
}

TEST(SequenceCredits, StandAtTheEndOfTheDescription) {
  const TempFolder folder;
  WriteFileAtomically(folder / "with/sequence.yaml", "# first\nname: a\n# Photographs: somebody\n");
  WriteFileAtomically(folder / "without/sequence.yaml", "# first\nname: a\n");
  EXPECT_EQ(SequenceCredits(folder / "with"), "Photographs: somebody");
  EXPECT_EQ(SequenceCredits(folder / "without"), "");
  EXPECT_EQ(SequenceCredits(folder / "missing"), "");
}

}  // namespace
}  // namespace pfseq
