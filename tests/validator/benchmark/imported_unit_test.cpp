// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/benchmark/npz_builder.h"
#include "tests/validator/test_sequence.h"
#include "validator/benchmark/unit.h"

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Features of two views of a yard from one place: what lies at the same pixel is the same.
class ImportedUnit : public testing::Test {
 protected:
  ImportedUnit() {
    TestSequence sequence = TestSequence::Yard(200);
    sequence.rig.lenses.pop_back();
    sequence.frames = {1};
    sequence.rig.cameras[1].rig_from_camera = {};
    sequence.Write(folder_.Path());
    setting_ = {"Net", (folder_ / "{camera}.csv").string(), Norm::kL2, false, ""};
    for (const char* matcher : {"BruteForce", "RatioTest", "FLANN"}) {
      grid_.imported_matchers.emplace_back(FindAlgorithm(KnownMatchers(), matcher, "matcher"));
    }
  }

  void Write(const char* file, const std::string& text) const {
    WriteFileAtomically(folder_ / file, text);
  }

  /// The detections' result, then the matchers'.
  std::vector<SettingResult> Run() const {
    const auto source = OpenViews(folder_.Path());
    const BenchmarkOptions options;
    const BenchmarkContext context(*source, grid_, options, "clean");
    const PairOfViews pair = {"equidistant", {"front", 1}, {"rear", 1}, "1"};
    return RunImportedUnit(context, pair, 7, setting_).of_members.at(0);
  }

  std::vector<std::string> Setups() const {
    std::vector<std::string> setups;
    for (const SettingResult& result : Run()) {
      EXPECT_EQ(result.pair_idx, 7U);
      setups.push_back(result.setup);
    }
    return setups;
  }

  /// "correct/attempted" of each matcher.
  std::vector<std::string> Matches() const {
    std::vector<std::string> matches;
    for (const SettingResult& result : Run()) {
      const auto first_of = [&](const char* name) {
        const auto metric = std::find_if(result.metrics.begin(),
                                         result.metrics.end(),
                                         [&](const Metric& m) { return m.name == name; });
        return metric != result.metrics.end() ? metric->values.at(0) : -1.0;
      };
      if (first_of("attempted") >= 0.0) {
        matches.push_back(fmt::format("{}/{}", first_of("correct_matches"), first_of("attempted")));
      }
    }
    return matches;
  }

  TempFolder folder_;
  ImportedSetting setting_;
  Grid grid_;
};

TEST_F(ImportedUnit, ReportsDetectionsThenEachMatcherThatFitsTheNorm) {
  Write("front.csv", "x,y,d0\n30,100,1\n100,40,2\n");
  Write("rear.csv", "x,y,d0\n30,100,1\n100,40,2\n");
  EXPECT_THAT(Setups(), ElementsAre("Net", "Net BruteForce", "Net RatioTest", "Net FLANN"));
  Write("matches.csv", "first,second\n0,0\n");
  setting_.matches = (folder_ / "matches.csv").string();
  setting_.norm = Norm::kHamming;
  EXPECT_THAT(Setups(), ElementsAre("Net", "Net BruteForce", "Net RatioTest", "Net Imported"));
}

TEST_F(ImportedUnit, MatchersTakeTheirParametersFromTheGrid) {
  // The nearest is correct each time; the second nearest is 10, 2 and 1.1 times as far away.
  Write("front.csv", "x,y,d0\n30,100,0\n100,40,1000\n170,110,2000\n");
  Write("rear.csv",
        "x,y,d0\n30,100,10\n100,40,1010\n170,110,2010\n30,110,-100\n100,50,980\n160,110,1989\n");
  EXPECT_THAT(Matches(), ElementsAre("3/3", "2/2", "2/2"));
  grid_.imported_matchers[1].Set("ratio", 0.4);
  grid_.imported_matchers[2].Set("ratio", 0.95);
  EXPECT_THAT(Matches(), ElementsAre("3/3", "1/1", "3/3"));
}

TEST_F(ImportedUnit, BitsAreComparedByHowManyDiffer) {
  // 128 differs from 0 by one bit, 3 by two.
  Write("front.csv", "x,y,d0\n30,100,0\n");
  Write("rear.csv", "x,y,d0\n100,40,3\n30,100,128\n");
  grid_.imported_matchers.resize(1, grid_.imported_matchers[0]);
  EXPECT_THAT(Matches(), ElementsAre("0/1"));
  setting_.norm = Norm::kHamming;
  EXPECT_THAT(Matches(), ElementsAre("1/1"));
}

TEST_F(ImportedUnit, PointsBeyondTheFieldAreLeftOutWithTheirDescriptors) {
  Write("front.csv", "x,y,d0\n1,1,2\n30,100,1\n100,40,2\n170,110,30\n");
  Write("rear.csv", "x,y,d0\n30,100,1\n199,199,30\n100,40,2\n170,110,30\n");
  Write("matches.csv", "first,second\n0,0\n1,0\n2,2\n3,1\n3,3\n");
  setting_.matches = (folder_ / "matches.csv").string();
  EXPECT_THAT(Matches(), ElementsAre("3/3", "3/3", "3/3", "3/3"));
}

TEST_F(ImportedUnit, WithoutDescriptorsNothingIsAttempted) {
  Write("front.csv", "x,y\n30,100\n100,40\n");
  Write("rear.csv", "x,y,d0\n30,100,1\n100,40,2\n");
  EXPECT_THAT(Matches(), ElementsAre("0/0", "0/0", "0/0"));
  Write("front.csv", "x,y,d0\n1,1,1\n");
  EXPECT_THAT(Matches(), ElementsAre("0/0", "0/0", "0/0"));
  EXPECT_TRUE(Run().front().is_degenerate);
}

TEST_F(ImportedUnit, DescriptorsOfTwoKindsAreRefused) {
  Write("front.csv", "x,y,d0,d1\n30,100,1,2\n");
  Write("rear.csv", "x,y,d0\n30,100,1\n");
  EXPECT_THAT(
      MessageOf<InputError>([&] { Run(); }),
      HasSubstr("{camera}.csv: expected descriptors of one kind, got 2 floats and 1 floats"));
  setting_.files = (folder_ / "{camera}.npz").string();
  const auto points = [] {
    return NpzBuilder().Add<float>("keypoints", "<f4", "(1, 2)", {30, 100});
  };
  Write("front.npz", points().Add<uint8_t>("descriptors", "|u1", "(1, 2)", {1, 2}).Bytes());
  Write("rear.npz", points().Add<float>("descriptors", "<f4", "(1, 2)", {1, 2}).Bytes());
  EXPECT_THAT(MessageOf<InputError>([&] { Run(); }),
              HasSubstr("expected descriptors of one kind, got 2 bytes and 2 floats"));
}

}  // namespace
}  // namespace pfseq
