// SPDX-License-Identifier: Apache-2.0
#include "validator/features/pixel_convention.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(PixelConvention, OpenCvsOriginIsTheCentreOfTheFirstPixel) {
  EXPECT_EQ(PixelFromOpenCv(0.0, 0.0), Vec2d(0.5, 0.5));
  EXPECT_EQ(PixelFromOpenCv(599.5, 599.5), Vec2d(600.0, 600.0));
}

}  // namespace
}  // namespace pfseq
