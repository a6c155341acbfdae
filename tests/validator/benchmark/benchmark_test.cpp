// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/benchmark.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/test_sequence.h"
#include "validator/benchmark/results_writer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const char* const kSift = "SIFT nopol 0.02 10.0 1.6";
const char* const kTriplet = "SIFT nopol 0.02 10.0 1.6 SIFT BruteForce";

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

Grid SeveralSettings() {
  Grid grid = Grid::FromNames({"SIFT nopol 0.02 10.0 1.6 SIFT BruteForce",
                               "SIFT nopol 0.04 5.0 1.6 SIFT RatioTest",
                               "SIFT nopol 0.04 5.0 1.6 SIFT FLANN",
                               "SIFT nopol 0.04 10.0 1.6 ORB 3 BruteForce",
                               "SIFT pol 0.02 10.0 1.6 FREAK 11.0 BruteForce",
                               "CenSurE nopol 16 10 3 BRISK 1.0 BruteForce",
                               "CenSurE nopol 16 20 5 ORB 2 RatioTest",
                               "ORB pol 500 ORB 2 BruteForce",
                               "BRISK nopol 30 1.0 BRISK 1.0 BruteForce"});
  grid.best = {50};
  grid.angles_deg = {0.5};
  return grid;
}

BenchmarkResults RunOn(const std::filesystem::path& folder,
                       const BenchmarkOptions& options = Quiet(),
                       const std::vector<std::string>& names = {kTriplet}) {
  return RunBenchmark(*OpenViews(folder), Grid::FromNames(names), options);
}

double Value(const BenchmarkResults& results, const char* setup, const char* metric, size_t i) {
  const Metric* found = results.Find(setup, 0, metric);
  return found != nullptr ? found->values.at(i) : std::nan("");
}

/// The files of the results as one text.
std::string TextOf(const BenchmarkResults& results) {
  const TempFolder folder;
  WriteResults(results, folder.Path());
  return ReadFile(folder / "results.csv") + ReadFile(folder / "results.json");
}

TEST(Benchmark, ACameraAgainstItselfRepeatsAllButTheSky) {
  TestSequence sequence = OneFrame(300);
  sequence.rig.cameras[1].rig_from_camera = {};
  const TempFolder folder;
  sequence.Write(folder.Path());
  for (const Judge judge : {Judge::kRay, Judge::kMap}) {
    BenchmarkOptions options = Quiet();
    options.judge = judge;
    const BenchmarkResults results = RunOn(folder.Path(), options);
    const double num_first = Value(results, kSift, "detections_first", 0);
    EXPECT_GT(num_first, 200.0);
    EXPECT_EQ(num_first, Value(results, kSift, "detections_second", 0));
    // Points with a place in the world repeat exactly, at the smallest tolerance already.
    EXPECT_GT(Value(results, kSift, "repeatability", 0), 0.8);
    EXPECT_LT(Value(results, kSift, "matches", 0), num_first);
    EXPECT_EQ(Value(results, kSift, "matches", 0), Value(results, kSift, "matches", 11));
    // Each descriptor's nearest is itself.
    EXPECT_EQ(Value(results, kTriplet, "correct_matches", 0), Value(results, kSift, "matches", 0));
    EXPECT_EQ(Value(results, kTriplet, "attempted", 0), num_first);
  }
}

TEST(Benchmark, PolarKeyPointsComeBackToTheirPlaces) {
  TestSequence sequence = OneFrame(300);
  // The second camera is turned by 90 degrees: another seam, the same world.
  const Eigen::AngleAxisd turn(0.5 * std::numbers::pi, Vec3d::UnitZ());
  sequence.rig.cameras[1].rig_from_camera = {Eigen::Quaterniond(turn), Vec3d::Zero()};
  const TempFolder folder;
  sequence.Write(folder.Path());
  const BenchmarkResults results =
      RunOn(folder.Path(), Quiet(), {"SIFT pol 0.02 10.0 1.6 SIFT BruteForce"});
  EXPECT_GT(Value(results, "SIFT pol 0.02 10.0 1.6", "repeatability", 11), 0.6);
  EXPECT_GT(Value(results, "SIFT pol 0.02 10.0 1.6 SIFT BruteForce", "matching_score", 11), 0.5);
}

