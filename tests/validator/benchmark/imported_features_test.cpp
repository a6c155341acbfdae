// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/imported_features.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/benchmark/npz_builder.h"
#include "tests/validator/test_sequence.h"
#include "validator/benchmark/benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

TEST(FillPath, FillsInWordsWithZeros) {
  EXPECT_EQ(FillPath("a/{lens}/{frame:06}_{frame}.npz", {{"lens", "x"}, {"frame", "24"}}),
            "a/x/000024_24.npz");
  EXPECT_THAT(MessageOf<InputError>([] {
                FillPath("{camra}", {{"camera", "x"}});
              }),
              HasSubstr("{camra}"));
  EXPECT_THROW(FillPath("{frame", {{"frame", "1"}}), InputError);
}

class Imported : public testing::Test {
 protected:
  Imported() { setting_ = {"Net", (folder_ / "{camera}.csv").string(), Norm::kL2, false, ""}; }

  ImportedFeatures Read() const {
    return ReadImportedFeatures(setting_, "lens", {"front", 1}, "clean");
  }
  std::string Refusal(const std::string& csv) const {
    WriteFileAtomically(folder_ / "front.csv", csv);
    return MessageOf<InputError>([&] { Read(); });
  }

  TempFolder folder_;
  ImportedSetting setting_;
};

TEST_F(Imported, CsvHasPointsScoresAndDescriptors) {
  WriteFileAtomically(folder_ / "front.csv", "x,y,score,d0,d1\n1.5,2.5,9,0.25,1\n3,4,8,-2,0\n");
  const ImportedFeatures features = Read();
  ASSERT_EQ(features.pixels_px.size(), 2U);
  EXPECT_EQ(features.pixels_px[1], Vec2d(3.0, 4.0));
  EXPECT_EQ(features.scores[0], 9.0);
  EXPECT_EQ(features.descriptors.rows.at<float>(1, 0), -2.0F);
  setting_.origin_is_pixel_centre = true;
  EXPECT_EQ(Read().pixels_px[1], Vec2d(3.5, 4.5));
}

TEST_F(Imported, NpzMayHaveDescriptorsTurned) {
  setting_.files = (folder_ / "{camera}.npz").string();
  WriteFileAtomically(folder_ / "front.npz",
                      NpzBuilder()
                          .Add<float>("keypoints", "<f4", "(2, 2)", {1, 2, 3, 4})
                          .Add<float>("descriptors", "<f4", "(3, 2)", {1, 2, 3, 4, 5, 6})
                          .Bytes());
  const ImportedFeatures features = Read();
  EXPECT_EQ(features.descriptors.rows.at<float>(1, 2), 6.0F);
  EXPECT_EQ(features.descriptors.rows.at<float>(0, 1), 3.0F);
}

TEST_F(Imported, FaultsAreTold) {
  EXPECT_THAT(Refusal("x,z\n1,2\n"), HasSubstr("columns x and y"));
  EXPECT_THAT(Refusal("x,y\n1\n"), HasSubstr("front.csv:2"));
  EXPECT_THAT(Refusal("x,y\n1,a\n"), HasSubstr("'a'"));
  setting_.norm = Norm::kHamming;
  EXPECT_THAT(Refusal("x,y,d0\n1,2,0.5\n"), HasSubstr("bytes"));
  std::filesystem::remove(folder_ / "front.csv");
  EXPECT_THAT(MessageOf<InputError>([&] { Read(); }), HasSubstr("front.csv"));
}

TEST_F(Imported, IsJudgedLikeTheRest) {
  // Key points of both cameras at one place: the cameras are one, three points of four are the
  // same, and descriptors swap two of them.
  TestSequence sequence = TestSequence::Yard(200);
  sequence.rig.lenses.pop_back();
  sequence.frames = {1};
  sequence.rig.cameras[1].rig_from_camera = {};
  const TempFolder yard;
  sequence.Write(yard.Path());
  WriteFileAtomically(folder_ / "front.csv",
                      "x,y,d0\n30,100,1\n100,40,2\n170,110,3\n90,170,4\n1,1,5\n");
  WriteFileAtomically(folder_ / "rear.csv", "x,y,d0\n30,100,1\n100,40,3\n170,110,2\n20,90,9\n");
  WriteFileAtomically(folder_ / "matches.csv", "first,second\n0,0\n2,2\n4,1\n-1,2\n");
  setting_.matches = (folder_ / "matches.csv").string();
  Grid grid;
  grid.imported = {setting_};
  grid.imported_matchers = {*ParseName("FAST nopol 20 SIFT BruteForce").matcher};
  BenchmarkOptions options;
  options.quiet = true;
  const auto source = OpenViews(yard.Path());
  const BenchmarkResults results = RunBenchmark(*source, grid, options);
  const auto value = [&](const char* setup, const char* metric) {
    return results.Find(setup, 0, metric)->values[0];
  };
  EXPECT_EQ(value("Net", "detections_first"), 4.0);  // One lies outside the circle.
  EXPECT_EQ(value("Net", "matches"), 3.0);
  EXPECT_DOUBLE_EQ(value("Net", "repeatability"), 0.75);
  EXPECT_EQ(value("Net BruteForce", "correct_matches"), 1.0);
  EXPECT_EQ(value("Net Imported", "attempted"), 2.0);
  EXPECT_EQ(value("Net Imported", "correct_matches"), 2.0);
  WriteFileAtomically(folder_ / "matches.csv", "first,second\n0,77\n");
  EXPECT_THAT(MessageOf<InputError>([&] { RunBenchmark(*source, grid, options); }),
              HasSubstr("(0, 77)"));
}

}  // namespace
}  // namespace pfseq
