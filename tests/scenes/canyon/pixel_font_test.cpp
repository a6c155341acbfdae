// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/pixel_font.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

std::string Drawn(char letter) {
  std::string pixels;
  for (int row = 0; row < kFontRows; ++row) {
    for (int column = 0; column < kFontColumns; ++column) {
      pixels += FontPixel(letter, column, row) ? '#' : '.';
    }
  }
  return pixels;
}

TEST(PixelFont, LettersDiffer) {
  std::set<std::string> shapes;
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    EXPECT_TRUE(shapes.insert(Drawn(letter)).second) << letter;
  }
}

TEST(PixelFont, LIsUprightAndNotMirrored) {
  EXPECT_EQ(Drawn('L'), "#....#....#....#....#....#....#####");
}

TEST(PixelFont, EverythingElseIsBlank) {
  EXPECT_EQ(Drawn(' '), std::string(35, '.'));
  EXPECT_FALSE(FontPixel('A', -1, 0));
  EXPECT_FALSE(FontPixel('A', 0, 7));
}

}  // namespace
}  // namespace pfseq