TEST(Benchmark, ResultsDoNotDependOnThreadsShardsOrInterruptions) {
  const TempFolder folder, stages;
  OneFrame(300).Write(folder.Path());
  const auto source = OpenViews(folder.Path());
  const Grid grid = SeveralSettings();
  const std::string expected = TextOf(RunBenchmark(*source, grid, Quiet(1)));
  EXPECT_EQ(TextOf(RunBenchmark(*source, grid, Quiet(3))), expected);

  BenchmarkOptions sharded = Quiet(2);
  sharded.stages = stages / "shards";
  sharded.resume = true;
  sharded.num_shards = 3;
  for (sharded.shard = 0; sharded.shard < 3; ++sharded.shard) {
    RunBenchmark(*source, grid, sharded);
  }
  BenchmarkOptions last = Quiet(1);
  last.stages = sharded.stages;
  last.resume = true;
  const BenchmarkResults resumed = RunBenchmark(*source, grid, last);
  EXPECT_EQ(TextOf(resumed), expected);
  for (const StageTime& time : resumed.times) {
    EXPECT_TRUE(time.stage == "detect" || time.stage == "judge") << time.stage << " done again";
  }

  // Some stages lost, one damaged: made again, with the same results.
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(last.stages)) {
    if (++count % 3 == 0) {
      std::filesystem::remove(entry.path());
    } else if (count % 3 == 1) {
      WriteFileAtomically(entry.path(), "damaged");
    }
  }
  EXPECT_GT(count, 9);
  EXPECT_EQ(TextOf(RunBenchmark(*source, grid, last)), expected);
}

TEST(Benchmark, StagesOfOtherImagesAreNotTaken) {
  const TempFolder folder, stages;
  TestSequence sequence = OneFrame(300);
  sequence.Write(folder.Path());
  BenchmarkOptions options = Quiet();
  options.stages = stages.Path();
  options.resume = true;
  const std::string before = TextOf(RunOn(folder.Path(), options));
  SwapFiles(ViewPath(folder.Path(), "equidistant", "front", Output::kClean, 1),
            ViewPath(folder.Path(), "equidistant", "rear", Output::kClean, 1));
  const std::string after = TextOf(RunOn(folder.Path(), options));
  EXPECT_NE(before, after);
  EXPECT_EQ(after, TextOf(RunOn(folder.Path())));
}

/// The matching score at 5 cm on the yard with something wrong.
double ScoreWith(const std::function<void(TestSequence&, const std::filesystem::path&)>& damage) {
  TestSequence sequence = OneFrame(400);
  const TempFolder folder;
  sequence.Write(folder.Path());
  damage(sequence, folder.Path());
  BenchmarkOptions options = Quiet();
  options.judge = Judge::kMap;
  return Value(RunOn(folder.Path(), options), kTriplet, "matching_score", 5);
}

