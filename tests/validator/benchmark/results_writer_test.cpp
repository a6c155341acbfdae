// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/results_writer.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "tests/support/temp_folder.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

using testing::ElementsAre;

/// A detector on one pair, and a triplet that found nothing on another, at 12 distances and an
/// angle.
BenchmarkResults SomeResults() {
  BenchmarkResults results;
  results.sequence = "street";
  results.variant = "clean";
  results.judge = Judge::kMap;
  results.seed = 18446744073709551615U;
  results.tolerances.angles_rad = {RadFromDeg(0.05)};
  results.pairs = {{"wide", {"left", 3}, {"right", 3}, "3"},
                   {"narrow", {"left", 0}, {"left", 5}, "left:0-left:5"}};
  Metric share = {"repeatability", {}, {}, {}};
  for (int i = 0; i < 13; ++i) {
    share.values.push_back(i / 16.0);
    share.low.push_back(i / 32.0);
    share.high.push_back(i / 8.0);
  }
  share.low[2] = std::nan("");
  const std::vector<double> none(13, std::nan(""));
  results.settings = {
      {"SIFT nopol 0.02", 1, false, {{"detections_first", {90000}, {}, {}}, share}},
      {"Net \"a\", b", 0, true, {{"attempted", {0}, {}, {}}, {"precision", none, {}, {}}}}};
  results.times = {{1, "SIFT 1, 2", "describe FREAK 22.0", 1.25}, {0, "Net", "judge", 0.0004}};
  return results;
}

