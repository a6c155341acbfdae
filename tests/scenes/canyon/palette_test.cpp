// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/palette.h"

#include <set>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(Palette, MaterialsAreValidAndNamedOnce) {
  const Palette palette = MakePalette();
  ASSERT_EQ(palette.materials.size(), palette.texture_size_m.size());
  std::set<std::string> names;
  for (const Material& material : palette.materials) {
    EXPECT_TRUE(names.insert(material.name).second) << material.name;
    EXPECT_LE(material.base_color.maxCoeff(), 1.0F);
    EXPECT_GT(material.roughness, 0.0F);
    EXPECT_LT(material.base_color_texture_idx, static_cast<int>(palette.textures.size()));
    EXPECT_LT(material.normal_texture_idx, static_cast<int>(palette.textures.size()));
    if (material.normal_texture_idx >= 0) {
      EXPECT_FALSE(palette.textures[static_cast<size_t>(material.normal_texture_idx)].is_srgb);
    }
  }
  const Material& glass = palette.materials[static_cast<size_t>(palette.window_glass)];
  EXPECT_LE(glass.roughness, 0.05F);
  EXPECT_EQ(glass.metallic, 0.0F);
}

TEST(Palette, ColoursAreLinear) {
  const Palette palette = MakePalette();
  // 0x2A in sRGB is 0.0232 linear.
  const Material& railing = palette.materials[static_cast<size_t>(palette.railing)];
  EXPECT_NEAR(railing.base_color[0], 0.0232, 1e-4);
}

TEST(Palette, PickReachesEveryChoice) {
  RandomStream random({1});
  std::set<int> picked;
  for (int i = 0; i < 100; ++i) {
    picked.insert(Pick({3, 5, 8}, random));
  }
  EXPECT_EQ(picked, (std::set<int>{3, 5, 8}));
}

}  // namespace
}  // namespace pfseq
