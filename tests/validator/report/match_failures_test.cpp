// SPDX-License-Identifier: Apache-2.0
#include "validator/report/match_failures.h"

#include "renderer/lens/equidistant.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// A circle of 100 px about (50, 50): 1 rad at 50 px.
const Lens kLens(Equidistant{}, Vec2d::Constant(50.0), Vec2d(50.0, 50.0), 1.0);

const FailureBin& BinNamed(const std::vector<FailureBin>& bins, const std::string& label) {
  for (const FailureBin& bin : bins) {
    if (bin.label == label) {
      return bin;
    }
  }
  ADD_FAILURE() << "no bin " << label;
  return bins.front();
}

TEST(FailuresOf, CountsByRadiusDistanceAndBlur) {
  TripletMatches matches;
  // Right at 12 m near the centre; wrong at 3 m near the rim; sky.
  matches.detections_px[0] = {Vec2d(57.2, 50.5), Vec2d(50.5, 97.5), Vec2d(50.5, 48.5)};
  matches.detections_px[1] = matches.detections_px[0];
  matches.points.first_m = {Vec3d(0, 0, 12), Vec3d(0, 0, 3), std::nullopt};
  matches.points.second_m = {Vec3d(0.05, 0, 12), Vec3d(0.2, 0, 3), Vec3d(0, 0, 9)};
  matches.attempted = {{0, 0}, {1, 1}, {2, 2}};
  Image<float> blur_px(100, 100, 2, 0.0F);
  blur_px.At(57, 50, 0) = 3.0F;
  blur_px.At(57, 50, 1) = 4.0F;
  blur_px.At(50, 97, 1) = -20.0F;
  const FailureTable table = FailuresOf(7, matches, kLens, &blur_px);
  EXPECT_EQ(table.case_idx, 7U);
  EXPECT_EQ(table.by_radius[1].attempted, 1);
  EXPECT_EQ(table.by_radius[1].correct, 1);
  EXPECT_EQ(table.by_radius[9].attempted, 1);
  EXPECT_EQ(table.by_radius[9].correct, 0);
  EXPECT_EQ(BinNamed(table.by_distance, "10 to 20 m").correct, 1);
  EXPECT_EQ(BinNamed(table.by_distance, "under 5 m").attempted, 1);
  EXPECT_EQ(BinNamed(table.by_distance, "sky").attempted, 1);
  EXPECT_EQ(BinNamed(table.by_distance, "sky").correct, 0);
  EXPECT_EQ(BinNamed(table.by_blur, "4 to 8 px").correct, 1);
  EXPECT_EQ(BinNamed(table.by_blur, "over 16 px").attempted, 1);
  EXPECT_EQ(BinNamed(table.by_blur, "under 0.5 px").attempted, 1);
  EXPECT_TRUE(FailuresOf(7, matches, kLens, nullptr).by_blur.empty());
}

}  // namespace
}  // namespace pfseq
