// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/stroke_font.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr std::string_view kAll = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

/// Points in millionths of the height, so that mirroring does not round them apart.
std::set<std::pair<long, long>> Places(char letter, bool is_mirrored = false) {
  std::set<std::pair<long, long>> places;
  for (const Stroke& stroke : StrokesOf(letter)) {
    for (const Vec2d& point : stroke) {
      const double x = is_mirrored ? 0.7 - point.x() : point.x();
      places.emplace(std::lround(1e6 * x), std::lround(1e6 * point.y()));
    }
  }
  return places;
}

TEST(StrokeFont, LettersFillTheirBoxFromFootToHead) {
  for (const char letter : kAll) {
    const std::vector<Stroke> strokes = StrokesOf(letter);
    ASSERT_FALSE(strokes.empty()) << letter;
    double low = 1.0;
    double high = 0.0;
    for (const Stroke& stroke : strokes) {
      EXPECT_GE(stroke.size(), 2U) << letter;
      for (const Vec2d& point : stroke) {
        EXPECT_GE(point.x(), 0.0) << letter;
        EXPECT_LE(point.x(), 0.7 + 1e-12) << letter;
        low = std::min(low, point.y());
        high = std::max(high, point.y());
      }
    }
    EXPECT_EQ(low, 0.0) << letter;
    EXPECT_EQ(high, 1.0) << letter;
  }
}

TEST(StrokeFont, NoTwoLettersAreAlike) {
  for (size_t i = 0; i < kAll.size(); ++i) {
    for (size_t k = i + 1; k < kAll.size(); ++k) {
      EXPECT_NE(StrokesOf(kAll[i]), StrokesOf(kAll[k])) << kAll[i] << kAll[k];
    }
  }
}

TEST(StrokeFont, OtherCharactersHaveNoStrokes) {
  for (const char other : std::string_view("abz @[/:-\0\xC4", 11)) {
    EXPECT_TRUE(StrokesOf(other).empty()) << static_cast<int>(other);
  }
}

TEST(StrokeFont, LettersStandUprightAndAreNotMirrored) {
  const std::vector<Stroke> foot_to_the_right = {{{0.0, 1.0}, {0.0, 0.0}, {0.7, 0.0}}};
  EXPECT_EQ(StrokesOf('L'), foot_to_the_right);
  const std::vector<Stroke> down_to_the_right = {{{0.0, 0.0}, {0.0, 1.0}, {0.7, 0.0}, {0.7, 1.0}}};
  EXPECT_EQ(StrokesOf('N'), down_to_the_right);
  for (const char symmetric : std::string_view("AHIMTUVWXY8")) {
    EXPECT_EQ(Places(symmetric), Places(symmetric, true)) << symmetric;
  }
  for (const char other : std::string_view("BCDEFGJKLPQRS1234569")) {
    EXPECT_NE(Places(other), Places(other, true)) << other;
  }
}

TEST(StrokeFont, TextReachesFromItsFirstLetterToItsLast) {
  EXPECT_EQ(TextWidth(""), 0.0);
  EXPECT_NEAR(TextWidth("A"), 0.7, 1e-12);
  EXPECT_NEAR(TextWidth("CAFE"), 3.0 * kLetterAdvance + 0.7, 1e-12);
  // Letters do not touch.
  EXPECT_GT(kLetterAdvance, 0.7);
}

}  // namespace
}  // namespace pfseq
