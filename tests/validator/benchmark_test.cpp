// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/test_sequence.h"

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A yard with one lens and one frame.
TestSequence OneFrame(int size_px) {
  TestSequence sequence = TestSequence::Yard(size_px);
  sequence.rig.lenses.pop_back();
  sequence.frames = {1};
  return sequence;
}

BenchmarkOptions Quiet(int num_threads = 1) {
  BenchmarkOptions options;
  options.num_threads = num_threads;
  options.quiet = true;
  return options;
}

TEST(Benchmark, ACameraAgainstItselfRepeatsAllButTheSky) {
  TestSequence sequence = OneFrame(300);
  sequence.rig.cameras[1].rig_from_camera = {};
  const TempFolder folder;
  sequence.Write(folder.Path());
  const SequenceReader reader(folder.Path());
  const BenchmarkResults results = RunBenchmark(reader, Quiet());

  ASSERT_EQ(results.pairs.size(), 1U);
  const FeatureMetrics& metrics = results.pairs[0].metrics;
  EXPECT_GT(metrics.num_first, 200);
  EXPECT_EQ(metrics.num_first, metrics.num_second);
  // Points with a place in the world repeat exactly, at the smallest tolerance already.
  EXPECT_GT(metrics.Repeatability(0), 0.8);
  EXPECT_LT(metrics.matches[0], metrics.num_first);
  EXPECT_EQ(metrics.matches[0], metrics.matches[11]);
  // Each descriptor's nearest is itself.
  EXPECT_EQ(metrics.correct_matches[0], metrics.matches[0]);
  EXPECT_EQ(results.pairs[0].attempted.size(), static_cast<size_t>(metrics.num_first));
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TEST(Benchmark, AHalfTurnOfTheCameraCostsOpenCvsQuarterPixelOnly) {
  // The picture of a camera turned by 180 degrees about its axis is the same, upside down. With our
  // pixel convention its points lie at the same places, but for OpenCV's bias of a quarter of a
  // pixel, which both have: 0.5 px in x and y. In OpenCV's convention it would be -0.5 px.
  TestSequence sequence = OneFrame(300);
  const Eigen::AngleAxisd half_turn(std::numbers::pi, Vec3d::UnitZ());
  sequence.rig.cameras[1].rig_from_camera = {Eigen::Quaterniond(half_turn), Vec3d::Zero()};
  const TempFolder folder;
  sequence.Write(folder.Path());
  const BenchmarkResults results = RunBenchmark(SequenceReader(folder.Path()), Quiet());
  std::vector<double> x_px, y_px;
  for (const JudgedMatch& match : results.pairs[0].attempted) {
    const Vec2d offset_px = match.pixels_px[0] - (Vec2d(300.0, 300.0) - match.pixels_px[1]);
    x_px.push_back(offset_px.x());
    y_px.push_back(offset_px.y());
  }
  ASSERT_GT(x_px.size(), 100U);
  EXPECT_NEAR(Median(x_px), 0.5, 0.1);
  EXPECT_NEAR(Median(y_px), 0.5, 0.1);
}

TEST(Benchmark, PairOfTheRigMatchesWithinReason) {
  const TempFolder folder;
  OneFrame(400).Write(folder.Path());
  const BenchmarkResults results = RunBenchmark(SequenceReader(folder.Path()), Quiet(2));
  EXPECT_THAT(results.cameras, ElementsAre("front", "rear"));
  const FeatureMetrics& metrics = results.pairs.at(0).metrics;
  for (size_t i = 0; i + 1 < kTolerancesM.size(); ++i) {
    EXPECT_LE(metrics.matches[i], metrics.matches[i + 1]);
    EXPECT_LE(metrics.correct_matches[i], metrics.correct_matches[i + 1]);
  }
  EXPECT_GT(metrics.Repeatability(11), 0.3);
  EXPECT_GT(metrics.MatchingScore(11), 0.2);
}

TEST(Benchmark, DoesNotDependOnTheNumberOfThreads) {
  const TempFolder folder;
  OneFrame(300).Write(folder.Path());
  const SequenceReader reader(folder.Path());
  const BenchmarkResults one = RunBenchmark(reader, Quiet(1));
  const BenchmarkResults three = RunBenchmark(reader, Quiet(3));
  EXPECT_EQ(one.pairs[0].metrics.matches, three.pairs[0].metrics.matches);
  ASSERT_EQ(one.pairs[0].attempted.size(), three.pairs[0].attempted.size());
  for (size_t i = 0; i < one.pairs[0].attempted.size(); ++i) {
    EXPECT_EQ(one.pairs[0].attempted[i].pixels_px, three.pairs[0].attempted[i].pixels_px);
    EXPECT_EQ(one.pairs[0].attempted[i].distance_m, three.pairs[0].attempted[i].distance_m);
  }
}

class BenchmarkSelection : public testing::Test {
 protected:
  BenchmarkSelection() { TestSequence::Yard(64).Write(folder_.Path()); }

  std::set<std::pair<std::string, int>> Pairs(const BenchmarkOptions& options) const {
    std::set<std::pair<std::string, int>> pairs;
    for (const PairResult& pair : RunBenchmark(SequenceReader(folder_.Path()), options).pairs) {
      pairs.emplace(pair.lens, pair.frame);
    }
    return pairs;
  }

  std::string Refusal(const BenchmarkOptions& options) const {
    return MessageOf<InputError>([&] { Pairs(options); });
  }

  TempFolder folder_;
};

TEST_F(BenchmarkSelection, TakesAllCompletePairsByDefault) {
  std::filesystem::remove(ViewPath(folder_.Path(), "equisolid", "rear", Output::kDistance, 3));
  EXPECT_THAT(
      Pairs(Quiet()),
      ElementsAre(
          std::pair("equidistant", 1), std::pair("equidistant", 3), std::pair("equisolid", 1)));
}

TEST_F(BenchmarkSelection, TakesTheFramesAndLensesAskedFor) {
  BenchmarkOptions options = Quiet();
  options.frames = {3};
  options.lenses = {"equisolid"};
  EXPECT_THAT(Pairs(options), ElementsAre(std::pair("equisolid", 3)));
}

TEST_F(BenchmarkSelection, RefusesWhatIsNotThere) {
  BenchmarkOptions options = Quiet();
  options.frames = {1, 2};
  EXPECT_THAT(Refusal(options), HasSubstr("frame 2: expected clean images"));
  options = Quiet();
  options.lenses = {"orthographic"};
  EXPECT_THAT(Refusal(options), HasSubstr("orthographic"));
  options = Quiet();
  options.cameras = {"front", "left"};
  EXPECT_THAT(Refusal(options), HasSubstr("left"));
  options.cameras = {"front", "front"};
  EXPECT_THAT(Refusal(options), HasSubstr("twice"));
  std::filesystem::remove_all(folder_ / "equisolid");
  std::filesystem::remove_all(folder_ / "equidistant");
  EXPECT_THAT(Refusal(Quiet()), HasSubstr("no frame has"));
}

TEST_F(BenchmarkSelection, TableHasALineForEachPair) {
  const std::string table = BenchmarkTable(RunBenchmark(SequenceReader(folder_.Path()), Quiet()));
  EXPECT_THAT(table, HasSubstr("SIFT nopol 0.04 5.0 1.6 SIFT BruteForce"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3 + 4);
}

}  // namespace
}  // namespace pfseq
