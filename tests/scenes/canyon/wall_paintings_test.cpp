// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_paintings.h"

#include "tests/scenes/canyon/canyon_test_support.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

class WallPaintingsTest : public testing::Test {
 protected:
  Material& MaterialOf(int idx) { return palette_.materials.at(static_cast<size_t>(idx)); }

  PartBench bench_;
  Palette& palette_ = bench_.palette;
  WallPaintings paintings_{palette_, 0.012};
};

TEST_F(WallPaintingsTest, WallsLookLikeTheMeanOfTheirMaterial) {
  const int plain = palette_.ashlar[0];
  MaterialOf(plain).base_color = Rgb(1.0F, 0.5F, 0.0F);
  // Half grey, half black: the mean is one of light, not of codes.
  Texture halves = {"halves", Image<uint8_t>(70, 50, 4, uint8_t{0}), true};
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 35; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        halves.texels.At(x, y, channel) = 188;
      }
    }
  }
  palette_.textures = {{}, halves};
  const int textured = palette_.brick[1];
  MaterialOf(textured).base_color = Rgb(1.0F, 0.5F, 0.0F);
  MaterialOf(textured).base_color_texture_idx = 1;
  for (int again = 0; again < 2; ++again) {
    EXPECT_TRUE(paintings_.LookOf(plain, 1, 0.5).color.isApprox(Rgb(1.0F, 0.7354F, 0.0F), 1e-3F));
    EXPECT_TRUE(
        paintings_.LookOf(textured, 1, 0.5).color.isApprox(Rgb(0.5385F, 0.3896F, 0.0F), 1e-3F));
  }
}

TEST_F(WallPaintingsTest, WallsAreOfTheirPalettesSurfaceElsePlaster) {
  palette_.wall_surface[palette_.brick[0]] = WallSurface::kBrick;
  const WallLook brick = paintings_.LookOf(palette_.brick[0], 17, 0.25);
  EXPECT_EQ(brick.surface, WallSurface::kBrick);
  EXPECT_EQ(brick.seed, 17U);
  EXPECT_EQ(brick.age, 0.25);
  EXPECT_EQ(paintings_.LookOf(palette_.trim[0], 17, 0.25).surface, WallSurface::kPlaster);
}

/// A part of a front of 3 x 2 m in texels of half a metre.
WallPainting Coarse(WallSurface surface) {
  WallPainting painting;
  painting.look.surface = surface;
  painting.look.seed = 3;
  painting.area = {{2.0, 3.0}, {5.0, 5.0}};
  painting.texel_m = 0.5;
  return painting;
}

TEST_F(WallPaintingsTest, CornersOfTheAreaLieInTheMiddleOfTheOutermostTexels) {
  // To the east of a street along Y: its right is -Y.
  const SurfaceFrame facade = {{10.0, 20.0, 0.7}, -Vec3d::UnitY(), Vec3d::UnitZ(), -Vec3d::UnitX()};
  const WallPainting painting = Coarse(WallSurface::kPlaster);
  const int idx = paintings_.Add(bench_.builder, facade, palette_.plaster[0], painting);
  bench_.builder.SetTextureOffset({0.3, 0.4});
  bench_.builder.Rectangle(idx, facade, painting.area.low_m, painting.area.high_m, 0.0);
  paintings_.Finish(palette_);
  const Scene scene = PartOf(bench_.TakeScene(), idx);
  ASSERT_EQ(scene.meshes.size(), 1U);
  const std::vector<Vec2f>& texcoords = scene.meshes[0].texcoords;
  ASSERT_EQ(texcoords.size(), 4U);
  // 6 x 4 texels; v runs down.
  const Vec2f low(0.5F / 6.0F, 3.5F / 4.0F);
  const Vec2f high(5.5F / 6.0F, 0.5F / 4.0F);
  EXPECT_TRUE(texcoords[0].isApprox(low, 1e-4F)) << texcoords[0].transpose();
  EXPECT_TRUE(texcoords[2].isApprox(high, 1e-4F)) << texcoords[2].transpose();
}

TEST_F(WallPaintingsTest, OrdersGetTheNextMaterialsAndAreFinishedInTurn) {
  const int wall = palette_.concrete[1];
  MaterialOf(wall).ior = 1.3F;
  MaterialOf(wall).base_color = Rgb::Constant(0.3F);
  palette_.textures.resize(2);
  const size_t num_before = palette_.materials.size();
  std::vector<WallPainting> orders = {Coarse(WallSurface::kBrick), Coarse(WallSurface::kConcrete)};
  for (size_t i = 0; i < orders.size(); ++i) {
    EXPECT_EQ(paintings_.Add(bench_.builder, SurfaceFrame(), wall, orders[i]),
              static_cast<int>(num_before + i));
  }
  EXPECT_EQ(palette_.materials.size(), num_before);
  paintings_.Finish(palette_);
  ASSERT_EQ(palette_.materials.size(), num_before + 2);
  ASSERT_EQ(palette_.textures.size(), 2U + 2U * 3U);
  for (size_t i = 0; i < orders.size(); ++i) {
    const Material& material = palette_.materials[num_before + i];
    const std::string order = "wall_" + std::to_string(i);
    EXPECT_EQ(material.name, "concrete_" + order);
    EXPECT_EQ(material.ior, 1.3F);
    // Textures tell all.
    EXPECT_TRUE((material.base_color == 1.0F).all());
    EXPECT_EQ(material.roughness, 1.0F);
    orders[i].name = order;
    const PaintedWall painted = Paint(orders[i]);
    const auto expect_texture = [&](int idx, const Texture& expected) {
      const Texture& texture = palette_.textures.at(static_cast<size_t>(idx));
      EXPECT_EQ(texture.name, expected.name);
      EXPECT_EQ(texture.texels, expected.texels);
      EXPECT_EQ(texture.is_srgb, expected.is_srgb);
    };
    expect_texture(material.base_color_texture_idx, painted.color);
    expect_texture(material.normal_texture_idx, painted.normal);
    expect_texture(material.metallic_roughness_texture_idx, painted.roughness);
  }
}

}  // namespace
}  // namespace pfseq
