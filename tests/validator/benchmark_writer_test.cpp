// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark_writer.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/image_io.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/test_sequence.h"

#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

using testing::HasSubstr;

std::vector<std::string> Lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

class BenchmarkWriter : public testing::Test {
 protected:
  BenchmarkWriter() { TestSequence::Yard(96).Write(sequence_folder_); }

  BenchmarkResults Run(const std::filesystem::path& folder, int num_threads) const {
    const SequenceReader reader(sequence_folder_);
    BenchmarkOptions options;
    options.num_threads = num_threads;
    options.quiet = true;
    BenchmarkResults results = RunBenchmark(reader, options);
    WriteBenchmark(results, reader, folder);
    return results;
  }

  TempFolder folder_;
  std::filesystem::path sequence_folder_ = folder_ / "yard";
};

TEST_F(BenchmarkWriter, WritesTheMeasuresInTheFormOfTheStudy) {
  BenchmarkResults results = Run(folder_ / "results", 1);
  results.pairs.resize(1);
  PairResult& pair = results.pairs[0];
  pair.metrics.num_first = 8;
  pair.metrics.num_second = 16;
  pair.metrics.matches.fill(4);
  pair.metrics.correct_matches.fill(1);
  WriteBenchmark(results, SequenceReader(sequence_folder_), folder_ / "results");
  const std::vector<std::string> lines = Lines(ReadFile(folder_ / "results" / "results.csv"));
  ASSERT_EQ(lines.size(), 1U + 4U * 12U);
  const std::string triplet = "SIFT nopol 0.04 5.0 1.6 SIFT BruteForce";
  EXPECT_EQ(lines[0], "lens,pair,metric,setup,tolerance_m,value");
  EXPECT_EQ(lines[1], "equidistant,1,correct_matches," + triplet + ",0.005,1");
  EXPECT_EQ(lines[2], "equidistant,1,correct_matches," + triplet + ",0.01,1");
  EXPECT_EQ(lines[12], "equidistant,1,correct_matches," + triplet + ",0.15,1");
  EXPECT_EQ(lines[13], "equidistant,1,matches,SIFT nopol 0.04 5.0 1.6,0.005,4");
  EXPECT_EQ(lines[25], "equidistant,1,matching_score," + triplet + ",0.005,0.125000");
  EXPECT_EQ(lines[37], "equidistant,1,repeatability,SIFT nopol 0.04 5.0 1.6,0.005,0.500000");
}

TEST_F(BenchmarkWriter, WritesSummaryTimesDescriptionAndPictures) {
  const BenchmarkResults results = Run(folder_ / "results", 1);
  const std::vector<std::string> summary = Lines(ReadFile(folder_ / "results" / "summary.csv"));
  ASSERT_EQ(summary.size(), 5U);
  EXPECT_EQ(summary[0], "lens,pair,setup,detections_front,detections_rear,attempted_matches");
  EXPECT_EQ(summary[1],
            fmt::format("equidistant,1,SIFT nopol 0.04 5.0 1.6 SIFT BruteForce,{},{},{}",
                        results.pairs[0].metrics.num_first,
                        results.pairs[0].metrics.num_second,
                        results.pairs[0].attempted.size()));
  EXPECT_EQ(Lines(ReadFile(folder_ / "results" / "times.csv")).size(), 5U);
  const auto description = nlohmann::json::parse(ReadFile(folder_ / "results" / "benchmark.json"));
  EXPECT_EQ(description["sequence"], "yard");
  EXPECT_EQ(description["program_version"], PFSEQ_VERSION);
  EXPECT_EQ(description["detector"]["contrast_threshold"], 0.04);
  for (const char* picture : {"matches_equidistant_000001.png", "matches_equisolid_000003.png"}) {
    EXPECT_EQ(ReadImage8(folder_ / "results" / picture).WidthPx(), 2 * 96);
  }
}

TEST_F(BenchmarkWriter, AllButTheTimesIsTheSameInEachRun) {
  Run(folder_ / "one", 1);
  Run(folder_ / "two", 2);
  int num_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "one")) {
    const std::filesystem::path name = entry.path().filename();
    if (name != "times.csv") {
      EXPECT_EQ(ReadFile(entry.path()), ReadFile(folder_ / "two" / name)) << name;
      ++num_files;
    }
  }
  EXPECT_EQ(num_files, 3 + 4);
}

TEST_F(BenchmarkWriter, TellsAFolderThatCannotBeWritten) {
  WriteFileAtomically(folder_ / "file", std::string_view("not a folder"));
  EXPECT_THROW(Run(folder_ / "file" / "results", 1), SystemError);
}

}  // namespace
}  // namespace pfseq