TEST(Benchmark, AFlippedAxisAHalfPixelShiftAndASwappedPairChangeTheScores) {
  const auto rewrite_rig = [](const TestSequence& sequence, const std::filesystem::path& folder) {
    WriteFileAtomically(folder / kRigFile, sequence.rig.ToYaml());
  };
  const double right = ScoreWith([](TestSequence&, const std::filesystem::path&) {});
  const double flipped =
      ScoreWith([&](TestSequence& sequence, const std::filesystem::path& folder) {
        Eigen::Quaterniond& rotation = sequence.rig.cameras[1].rig_from_camera.rotation;
        rotation = rotation * Eigen::AngleAxisd(std::numbers::pi, Vec3d::UnitX());
        rewrite_rig(sequence, folder);
      });
  const double shifted =
      ScoreWith([&](TestSequence& sequence, const std::filesystem::path& folder) {
        const Lens& lens = sequence.rig.lenses[0].value;
        sequence.rig.lenses[0].value = Lens(lens.Model(),
                                            lens.FocalPx(),
                                            lens.PrincipalPointPx() + Vec2d(0.5, 0.5),
                                            lens.MaxAngleRad());
        rewrite_rig(sequence, folder);
      });
  const double swapped = ScoreWith([](TestSequence&, const std::filesystem::path& folder) {
    SwapFiles(ViewPath(folder, "equidistant", "front", Output::kClean, 1),
              ViewPath(folder, "equidistant", "rear", Output::kClean, 1));
  });
  RecordProperty("right", std::to_string(right));
  RecordProperty("flipped", std::to_string(flipped));
  RecordProperty("shifted", std::to_string(shifted));
  RecordProperty("swapped", std::to_string(swapped));
  EXPECT_GT(right, 0.1);
  EXPECT_LT(flipped, 0.1 * right);
  EXPECT_LT(swapped, 0.1 * right);
  // Small: at 400 px half a pixel is a few millimetres on near walls, and both views shift alike.
  EXPECT_GT(std::abs(shifted - right), 0.005 * right);
}

TEST(Benchmark, AngularTolerancesAndBestComeFromTheGrid) {
  const TempFolder folder;
  OneFrame(300).Write(folder.Path());
  Grid grid = Grid::FromNames({kTriplet});
  grid.angles_deg = {0.5, 2.0};
  grid.best = {40};
  const BenchmarkResults results = RunBenchmark(*OpenViews(folder.Path()), grid, Quiet());
  ASSERT_EQ(results.Find(kSift, 0, "matches")->values.size(), 14U);
  EXPECT_GT(Value(results, kSift, "matches", 13), Value(results, kSift, "matches", 12));
  EXPECT_LE(Value(results, kSift, "matches_best_40", 11), 40.0);
  const nlohmann::json json =
      nlohmann::json::parse(TextOf(results).substr(TextOf(results).find('{')));
  EXPECT_EQ(json["tolerances_deg"], nlohmann::json({0.5, 2.0}));
  EXPECT_EQ(json["settings"].size(), 2U);
  EXPECT_EQ(json["settings"][0]["matches"].size(), 14U);
}

class BenchmarkSelection : public testing::Test {
 protected:
  BenchmarkSelection() { TestSequence::Yard(64).Write(folder_.Path()); }

  std::vector<std::string> Labels(const BenchmarkOptions& options) const {
    std::vector<std::string> labels;
    for (const PairOfViews& pair : RunOn(folder_.Path(), options).pairs) {
      labels.push_back(pair.lens.substr(0, 5) + " " + pair.label);
    }
    return labels;
  }

  std::string Refusal(const BenchmarkOptions& options) const {
    return MessageOf<InputError>([&] { Labels(options); });
  }

  TempFolder folder_;
};

TEST_F(BenchmarkSelection, TakesAllCompletePairsByDefault) {
  std::filesystem::remove(ViewPath(folder_.Path(), "equisolid", "rear", Output::kClean, 3));
  EXPECT_THAT(Labels(Quiet()), ElementsAre("equid 1", "equid 3", "equis 1"));
}

TEST_F(BenchmarkSelection, TakesFramesSuccessiveFramesAndAnyTwoViews) {
  BenchmarkOptions options = Quiet();
  options.lenses = {"equisolid"};
  options.pairs = "3,1:4:2";
  EXPECT_THAT(Labels(options), ElementsAre("equis 3", "equis 1"));
  options.pairs = "front:1-rear:3";
  EXPECT_THAT(Labels(options), ElementsAre("equis front:1-rear:3"));
  options.pairs.clear();
  options.successive = 2;
  EXPECT_THAT(Labels(options), ElementsAre("equis front:1-front:3", "equis rear:1-rear:3"));
}

TEST_F(BenchmarkSelection, TakesRealisticImagesWhereTheyAre) {
  BenchmarkOptions options = Quiet();
  options.variant = "realistic";
  EXPECT_THAT(Refusal(options), HasSubstr("clean images only"));
  options.variant.clear();
  EXPECT_EQ(RunOn(folder_.Path(), options).variant, "clean");
  for (const char* camera : {"front", "rear"}) {
    std::filesystem::copy(folder_ / "equisolid" / camera / "clean",
                          folder_ / "equisolid" / camera / "realistic");
  }
  EXPECT_EQ(RunOn(folder_.Path(), options).variant, "realistic");
}

