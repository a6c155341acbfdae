// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/pair_check.h"

#include "tests/validator/checks/finding_matchers.h"
#include "tests/validator/checks/view_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::Contains;
using testing::IsEmpty;

class PairCheck : public ViewFixture {};

constexpr const char* kFrontFile = "equisolid/front/distance/000001.exr";
constexpr const char* kRearFile = "equisolid/rear/distance/000001.exr";

TEST_F(PairCheck, TrueMapsAgreeCompletely) {
  const CheckReport report = Check(CheckPairs, 2);
  EXPECT_THAT(report.findings, IsEmpty());
  ASSERT_EQ(report.pairs.size(), 8U);  // Two lenses, two frames, two directions.
  ASSERT_EQ(report.pair_totals.size(), 4U);
  for (const PairAgreement& pair : report.pairs) {
    EXPECT_EQ(pair.num_disagreeing, 0U);
    EXPECT_LT(pair.percentile_99_gap_m, 2e-6);
    EXPECT_GT(pair.NumCompared(), pair.num_sampled / 2);
    EXPECT_GT(pair.num_outside, 0U);
    EXPECT_GT(pair.num_occluded, 0U);  // Behind the beam.
    EXPECT_EQ(pair.num_sampled,
              pair.NumCompared() + pair.num_outside + pair.num_occluded + pair.num_no_common);
  }
}

TEST_F(PairCheck, TotalsAreSumsOverFrames) {
  const CheckReport report = Check(CheckPairs);
  size_t num_compared = 0;
  for (const PairAgreement& pair : report.pairs) {
    num_compared += pair.lens == "equisolid" && pair.from_camera == "rear" ? pair.NumCompared() : 0;
  }
  const PairAgreement& total = report.pair_totals.back();
  EXPECT_EQ(total.lens, "equisolid");
  EXPECT_EQ(total.from_camera, "rear");
  EXPECT_EQ(total.to_camera, "front");
  EXPECT_EQ(total.frame, -1);
  EXPECT_EQ(total.NumCompared(), num_compared);
}

TEST_F(PairCheck, TellsASwappedPair) {
  SwapFiles(folder_ / kFrontFile, folder_ / kRearFile);
  const CheckReport report = Check(CheckPairs);
  EXPECT_THAT(report.findings, Contains(IsFault(kFrontFile, kRearFile)));
  EXPECT_THAT(report.findings, Contains(IsFault(kRearFile, kFrontFile)));
  EXPECT_EQ(report.findings.size(), 2U);
}

TEST_F(PairCheck, NoticesAMapShiftedByHalfAPixel) {
  sequence_.sample_px = {0.5, 1.0};
  sequence_.WriteView(
      folder_.Path(), ray_scene_, sequence_.rig.cameras[1], sequence_.rig.lenses[1], 1);
  EXPECT_THAT(Check(CheckPairs).findings, Contains(IsFault(kFrontFile, "agrees with")));
}

TEST_F(PairCheck, GapIsTheDistanceBetweenTheSurfaces) {
  // All of the rear's distances 0.1 % too long: the walls stand back by 0.1 % of their distance
  // from the camera.
  EditDistance(folder_ / kRearFile, [](Image<float>& distance_m) {
    for (float& value_m : distance_m.Values()) {
      value_m *= 1.001F;
    }
  });
  const CheckReport report = Check(CheckPairs);
  for (const PairAgreement& pair : report.pairs) {
    if (pair.lens == "equisolid" && pair.frame == 1 && pair.from_camera == "front") {
      // Walls are 8.5 to 17 m away, the beam above 3.4 m.
      EXPECT_GT(pair.median_gap_m, 0.0034);
      EXPECT_LT(pair.median_gap_m, 0.018);
      EXPECT_LT(pair.AgreeingShare(), 0.2);
    } else if (pair.frame == 3) {
      EXPECT_EQ(pair.AgreeingShare(), 1.0);
    }
  }
}

TEST_F(PairCheck, NoticesOneWrongPixelInTheCounts) {
  EditDistance(folder_ / kRearFile,
               [](Image<float>& distance_m) { distance_m.At(20, 40) *= 1.01F; });
  size_t num_disagreeing = 0;
  for (const PairAgreement& pair : Check(CheckPairs).pairs) {
    num_disagreeing += pair.num_disagreeing;
  }
  EXPECT_GE(num_disagreeing, 1U);
  EXPECT_LE(num_disagreeing, 10U);
}

TEST_F(PairCheck, OnePercentOfWrongPixelsIsAFault) {
  EditDistance(folder_ / kRearFile, [](Image<float>& distance_m) {
    for (int x = 16; x < 32; ++x) {
      distance_m.At(x, 40) *= 1.01F;
    }
  });
  EXPECT_THAT(Check(CheckPairs).findings, Contains(IsFault(kFrontFile, "expected 99.9 %")));
}

TEST_F(PairCheck, DoesNotDependOnTheNumberOfThreads) {
  EXPECT_EQ(Check(CheckPairs, 1).Text(), Check(CheckPairs, 3).Text());
}

TEST_F(PairCheck, SamplesWithAStride) {
  const auto with_stride = [](CheckContext context, CheckReport& report) {
    context.options.stride_px = 4;
    CheckPairs(context, report);
  };
  const size_t all = Check(CheckPairs).pairs[0].num_sampled;
  const size_t some = Check(with_stride).pairs[0].num_sampled;
  EXPECT_GT(some, all / 24);
  EXPECT_LT(some, all / 10);
}

TEST_F(PairCheck, UnreadableMapsAreLeftToTheOtherChecks) {
  std::filesystem::resize_file(folder_ / kRearFile, 100);
  const CheckReport report = Check(CheckPairs);
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_EQ(report.pairs.size(), 6U);
}

}  // namespace
}  // namespace pfseq
