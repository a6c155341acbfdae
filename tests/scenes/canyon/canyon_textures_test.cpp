// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/canyon_textures.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Mean absolute difference of rows a and b.
double RowDifference(const Image<uint8_t>& texels, int a, int b) {
  double sum = 0.0;
  for (int x = 0; x < texels.WidthPx(); ++x) {
    sum += std::abs(texels.At(x, a, 1) - texels.At(x, b, 1));
  }
  return sum / texels.WidthPx();
}

TEST(SurfaceTextures, RepeatVerticallyAsSmoothlyAsTheyRunInside) {
  for (const SurfaceTexture& texture :
       {PlasterTexture(), ConcreteTexture(), GravelTexture(), AsphaltTexture()}) {
    const Image<uint8_t>& texels = texture.color.texels;
    const int last = texels.HeightPx() - 1;
    EXPECT_LT(RowDifference(texels, 0, last), 2.0 * RowDifference(texels, 100, 101) + 0.5)
        << texture.color.name;
  }
}

TEST(SurfaceTextures, OfOneKindAreTheSameEachTime) {
  EXPECT_EQ(RoofTileTexture().color.texels, RoofTileTexture().color.texels);
}

TEST(SurfaceTextures, NormalsAreUnitVectorsThatMostlyFaceOut) {
  const SurfaceTexture brick = BrickTexture(true);
  ASSERT_FALSE(brick.normal.texels.Empty());
  EXPECT_FALSE(brick.normal.is_srgb);
  double sum = 0.0;
  for (int y = 0; y < brick.normal.texels.HeightPx(); y += 7) {
    for (int x = 0; x < brick.normal.texels.WidthPx(); x += 7) {
      Vec3d normal;
      for (int channel = 0; channel < 3; ++channel) {
        normal[channel] = brick.normal.texels.At(x, y, channel) / 127.5 - 1.0;
      }
      EXPECT_NEAR(normal.norm(), 1.0, 0.02);
      sum += normal.z();
    }
  }
  EXPECT_GT(sum, 0.7 * 147 * 147);
}

TEST(SurfaceTextures, UpperEdgesOfBricksFaceUp) {
  // A course is 1/48 of the height: just below a joint (larger y) the surface rises towards the
  // brick's face, so its normal looks up, green above the middle.
  const SurfaceTexture brick = BrickTexture(true);
  const Image<uint8_t>& texels = brick.normal.texels;
  double upper = 0.0;
  double lower = 0.0;
  for (int course = 0; course < 48; ++course) {
    const double top = course * 1024.0 / 48.0;
    for (int x = 0; x < 1024; ++x) {
      upper += texels.At(x, static_cast<int>(top + 1.6), 1) - 127.5;
      lower += texels.At(x, static_cast<int>(top + 1024.0 / 48.0 - 1.6), 1) - 127.5;
    }
  }
  EXPECT_GT(upper, 0.0);
  EXPECT_LT(lower, 0.0);
}

}  // namespace
}  // namespace pfseq
