// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/texture.h"

#include "renderer/core/random.h"
#include "renderer/trace/color.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Reddish noise of this size; alpha is noise as well.
Scene SceneWithNoise(int width_px, int height_px, bool is_srgb) {
  Texture texture;
  texture.is_srgb = is_srgb;
  texture.texels = Image<uint8_t>(width_px, height_px, 4);
  RandomStream random({static_cast<uint64_t>(width_px), static_cast<uint64_t>(height_px)});
  for (uint8_t& value : texture.texels.Values()) {
    value = static_cast<uint8_t>(random.Integer(0, 255));
  }
  Scene scene;
  scene.textures = {texture};
  return scene;
}

/// Mean of the decoded texels.
Rgba LinearMean(const Texture& texture) {
  Eigen::Array4d sum = Eigen::Array4d::Zero();
  for (int y = 0; y < texture.texels.HeightPx(); ++y) {
    for (int x = 0; x < texture.texels.WidthPx(); ++x) {
      for (int channel = 0; channel < 4; ++channel) {
        const float value = static_cast<float>(texture.texels.At(x, y, channel)) / 255.0F;
        sum[channel] += texture.is_srgb && channel < 3 ? LinearFromSrgb(value) : value;
      }
    }
  }
  return (sum / static_cast<double>(texture.texels.NumPixels())).cast<float>();
}

/// A footprint of these widths in texture coordinates.
Rgba Filtered(const TextureSet& textures, const Vec2f& texcoord, float width_u, float width_v) {
  return textures.LookupFiltered(0, texcoord, {width_u, 0.0F}, {0.0F, width_v});
}

TEST(TextureSet, NarrowFootprintsGiveTheTextureItself) {
  const Scene scene = SceneWithNoise(17, 9, true);
  const TextureSet textures(scene);
  RandomStream random({1});
  for (int i = 0; i < 1000; ++i) {
    const Vec2f texcoord(static_cast<float>(random.Uniform(-1.0, 2.0)),
                         static_cast<float>(random.Uniform(-1.0, 2.0)));
    const Rgba expected = textures.Lookup(0, texcoord.cast<double>());
    // Rounding of the coordinates, times 17 texels and the largest step between two.
    EXPECT_TRUE((Filtered(textures, texcoord, 0.0F, 0.0F) - expected).abs().maxCoeff() < 1e-5F);
    EXPECT_TRUE(
        (Filtered(textures, texcoord, 0.99F / 17.0F, 0.99F / 9.0F) - expected).abs().maxCoeff() <
        1e-5F);
  }
}

TEST(TextureSet, WideFootprintsGiveTheMeanInLinearLight) {
  for (const auto& [width_px, height_px] :
       {std::pair(16, 16), {1, 8}, {32, 2}, {4, 64}, {37, 23}, {3, 3}, {5, 64}}) {
    for (const bool is_srgb : {true, false}) {
      const Scene scene = SceneWithNoise(width_px, height_px, is_srgb);
      const TextureSet textures(scene);
      const Rgba mean = LinearMean(scene.textures[0]);
      const Rgba value = Filtered(textures, {0.3F, 0.8F}, 64.0F, 64.0F);
      // Half a step of 8 bit, which of bright sRGB is 2.3 times as much light.
      EXPECT_LT((value - mean).abs().maxCoeff(), 1.15F / 255.0F) << width_px << " x " << height_px;
    }
  }
}

TEST(TextureSet, FootprintOfACheckerboardIsItsMean) {
  // Squares of 4 texels in the left half, 8 in the right.
  Scene scene;
  scene.textures.resize(1);
  scene.textures[0].is_srgb = true;
  scene.textures[0].texels = Image<uint8_t>(64, 64, 4, 255);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const int side = x < 32 ? 4 : 8;
      for (int channel = 0; channel < 3; ++channel) {
        scene.textures[0].texels.At(x, y, channel) = (x / side + y / side) % 2 == 0 ? 255 : 0;
      }
    }
  }
  const TextureSet textures(scene);
  RandomStream random({2});
  for (int i = 0; i < 200; ++i) {
    const Vec2f texcoord(static_cast<float>(random.Uniform(0.15, 0.35)),
                         static_cast<float>(random.Uniform(0.0, 1.0)));
    // Half of the light, which is byte 188: a mean of bytes would give 0.21.
    EXPECT_NEAR(Filtered(textures, texcoord, 8.0F / 64.0F, 8.0F / 64.0F)[1], 0.5F, 0.01F);
    // The longer axis decides, whichever it is and whichever way it points.
    EXPECT_NEAR(Filtered(textures, texcoord, 0.0F, 8.0F / 64.0F)[1], 0.5F, 0.01F);
    EXPECT_NEAR(
        textures.LookupFiltered(0, texcoord, {-6.0F / 64.0F, 6.0F / 64.0F}, {0.0F, 0.0F})[1],
        0.5F,
        0.01F);
  }
  // Footprints as wide as a square keep the squares: at the middle of one of 8 texels.
  EXPECT_GT(Filtered(textures, {0.5625F, 0.5625F}, 4.0F / 64.0F, 4.0F / 64.0F)[1], 0.95F);
  EXPECT_LT(Filtered(textures, {0.5625F, 0.6875F}, 4.0F / 64.0F, 4.0F / 64.0F)[1], 0.05F);
}

