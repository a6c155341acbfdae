// SPDX-License-Identifier: Apache-2.0
#include "validator/grid/grid.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Grid Shipped(const char* name) {
  return Grid::Read(std::string(PFSEQ_SOURCE_DIR) + "/data/grids/" + name);
}

Grid FromText(const std::string& text) { return Grid::FromYaml(text, "grid.yaml", "/"); }

/// Setups of the report's tables: detectors (measured by repeatability) and triplets.
std::map<std::string, std::set<std::string>> SetupsOfReport() {
  std::map<std::string, std::set<std::string>> setups;
  std::istringstream rows(
      ReadFile(std::string(PFSEQ_SOURCE_DIR) + "/data/reference/pfseq_2014_features.csv"));
  std::string line;
  std::getline(rows, line);
  while (std::getline(rows, line)) {
    std::istringstream row(line);
    std::string pair, metric, setup;
    std::getline(row, pair, ',');
    std::getline(row, metric, ',');
    std::getline(row, setup, ',');
    const bool is_detector = metric == "matches" || metric == "repeatability";
    setups[is_detector ? "detectors" : "triplets"].insert(setup);
  }
  return setups;
}

TEST(Grid, PaperHas112DetectorsAnd2096Triplets) {
  const Grid grid = Shipped("paper.yaml");
  const std::vector<std::string> detectors = grid.DetectorNames();
  const std::vector<std::string> triplets = grid.TripletNames();
  EXPECT_EQ(std::set(detectors.begin(), detectors.end()).size(), 112U);
  EXPECT_EQ(std::set(triplets.begin(), triplets.end()).size(), 2096U);
  EXPECT_EQ(detectors.size(), 112U);
  EXPECT_EQ(triplets.size(), 2096U);
  std::map<std::string, int> counts;
  for (const std::string& name : detectors) {
    ++counts[name.substr(0, name.find(' ')) + (name.find(" pol ") != name.npos ? " pol" : "")];
  }
  EXPECT_EQ(counts,
            (std::map<std::string, int>{{"SIFT", 27},
                                        {"SIFT pol", 27},
                                        {"CenSurE", 18},
                                        {"CenSurE pol", 18},
                                        {"ORB", 3},
                                        {"ORB pol", 3},
                                        {"BRISK", 8},
                                        {"BRISK pol", 8}}));
}

TEST(Grid, PaperAndHighlightsHaveAllRowsOfTheReport) {
  const auto report = SetupsOfReport();
  for (const char* file : {"paper.yaml", "highlights.yaml"}) {
    const Grid grid = Shipped(file);
    const std::vector<std::string> detectors = grid.DetectorNames();
    const std::vector<std::string> triplets = grid.TripletNames();
    for (const std::string& setup : report.at("detectors")) {
      EXPECT_EQ(std::count(detectors.begin(), detectors.end(), setup), 1) << file << ": " << setup;
    }
    for (const std::string& setup : report.at("triplets")) {
      EXPECT_EQ(std::count(triplets.begin(), triplets.end(), setup), 1) << file << ": " << setup;
    }
  }
  EXPECT_EQ(Shipped("highlights.yaml").DetectorNames().size(), 12U);
  EXPECT_EQ(Shipped("highlights.yaml").TripletNames().size(), 18U);
}

TEST(Grid, EveryNameOfThePaperReadsBackToItself) {
  const Grid grid = Shipped("paper.yaml");
  EXPECT_EQ(Grid::FromNames(grid.TripletNames()).TripletNames(), grid.TripletNames());
}

TEST(Grid, QuickIsRead) { EXPECT_EQ(Shipped("quick.yaml").best, std::vector<int>{500}); }

TEST(Grid, ListsExpandToAllCombinations) {
  const Grid grid = FromText(
      "detectors:\n  - algorithm: FAST\n    threshold: [10, 20]\n    polar: [false, true]\n"
      "descriptors:\n  - algorithm: ORB\n    WTA_K: [2, 3]\nmatchers:\n  - algorithm: FLANN\n"
      "  - algorithm: BruteForce\n");
  EXPECT_THAT(grid.DetectorNames(),
              ElementsAre("FAST nopol 10", "FAST nopol 20", "FAST pol 10", "FAST pol 20"));
  EXPECT_EQ(grid.TripletNames().size(), 8U);
  EXPECT_EQ(grid.TripletNames()[1], "FAST nopol 10 ORB 3 BruteForce");
}

TEST(Grid, BriskPointsHaveTheirOwnPatternScaleOnly) {
  const Grid grid = FromText(
      "detectors:\n  - algorithm: BRISK\n    patternScale: [1, 2]\ndescriptors:\n"
      "  - algorithm: BRISK\n    patternScale: [1, 2]\nmatchers:\n  - algorithm: BruteForce\n");
  EXPECT_THAT(grid.TripletNames(),
              ElementsAre("BRISK nopol 30 1.0 BRISK 1.0 BruteForce",
                          "BRISK nopol 30 2.0 BRISK 2.0 BruteForce"));
}

TEST(Grid, FaultsAreToldWithTheirPlace) {
  const auto refusal = [](const std::string& text) {
    return MessageOf<InputError>([&] { FromText(text); });
  };
  EXPECT_THAT(refusal("detectors:\n  - algorithm: SIFT\n    sigm: 1.6\n"),
              testing::AllOf(HasSubstr("grid.yaml:3"), HasSubstr("sigma")));
  EXPECT_THAT(refusal("detectors:\n  - algorithm: SIFT\n    sigma: [1.6, blue]\n"),
              testing::AllOf(HasSubstr("grid.yaml:3"), HasSubstr("blue")));
  EXPECT_THAT(refusal("detectors:\n  - algorithm: STAR\n"),
              testing::AllOf(HasSubstr("grid.yaml:2"), HasSubstr("CenSurE")));
  EXPECT_THAT(refusal("settings:\n  - SIFT nopol 1\n"), HasSubstr("grid.yaml:2"));
  EXPECT_THAT(refusal("settings:\n  - FAST nopol 20 AKAZE BruteForce\n"), HasSubstr("AKAZE"));
  EXPECT_THAT(refusal("detector: []\n"), HasSubstr("detectors"));
  EXPECT_THAT(refusal("best: [500]\n"), HasSubstr("got none"));
  EXPECT_THAT(refusal("angles_deg: [0]\ndetectors:\n  - algorithm: SIFT\n"),
              HasSubstr("angles_deg"));
}

}  // namespace
}  // namespace pfseq
