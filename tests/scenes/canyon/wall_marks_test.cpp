// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_painting.h"
#include "tests/scenes/canyon/wall_test_support.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// So high that fittings and the cable hang above all that is at street level.
WallPainting HighWall(uint64_t seed, double marks) {
  WallPainting painting = PlainWall(WallSurface::kPlaster, {{0, 0}, {6, 12}}, seed);
  painting.pavement_m = 0.1;
  painting.marks = marks;
  return painting;
}

WallCanvas Marked(const WallPainting& painting) {
  WallCanvas canvas = GreyCanvas(painting);
  PaintMarks(painting, canvas);
  return canvas;
}

/// How much of the street level is marked.
double MarkedShare(const WallPainting& painting) {
  WallCanvas canvas = Marked(painting);
  return MeanOver({{0, 0}, {6, 3}}, canvas, IsPainted);
}

bool IsPoster(const WallTexel& texel) { return texel.roughness == 0.6F; }

TEST(WallMarks, DependOnTheWallAlone) {
  const auto colors = [](uint64_t seed) {
    return Marked(HighWall(seed, 1.0)).Finish("wall", 1).color.texels;
  };
  EXPECT_EQ(colors(1), colors(1));
  EXPECT_NE(colors(1), colors(2));
}

TEST(WallMarks, AWallWithoutMarksHasFittingsOnly) {
  int num_fittings = 0;
  for (uint64_t seed = 0; seed < 12; ++seed) {
    WallCanvas canvas = Marked(HighWall(seed, 0.0));
    for (const auto& patch : PatchesWhere(canvas, IsPainted)) {
      const WallRect fitting = RectAround(patch);
      // Small, and well above the street.
      EXPECT_LT((fitting.high_m - fitting.low_m).maxCoeff(), 1.0);
      EXPECT_GT(fitting.low_m.y(), 3.3);
      ++num_fittings;
    }
  }
  // At most one for 20 square metres.
  EXPECT_GT(num_fittings, 12);
  EXPECT_LE(num_fittings, 12 * 6 * 12 / 20);
}

TEST(WallMarks, HangAtStreetLevel) {
  int num_marked = 0;
  double sum = 0.0;
  double at_eye_level = 0.0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    WallCanvas canvas = Marked(HighWall(seed, 2.0));
    sum += MeanOver({{0, 0}, {6, 3.3}}, canvas, IsPainted) * 3.3;
    at_eye_level += MeanOver({{0, 0.5}, {6, 2.5}}, canvas, IsPainted) * 2.0;
    // Splashes and the next floor are left alone.
    EXPECT_EQ(MeanOver({{0, 0}, {6, 0.3}}, canvas, IsPainted), 0.0) << seed;
    EXPECT_EQ(MeanOver({{0, 3.0}, {6, 3.3}}, canvas, IsPainted), 0.0) << seed;
    num_marked += MeanOver({{0, 0.5}, {6, 2.5}}, canvas, IsPainted) > 0.0 ? 1 : 0;
  }
  EXPECT_GT(num_marked, 12);
  EXPECT_GT(at_eye_level, 0.95 * sum);
}

TEST(WallMarks, AreManyWhereManyAreAskedFor) {
  double few = 0.0;
  double many = 0.0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    few += MarkedShare(HighWall(seed, 0.3));
    many += MarkedShare(HighWall(seed, 2.0));
  }
  EXPECT_GT(few, 0.0);
  EXPECT_GT(many, 2.0 * few);
}

TEST(WallMarks, LeaveOpeningsOut) {
  double beside = 0.0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    WallPainting painting = HighWall(seed, 2.0);
    painting.openings = {{{0.3, 1.0}, {3.5, 2.4}}};
    WallCanvas canvas = Marked(painting);
    // Left of it there is no room; sprayed letters may lean a little.
    EXPECT_EQ(MeanOver({{0, 0}, {3.45, 3.3}}, canvas, IsPainted), 0.0) << seed;
    beside += MeanOver({{3.55, 0}, {6, 3.3}}, canvas, IsPainted);
    painting.openings.push_back({{3.8, 0.1}, {5.6, 2.4}});
    EXPECT_EQ(MarkedShare(painting), 0.0) << seed;
  }
  EXPECT_GT(beside, 0.0);
}

TEST(WallMarks, PostersHangSideBySideAtEyeLevel) {
  int num_patches = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    WallPainting painting = HighWall(seed, 3.0);
    painting.openings = {{{2.0, 1.0}, {4.0, 2.4}}};
    WallCanvas canvas = Marked(painting);
    for (const auto& patch : PatchesWhere(canvas, IsPoster)) {
      const WallRect posters = RectAround(patch);
      EXPECT_GT(posters.low_m.y(), 0.5 + 0.55);
      EXPECT_LT(posters.high_m.y(), 0.5 + 0.95 + 0.84);
      EXPECT_TRUE(posters.high_m.x() < 2.0 || posters.low_m.x() > 4.0);
      ++num_patches;
    }
  }
  EXPECT_GT(num_patches, 20);
}

TEST(WallMarks, ACableRunsUnderTheTopOfSomeWalls) {
  int num_cables = 0;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    WallPainting painting = HighWall(seed, 0.1);
    WallCanvas canvas = Marked(painting);
    const auto stretches_m =
        StretchesWhere({{0.0, 11.4}, {6.0, 11.8}}, 0, painting.texel_m, [&](const WallRect& slice) {
          return MeanOver(slice, canvas, IsPainted) > 0.0;
        });
    if (stretches_m.size() == 1 && stretches_m[0].y() - stretches_m[0].x() > 5.9) {
      ++num_cables;
    }
  }
  EXPECT_GT(num_cables, 40 / 3);
  EXPECT_LT(num_cables, 40 * 5 / 6);
}

}  // namespace
}  // namespace pfseq
