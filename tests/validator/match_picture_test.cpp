// SPDX-License-Identifier: Apache-2.0
#include "validator/match_picture.h"

#include <limits>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

bool IsBlue(const Image<uint8_t>& picture, int x, int y) {
  return picture.At(x, y, 2) > 150 && picture.At(x, y, 0) < 120;
}

bool IsOrange(const Image<uint8_t>& picture, int x, int y) {
  return picture.At(x, y, 0) > 150 && picture.At(x, y, 2) < 120;
}

TEST(MatchPicture, ShowsBothViewsSideBySideAtReducedSize) {
  const Image<uint8_t> dark(1600, 1000, 3, 30);
  const Image<uint8_t> light(1600, 1000, 3, 200);
  const Image<uint8_t> picture = MatchPicture(dark, light, {}, "title");
  EXPECT_EQ(picture.WidthPx(), 1600);
  EXPECT_GT(picture.HeightPx(), 500);
  EXPECT_EQ(picture.At(400, 250, 0), 30);
  EXPECT_EQ(picture.At(1200, 250, 0), 200);
}

TEST(MatchPicture, CorrectMatchesAreBlueWrongOnesOrange) {
  const Image<uint8_t> view(200, 200, 3, 60);
  const double infinity = std::numeric_limits<double>::infinity();
  const Image<uint8_t> picture = MatchPicture(view,
                                              view,
                                              {{{Vec2d(50.5, 20.5), Vec2d(150.5, 20.5)}, 0.099},
                                               {{Vec2d(50.5, 60.5), Vec2d(150.5, 60.5)}, 0.101},
                                               {{Vec2d(50.5, 90.5), Vec2d(150.5, 90.5)}, infinity}},
                                              "title");
  for (const int x : {50, 100, 300, 350}) {
    EXPECT_TRUE(IsBlue(picture, x, 20)) << x;
    EXPECT_TRUE(IsOrange(picture, x, 60)) << x;
    EXPECT_TRUE(IsOrange(picture, x, 90)) << x;
  }
  EXPECT_FALSE(IsBlue(picture, 45, 20));
  EXPECT_FALSE(IsBlue(picture, 355, 20));
}

TEST(MatchPicture, ManyMatchesAreThinnedToStayReadable) {
  const Image<uint8_t> view(200, 200, 3, 60);
  std::vector<JudgedMatch> matches;
  for (int i = 0; i < 2000; ++i) {
    const double y_px = 200.0 * i / 2000;
    matches.push_back({{Vec2d(10.0, y_px), Vec2d(190.0, y_px)}, 0.0});
  }
  const Image<uint8_t> thinned = MatchPicture(view, view, matches, "title");
  matches.resize(200);
  const Image<uint8_t> whole = MatchPicture(view, view, matches, "title");
  // A line every tenth match, one pixel apart, against one every match, a tenth apart.
  EXPECT_TRUE(IsBlue(whole, 200, 10));
  EXPECT_TRUE(IsBlue(thinned, 10, 150));
  EXPECT_FALSE(thinned == whole);
}

}  // namespace
}  // namespace pfseq
