// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/texture.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Four columns, two rows; red is 10 * (column + 1), green 100 * row, blue 255, alpha 128.
Scene SceneWithTexture(bool is_srgb) {
  Texture texture;
  texture.is_srgb = is_srgb;
  texture.texels = Image<uint8_t>(4, 2, 4);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      texture.texels.At(x, y, 0) = static_cast<uint8_t>(10 * (x + 1));
      texture.texels.At(x, y, 1) = static_cast<uint8_t>(100 * y);
      texture.texels.At(x, y, 2) = 255;
      texture.texels.At(x, y, 3) = 128;
    }
  }
  Scene scene;
  scene.textures = {texture};
  return scene;
}

TEST(TextureSet, TexelsAreExactAtTheirCentres) {
  const Scene scene = SceneWithTexture(false);
  const TextureSet textures(scene);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      const Rgba value = textures.Lookup(0, {(x + 0.5) / 4.0, (y + 0.5) / 2.0});
      EXPECT_EQ(value[0], static_cast<float>(10 * (x + 1)) / 255.0F);
      EXPECT_EQ(value[1], static_cast<float>(100 * y) / 255.0F);
      EXPECT_EQ(value[2], 1.0F);
      EXPECT_EQ(value[3], 128.0F / 255.0F);
    }
  }
}

TEST(TextureSet, FirstRowIsAtTheTopOfTextureSpace) {
  const Scene scene = SceneWithTexture(false);
  const TextureSet textures(scene);
  EXPECT_EQ(textures.Lookup(0, {0.125, 0.25})[1], 0.0F);
  EXPECT_EQ(textures.Lookup(0, {0.125, 0.75})[1], 100.0F / 255.0F);
}

TEST(TextureSet, InterpolatesBetweenCentres) {
  const Scene scene = SceneWithTexture(false);
  const TextureSet textures(scene);
  // A quarter of the way from column 1 to column 2, three quarters from row 0 to row 1.
  const Rgba value = textures.Lookup(0, {1.75 / 4.0, 1.25 / 2.0});
  EXPECT_NEAR(value[0], 22.5F / 255.0F, 1e-6F);
  EXPECT_NEAR(value[1], 75.0F / 255.0F, 1e-6F);
}

TEST(TextureSet, RepeatsInBothDirections) {
  const Scene scene = SceneWithTexture(false);
  const TextureSet textures(scene);
  // At the seam the last and the first column mix.
  EXPECT_NEAR(textures.Lookup(0, {0.0, 0.25})[0], 25.0F / 255.0F, 1e-6F);
  EXPECT_NEAR(textures.Lookup(0, {1.0, 0.25})[0], 25.0F / 255.0F, 1e-6F);
  EXPECT_NEAR(textures.Lookup(0, {0.3, 0.0})[1], 50.0F / 255.0F, 1e-6F);
  for (const double shift : {-3.0, -1.0, 1.0, 250.0}) {
    const Rgba expected = textures.Lookup(0, {0.3, 0.6});
    EXPECT_TRUE(textures.Lookup(0, {0.3 + shift, 0.6}).isApprox(expected, 1e-5F)) << shift;
    EXPECT_TRUE(textures.Lookup(0, {0.3, 0.6 + shift}).isApprox(expected, 1e-5F)) << shift;
  }
  EXPECT_NEAR(textures.Lookup(0, {-1e-18, 0.25})[0], 25.0F / 255.0F, 1e-6F);
}

TEST(TextureSet, DecodesColourBeforeFilteringAndNeverAlpha) {
  const Scene scene = SceneWithTexture(true);
  const TextureSet textures(scene);
  // IEC 61966-2-1: byte 100 is 0.127438 of full light.
  const Rgba between_rows = textures.Lookup(0, {0.125, 0.5});
  EXPECT_NEAR(between_rows[1], 0.127438F / 2.0F, 1e-5F);
  EXPECT_NEAR(between_rows[2], 1.0F, 1e-6F);
  EXPECT_NEAR(between_rows[3], 128.0F / 255.0F, 1e-6F);
}

}  // namespace
}  // namespace pfseq