class ResultsWriter : public testing::Test {
 protected:
  std::vector<std::string> Lines(const char* file) const {
    std::istringstream text(ReadFile(folder_ / file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) {
      lines.push_back(line);
    }
    return lines;
  }
  nlohmann::json Json(const char* file) const {
    return nlohmann::json::parse(ReadFile(folder_ / file));
  }

  TempFolder folder_;
};

TEST_F(ResultsWriter, ResultsHaveARowForEachValue) {
  BenchmarkResults results = SomeResults();
  results.settings.pop_back();
  WriteResults(results, folder_.Path());
  const std::string share = "narrow,left:0-left:5,repeatability,SIFT nopol 0.02,";
  EXPECT_THAT(Lines("results.csv"),
              ElementsAre("lens,pair,metric,setup,tolerance_m,value,low,high,tolerance_deg",
                          "narrow,left:0-left:5,detections_first,SIFT nopol 0.02,,90000,,,",
                          share + "0.005,0,0,0,",
                          share + "0.01,0.062500,0.031250,0.125000,",
                          share + "0.02,0.125000,,0.250000,",
                          share + "0.03,0.187500,0.093750,0.375000,",
                          share + "0.04,0.250000,0.125000,0.500000,",
                          share + "0.05,0.312500,0.156250,0.625000,",
                          share + "0.06,0.375000,0.187500,0.750000,",
                          share + "0.07,0.437500,0.218750,0.875000,",
                          share + "0.08,0.500000,0.250000,1,",
                          share + "0.09,0.562500,0.281250,1.125000,",
                          share + "0.1,0.625000,0.312500,1.250000,",
                          share + "0.15,0.687500,0.343750,1.375000,",
                          share + ",0.750000,0.375000,1.500000,0.05"));
}

TEST_F(ResultsWriter, WhatHasNoValueIsEmptyAndNamesWithCommasAreQuoted) {
  BenchmarkResults results = SomeResults();
  results.settings.erase(results.settings.begin());
  results.settings[0].setup = "a, b";
  WriteResults(results, folder_.Path());
  const std::vector<std::string> lines = Lines("results.csv");
  ASSERT_EQ(lines.size(), 15U);
  EXPECT_EQ(lines[1], "wide,3,attempted,\"a, b\",,0,,,");
  EXPECT_EQ(lines[2], "wide,3,precision,\"a, b\",0.005,,,,");
  EXPECT_EQ(lines[14], "wide,3,precision,\"a, b\",,,,,0.05");
}

TEST_F(ResultsWriter, JsonSaysWhatWasMeasuredAndHow) {
  WriteResults(SomeResults(), folder_.Path());
  const nlohmann::json json = Json("results.json");
  EXPECT_EQ(json["format"], "pfseq benchmark 2");
  EXPECT_FALSE(json["program_version"].get<std::string>().empty());
  EXPECT_EQ(json["sequence"], "street");
  EXPECT_EQ(json["variant"], "clean");
  EXPECT_EQ(json["judge"], "map");
  EXPECT_EQ(json["seed"], 18446744073709551615U);
  EXPECT_EQ(json["tolerances_m"].size(), 12U);
  EXPECT_EQ(json["tolerances_deg"], nlohmann::json({0.05}));
  ASSERT_EQ(json["pairs"].size(), 2U);
  const nlohmann::json expected = {{"lens", "narrow"},
                                   {"pair", "left:0-left:5"},
                                   {"first", {{"camera", "left"}, {"frame", 0}}},
                                   {"second", {{"camera", "left"}, {"frame", 5}}}};
  EXPECT_EQ(json["pairs"][1], expected);
  BenchmarkResults by_rays = SomeResults();
  by_rays.judge = Judge::kRay;
  WriteResults(by_rays, folder_.Path());
  EXPECT_EQ(Json("results.json")["judge"], "ray");
}

TEST_F(ResultsWriter, JsonHasTheMetricsOfTheTables) {
  WriteResults(SomeResults(), folder_.Path());
  const nlohmann::json settings = Json("results.json")["settings"];
  ASSERT_EQ(settings.size(), 2U);
  EXPECT_EQ(settings[0]["setup"], "SIFT nopol 0.02");
  EXPECT_EQ(settings[0]["pair"], 1);
  EXPECT_EQ(settings[0]["degenerate"], false);
  EXPECT_EQ(settings[0]["detections_first"], nlohmann::json({90000}));
  EXPECT_FALSE(settings[0].contains("detections_first_low"));
  EXPECT_EQ(settings[0]["repeatability"][12], 0.75);
  EXPECT_TRUE(settings[0]["repeatability_low"][2].is_null());
  EXPECT_EQ(settings[0]["repeatability_low"][3], 0.09375);
  EXPECT_EQ(settings[0]["repeatability_high"][3], 0.375);
  EXPECT_EQ(settings[1]["setup"], "Net \"a\", b");
  EXPECT_EQ(settings[1]["pair"], 0);
  EXPECT_EQ(settings[1]["degenerate"], true);
  EXPECT_EQ(settings[1]["precision"], nlohmann::json(std::vector<std::nullptr_t>(13)));
}

TEST_F(ResultsWriter, NothingMeasuredIsAnEmptyList) {
  WriteResults({}, folder_.Path());
  EXPECT_EQ(Lines("results.csv").size(), 1U);
  EXPECT_EQ(Json("results.json")["settings"], nlohmann::json::array());
}

TEST_F(ResultsWriter, TimesHaveARowForEachStage) {
  WriteResults(SomeResults(), folder_.Path());
  EXPECT_THAT(Lines("times.csv"),
              ElementsAre("lens,pair,unit,stage,cpu_s",
                          "narrow,left:0-left:5,\"SIFT 1, 2\",describe FREAK 22.0,1.2500",
                          "wide,3,Net,judge,0.0004"));
}

TEST_F(ResultsWriter, FoldersAreMadeAndEarlierFilesReplaced) {
  const std::filesystem::path folder = folder_ / "a" / "b";
  WriteResults(SomeResults(), folder);
  WriteResults({}, folder);
  EXPECT_EQ(ReadFile(folder / "times.csv"), "lens,pair,unit,stage,cpu_s\n");
  WriteFileAtomically(folder_ / "file", std::string_view(""));
  EXPECT_THROW(WriteResults({}, folder_ / "file"), SystemError);
}

TEST_F(ResultsWriter, RunsNameTheirSequenceAsSeenFromTheirFolder) {
  WriteRun({"pfseq benchmark --seed 1", folder_ / "sequences" / "street", 12.5},
           folder_ / "runs" / "first");
  const nlohmann::json run =
      nlohmann::json::parse(ReadFile(folder_ / "runs" / "first" / "run.json"));
  EXPECT_EQ(run["command"], "pfseq benchmark --seed 1");
  EXPECT_EQ(run["sequence"], "../../sequences/street");
  EXPECT_EQ(run["wall_s"], 12.5);
}

TEST_F(ResultsWriter, RunsAreFinishedNowInUtc) {
  // Half a day off UTC.
  const char* zone = std::getenv("TZ");
  const std::string before_zone = zone != nullptr ? zone : "";
  setenv("TZ", "AAA-12", 1);
  tzset();
  const std::time_t before = std::time(nullptr);
  WriteRun({"", folder_.Path(), 0.0}, folder_.Path());
  const std::time_t after = std::time(nullptr);
  zone != nullptr ? setenv("TZ", before_zone.c_str(), 1) : unsetenv("TZ");
  tzset();
  const auto finished = Json("run.json")["finished"].get<std::string>();
  std::tm utc = {};
  const char* end = strptime(finished.c_str(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  ASSERT_TRUE(end != nullptr && *end == '\0') << finished;
  EXPECT_GE(timegm(&utc), before);
  EXPECT_LE(timegm(&utc), after);
}

}  // namespace
}  // namespace pfseq
