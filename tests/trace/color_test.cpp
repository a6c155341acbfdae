// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/color.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(Srgb, KnownValues) {
  EXPECT_NEAR(LinearFromSrgb(0.5F), 0.21404F, 1e-5F);
  EXPECT_NEAR(LinearFromSrgb(0.04F), 0.04F / 12.92F, 1e-7F);
  EXPECT_NEAR(SrgbFromLinear(0.18F), 0.46136F, 1e-5F);
  EXPECT_EQ(LinearFromSrgb(0.0F), 0.0F);
  EXPECT_NEAR(LinearFromSrgb(1.0F), 1.0F, 1e-6F);
}

TEST(Srgb, EncodingIsInverseForEachByte) {
  for (int i = 0; i < 256; ++i) {
    const float encoded = static_cast<float>(i) / 255.0F;
    EXPECT_NEAR(SrgbFromLinear(LinearFromSrgb(encoded)), encoded, 2e-6F) << i;
  }
}

TEST(RgbFromXyz, WhiteIsWhiteAndLuminanceStays) {
  const Rgb white = RgbFromXyz(Vec3d(0.95047, 1.0, 1.08883));
  EXPECT_NEAR(white[0], 1.0F, 1e-4F);
  EXPECT_NEAR(white[1], 1.0F, 1e-4F);
  EXPECT_NEAR(white[2], 1.0F, 1e-4F);
  // The primaries of ITU-R BT.709: red has x = 0.64, y = 0.33.
  const Rgb red = RgbFromXyz(Vec3d(0.64 / 0.33, 1.0, 0.03 / 0.33));
  EXPECT_NEAR(red[0], 1.0F / 0.2126F, 2e-3F);
  EXPECT_NEAR(red[1], 0.0F, 2e-3F);
  EXPECT_NEAR(red[2], 0.0F, 2e-3F);
  EXPECT_NEAR(Luminance(RgbFromXyz(Vec3d(0.3, 0.7, 1.4))), 0.7F, 3e-4F);
}

}  // namespace
}  // namespace pfseq