/// Bright discs on black holes: of 32 texels, alpha 255 within 10 of the middle.
Scene SceneWithCutOutDiscs() {
  Scene scene;
  scene.textures.resize(1);
  scene.textures[0].is_srgb = true;
  scene.textures[0].texels = Image<uint8_t>(32, 32, 4);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      if (std::hypot(x - 15.5, y - 15.5) < 10.0) {
        for (int channel = 0; channel < 4; ++channel) {
          scene.textures[0].texels.At(x, y, channel) = 255;
        }
      }
    }
  }
  Material leaf;
  leaf.base_color_texture_idx = 0;
  leaf.alpha_cutoff = 0.5F;
  scene.materials = {leaf};
  return scene;
}

TEST(TextureSet, HolesDoNotDarkenWhatIsCutOutOfThem) {
  Scene scene = SceneWithCutOutDiscs();
  // What rays meet is white, from however far, and beside the holes as well.
  const auto darkest = [](const TextureSet& textures, float width) {
    float least = 1.0F;
    for (int i = 0; i < 100; ++i) {
      const Vec2f texcoord(0.005F + 0.01F * static_cast<float>(i), 0.4F);
      least = std::min(least, Filtered(textures, texcoord, width, width).head<3>().minCoeff());
    }
    return least;
  };
  for (const float width : {2.0F / 32.0F, 4.0F / 32.0F, 0.5F, 1.0F, 10.0F}) {
    EXPECT_EQ(darkest(TextureSet(scene), width), 1.0F) << width;
  }
  // A second material that shows the whole texture gets the plain mean, as does one that is not
  // masked at all.
  Material whole;
  whole.base_color_texture_idx = 0;
  scene.materials.push_back(whole);
  EXPECT_NEAR(darkest(TextureSet(scene), 10.0F), LinearMean(scene.textures[0])[0], 1.15F / 255.0F);
  scene.materials.erase(scene.materials.begin());
  EXPECT_NEAR(darkest(TextureSet(scene), 10.0F), LinearMean(scene.textures[0])[0], 1.15F / 255.0F);
}

TEST(TextureSet, BaseAlphaCountsForHoles) {
  Scene scene = SceneWithCutOutDiscs();
  // Nothing is left of the discs themselves at this alpha: all is a hole, and the mean is plain.
  scene.materials[0].base_alpha = 0.4F;
  EXPECT_NEAR(Filtered(TextureSet(scene), {0.5F, 0.5F}, 10.0F, 10.0F)[0],
              LinearMean(scene.textures[0])[0],
              1.15F / 255.0F);
}

TEST(TextureSet, FilteringGrowsWithoutJumps) {
  const Scene scene = SceneWithNoise(64, 32, true);
  const TextureSet textures(scene);
  Rgba before = Filtered(textures, {0.37F, 0.61F}, 0.5F / 64.0F, 0.0F);
  for (float width = 0.5F; width < 200.0F; width *= 1.01F) {
    const Rgba value = Filtered(textures, {0.37F, 0.61F}, width / 64.0F, 0.0F);
    EXPECT_LT((value - before).abs().maxCoeff(), 0.02F) << width;
    before = value;
  }
}

TEST(TextureSet, OneTexelIsTheSameEverywhere) {
  const Scene scene = SceneWithNoise(1, 1, true);
  const TextureSet textures(scene);
  const Rgba expected = LinearMean(scene.textures[0]);
  for (const float width : {0.0F, 0.5F, 3.0F, 1e9F}) {
    const Rgba value = Filtered(textures, {0.7F, -0.2F}, width, width);
    EXPECT_LT((value - expected).abs().maxCoeff(), 1e-6F) << width;
  }
  EXPECT_EQ(textures.MemoryBytes(), 0);
}

TEST(TextureSet, TellsTheMemoryOfItsCoarserLevels) {
  // 16 x 16: 8 x 8 + 4 x 4 + 2 x 2 + 1 texels more.
  const Scene scene = SceneWithNoise(16, 16, true);
  EXPECT_EQ(TextureSet(scene).MemoryBytes(), 4 * (64 + 16 + 4 + 1));
}

}  // namespace
}  // namespace pfseq
