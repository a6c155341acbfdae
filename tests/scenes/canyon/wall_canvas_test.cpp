// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_canvas.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(WallCanvas, RectanglesLieWhereTheyAreTold) {
  WallCanvas canvas({2, 10}, {4, 11}, 0.1);
  canvas.Rect({2.5, 10.2}, {3.0, 10.6}, Rgb::Zero(), 1.0);
  const Texture color = canvas.Finish("wall", 1).color;
  EXPECT_EQ(color.texels.WidthPx(), 20);
  EXPECT_EQ(color.texels.HeightPx(), 10);
  // Row 0 lies on top, at 11 m.
  EXPECT_EQ(color.texels.At(5, 4, 0), 0);
  EXPECT_EQ(color.texels.At(9, 7, 0), 0);
  EXPECT_EQ(color.texels.At(4, 4, 0), 255);
  EXPECT_EQ(color.texels.At(5, 3, 0), 255);
  EXPECT_EQ(color.texels.At(9, 8, 0), 255);
}

TEST(WallCanvas, ThinLinesArePaleInsteadOfWide) {
  WallCanvas canvas({0, 0}, {1, 1}, 0.1);
  canvas.Line({0.05, 0.55}, {0.95, 0.55}, 0.02, Rgb::Zero(), 1.0);
  const Texture color = canvas.Finish("wall", 1).color;
  EXPECT_NEAR(color.texels.At(5, 4, 1), 0.8 * 255, 3);
  EXPECT_EQ(color.texels.At(5, 6, 1), 255);
}

TEST(WallCanvas, NormalsLeanAwayFromWhatStandsOut) {
  WallCanvas canvas({0, 0}, {1, 1}, 0.05);
  canvas.Rect({0.4, 0.4}, {0.6, 0.6}, Rgb::Ones(), 0.0, 0.02);
  const Texture normal = canvas.Finish("wall", 1).normal;
  // Left of the block the surface rises to the right: red under the middle. Below it rises upwards:
  // green under the middle.
  EXPECT_LT(normal.texels.At(7, 10, 0), 127);
  EXPECT_GT(normal.texels.At(12, 10, 0), 128);
  EXPECT_LT(normal.texels.At(10, 12, 1), 127);
  EXPECT_GT(normal.texels.At(10, 7, 1), 128);
  EXPECT_NEAR(normal.texels.At(2, 2, 2), 255, 1);
}

TEST(WallCanvas, DirtDarkens) {
  WallCanvas canvas({0, 0}, {1, 1}, 0.1);
  canvas.At(3, 3).dirt = 1.0F;
  const Texture color = canvas.Finish("wall", 1).color;
  EXPECT_LT(color.texels.At(3, 3, 0), 110);
  EXPECT_EQ(color.texels.At(4, 3, 0), 255);
}

}  // namespace
}  // namespace pfseq
