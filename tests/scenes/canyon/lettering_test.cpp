// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/lettering.h"

#include "scenes/canyon/stroke_font.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(StrokeFont, HasADifferentShapeForEachCapitalAndFigure) {
  std::set<std::string> shapes;
  for (const char letter : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789")) {
    std::string shape;
    for (const Stroke& stroke : StrokesOf(letter)) {
      EXPECT_GE(stroke.size(), 2U) << letter;
      for (const Vec2d& point : stroke) {
        EXPECT_GE(point.minCoeff(), 0.0);
        EXPECT_LE(point.x(), 0.7);
        EXPECT_LE(point.y(), 1.0);
        shape += std::to_string(point.x()) + "," + std::to_string(point.y()) + " ";
      }
      shape += "/";
    }
    EXPECT_TRUE(shapes.insert(shape).second) << letter;
  }
  EXPECT_TRUE(StrokesOf(' ').empty());
  EXPECT_TRUE(StrokesOf('a').empty());
}

TEST(Lettering, StaysInItsBoxAndFillsItsWidth) {
  WallCanvas canvas({0, 0}, {4, 1}, 0.01);
  DrawText("WINE BAR", {0.5, 0.2}, {3.0, 0.6}, 0.15, Rgb::Zero(), canvas);
  double left_m = 4.0;
  double right_m = 0.0;
  canvas.ForEach({0, 0}, {4, 1}, [&](const WallTexel& texel, const Vec2d& point_m) {
    if (texel.color.mean() > 0.5F) {
      return;
    }
    left_m = std::min(left_m, point_m.x());
    right_m = std::max(right_m, point_m.x());
    EXPECT_GT(point_m.y(), 0.19);
    EXPECT_LT(point_m.y(), 0.81);
  });
  // The pen's width may stand out at both ends.
  EXPECT_NEAR(left_m, 0.5, 0.06);
  EXPECT_NEAR(right_m, 3.5, 0.06);
}

}  // namespace
}  // namespace pfseq