TEST_F(BenchmarkSelection, RefusesWhatIsNotThere) {
  BenchmarkOptions options = Quiet();
  options.pairs = "1,2";
  EXPECT_THAT(Refusal(options), HasSubstr("frame 2: expected a clean image"));
  for (const char* pairs : {"1-2", "front:1-rear", "1:", "x", "-1", "3:1"}) {
    options.pairs = pairs;
    EXPECT_THAT(Refusal(options), HasSubstr("--pairs")) << pairs;
  }
  options = Quiet();
  options.lenses = {"orthographic"};
  EXPECT_THAT(Refusal(options), HasSubstr("orthographic"));
  options = Quiet();
  options.cameras = {"front", "left"};
  EXPECT_THAT(Refusal(options), HasSubstr("left"));
  options.cameras = {"front", "front"};
  EXPECT_THAT(Refusal(options), HasSubstr("twice"));
}

TEST_F(BenchmarkSelection, AMissingMapASceneOrAnImageOfAnotherSizeIsTold) {
  BenchmarkOptions options = Quiet();
  options.lenses = {"equisolid"};
  options.pairs = "1";
  std::filesystem::remove(ViewPath(folder_.Path(), "equisolid", "rear", Output::kDistance, 1));
  EXPECT_EQ(Labels(options).size(), 1U);  // Rays need no map.
  options.judge = Judge::kMap;
  EXPECT_THAT(Refusal(options), HasSubstr("000001.exr"));
  options.judge = Judge::kRay;
  std::filesystem::remove(folder_ / "scene.glb");
  EXPECT_THAT(Refusal(options), HasSubstr("--judge map"));
}

TEST_F(BenchmarkSelection, ImagesOfAnotherSizeAreTold) {
  const TempFolder other;
  TestSequence::Yard(48).Write(other.Path());
  std::filesystem::copy_file(ViewPath(other.Path(), "equisolid", "rear", Output::kClean, 1),
                             ViewPath(folder_.Path(), "equisolid", "rear", Output::kClean, 1),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(Refusal(Quiet()), HasSubstr("expected 64 x 64 px"));
}

TEST_F(BenchmarkSelection, TableHasALineForEachSettingAndPairUpToALimit) {
  const BenchmarkResults results = RunOn(folder_.Path());
  const std::string table = BenchmarkTable(results, 100);
  EXPECT_THAT(table, HasSubstr(kTriplet));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 2 * 4);
  const std::string short_table = BenchmarkTable(results, 3);
  EXPECT_EQ(std::count(short_table.begin(), short_table.end(), '\n'), 1 + 4);
}

TEST_F(BenchmarkSelection, ResultsHaveOneRowForEachSettingPairToleranceAndMetric) {
  BenchmarkOptions options = Quiet();
  options.lenses = {"equisolid"};
  options.pairs = "1";
  const BenchmarkResults results = RunOn(folder_.Path(), options);
  const TempFolder out;
  WriteResults(results, out.Path());
  const std::string csv = ReadFile(out / "results.csv");
  EXPECT_THAT(csv, testing::StartsWith("lens,pair,metric,setup,tolerance_m,value"));
  EXPECT_THAT(csv, HasSubstr("equisolid,1,matches,SIFT nopol 0.02 10.0 1.6,0.005,"));
  EXPECT_THAT(csv, HasSubstr("equisolid,1,matching_score," + std::string(kTriplet) + ",0.15,"));
  // 8 metrics of a detector and 10 of a triplet at 12 tolerances, 3 and 2 without, and the header.
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 12 * (8 + 10) + 3 + 2);
  EXPECT_THAT(ReadFile(out / "times.csv"), HasSubstr(",detect,"));
}

}  // namespace
}  // namespace pfseq
