// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_painting.h"
#include "tests/scenes/canyon/wall_test_support.h"

#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kTexel_m = 0.005;

/// A wall of 6 m with two windows of 1.2 m.
WallPainting WallWithWindows() {
  WallPainting painting = PlainWall(WallSurface::kBrick, {{0, 4}, {6, 8}});
  painting.texel_m = kTexel_m;
  painting.openings = {{{1.0, 5.0}, {2.2, 6.8}}, {{3.8, 5.0}, {5.0, 6.8}}};
  return painting;
}

WallCanvas Dressed(const WallPainting& painting) {
  WallCanvas canvas = GreyCanvas(painting);
  PaintDressings(painting, canvas);
  return canvas;
}

TEST(WallDressings, AreNotThereUnasked) {
  WallCanvas canvas = Dressed(WallWithWindows());
  EXPECT_TRUE(PlacesWhere(canvas, IsPainted).empty());
}

class FlatArches : public testing::Test {
 protected:
  FlatArches() { painting_.has_flat_arches = true; }

  WallPainting painting_ = WallWithWindows();
};

TEST_F(FlatArches, LieOnTheHeadsOfOpenings) {
  WallCanvas canvas = Dressed(painting_);
  const auto arches = PatchesWhere(canvas, IsPainted);
  ASSERT_EQ(arches.size(), 2U);
  for (size_t i = 0; i < 2; ++i) {
    const WallRect arch = RectAround(arches[i]);
    const WallRect& opening = painting_.openings[i];
    EXPECT_NEAR(arch.low_m.y(), opening.high_m.y(), kTexel_m);
    EXPECT_NEAR(arch.high_m.y(), opening.high_m.y() + 0.25, kTexel_m);
    // They rest on the wall beside the opening.
    EXPECT_LT(arch.low_m.x(), opening.low_m.x() - 0.05);
    EXPECT_GT(arch.high_m.x(), opening.high_m.x() + 0.05);
    EXPECT_NEAR(opening.low_m.x() - arch.low_m.x(), arch.high_m.x() - opening.high_m.x(), 0.006);
    EXPECT_LT(arch.high_m.x(), opening.high_m.x() + 0.2);
  }
}

TEST_F(FlatArches, AreOfBricksOnEndThatFanOut) {
  WallCanvas canvas = Dressed(painting_);
  const auto bricks_m = [&](double up_m) {
    const WallRect band = {{0.8, 6.8 + up_m - 0.02}, {2.4, 6.8 + up_m + 0.02}};
    return StretchesWhere(band, 0, kTexel_m, [&](const WallRect& slice) {
      return MeanOver(slice, canvas, HeightOf) > 0.004;
    });
  };
  const auto low_m = bricks_m(0.05);
  const auto high_m = bricks_m(0.20);
  ASSERT_EQ(low_m.size(), 17U);
  ASSERT_EQ(high_m.size(), low_m.size());
  // The middle one stands upright; the further from it, the more they lean outwards.
  const double head_m = 1.6;
  for (size_t i = 0; i < low_m.size(); ++i) {
    EXPECT_NEAR(high_m[i].mean() - head_m, 1.066 * (low_m[i].mean() - head_m), 0.008) << i;
  }
  EXPECT_GT(high_m.back().mean() - low_m.back().mean(), 0.03);
}

class Quoins : public testing::Test {
 protected:
  Quoins() { painting_.has_quoins = true; }

  /// Stretches up the wall where all between two distances from an end is a stone.
  std::vector<Vec2d> Stones(WallCanvas& canvas, double left_m, double right_m) const {
    return StretchesWhere(
        {{left_m, 4.0}, {right_m, 8.0}}, 1, canvas.TexelM(), [&](const WallRect& slice) {
          return MeanOver(slice, canvas, IsPainted) == 1.0;
        });
  }

  WallPainting painting_ = WallWithWindows();
};

TEST_F(Quoins, AreLongAndShortStonesInTurnUpBothEnds) {
  WallCanvas canvas = Dressed(painting_);
  const auto long_m = Stones(canvas, 0.305, 0.455);
  EXPECT_EQ(long_m, Stones(canvas, 6.0 - 0.455, 6.0 - 0.305));
  // The lowest and the highest one go on beyond this part of the wall.
  ASSERT_EQ(long_m.size(), 7U);
  for (size_t i = 1; i + 1 < long_m.size(); ++i) {
    EXPECT_NEAR(long_m[i].y() - long_m[i].x(), 0.34, 0.011);
    EXPECT_NEAR(long_m[i].x() - long_m[i - 1].y(), 0.34, 0.011);
  }
  // The short ones leave no gap at the ends.
  const double height_m = canvas.HighM().y() - canvas.LowM().y();
  for (const double left_m : {0.0, 6.0 - 0.295}) {
    const auto all_m = Stones(canvas, left_m, left_m + 0.295);
    ASSERT_EQ(all_m.size(), 1U);
    EXPECT_NEAR(all_m[0].y() - all_m[0].x(), height_m, 1e-9);
  }
  EXPECT_EQ(MeanOver({{0.47, 4.0}, {6.0 - 0.47, 8.0}}, canvas, IsPainted), 0.0);
}

TEST_F(Quoins, StandOutAndArePalerThanBricks) {
  WallCanvas canvas = Dressed(painting_);
  for (const double left_m : {0.0, 5.7}) {
    const WallRect end = {{left_m, 4.0}, {left_m + 0.3, 8.0}};
    EXPECT_NEAR(MeanOver(end, canvas, HeightOf), 0.02, 0.003);
    EXPECT_GT(MeanOver(end, canvas, BrightnessOf), painting_.look.color.mean());
  }
}

}  // namespace
}  // namespace pfseq
