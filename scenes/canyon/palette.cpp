// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/palette.h"

#include "renderer/core/check.h"
#include "renderer/trace/color.h"
#include "scenes/canyon/canyon_textures.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// 0xRRGGBB.
Rgb ColorOf(uint32_t hex) {
  const auto linear = [&](int shift) {
    return LinearFromSrgb(static_cast<float>(hex >> shift & 0xFF) / 255.0F);
  };
  return {linear(16), linear(8), linear(0)};
}

/// Textures of a surface in the scene.
struct Skin {
  int color_idx = -1;
  int normal_idx = -1;
  double size_m = 1.0;
};

class PaletteMaker {
 public:
  Skin Add(SurfaceTexture surface) {
    Skin skin;
    skin.size_m = surface.size_m;
    skin.color_idx = Add(std::move(surface.color));
    if (!surface.normal.texels.Empty()) {
      skin.normal_idx = Add(std::move(surface.normal));
    }
    return skin;
  }

  int Add(Texture texture) {
    palette_.textures.push_back(std::move(texture));
    return static_cast<int>(palette_.textures.size()) - 1;
  }

  int Add(const std::string& name,
          uint32_t hex,
          const Skin& skin,
          float roughness,
          float metallic = 0.0F) {
    Material material;
    material.name = name;
    material.base_color = ColorOf(hex);
    material.base_color_texture_idx = skin.color_idx;
    material.normal_texture_idx = skin.normal_idx;
    material.roughness = roughness;
    material.metallic = metallic;
    palette_.materials.push_back(material);
    palette_.texture_size_m.push_back(skin.size_m);
    return static_cast<int>(palette_.materials.size()) - 1;
  }

  std::vector<int> AddAll(const std::string& name,
                          std::initializer_list<uint32_t> colors,
                          const Skin& skin,
                          float roughness,
                          float metallic = 0.0F) {
    std::vector<int> indices;
    for (const uint32_t hex : colors) {
      indices.push_back(
          Add(fmt::format("{}_{}", name, indices.size()), hex, skin, roughness, metallic));
    }
    return indices;
  }

  Palette& Result() { return palette_; }

 private:
  Palette palette_;
};

void AddWalls(PaletteMaker& maker) {
  Palette& palette = maker.Result();
  const Skin plaster = maker.Add(PlasterTexture());
  const Skin trim = maker.Add(TrimTexture());
  palette.plaster = maker.AddAll("plaster",
                                 {0xF3EAD2,
                                  0xEFDDB4,
                                  0xE6C78F,
                                  0xD9B98C,
                                  0xE9D3C0,
                                  0xF2EFE8,
                                  0xD8D4CA,
                                  0xC9CDC9,
                                  0xDCC0AC,
                                  0xCFC6A8},
                                 plaster,
                                 0.95F);
  palette.blank_wall = maker.AddAll("render", {0xC9C2B4, 0xD6CDBB, 0xB4AFA6}, plaster, 0.95F);
  palette.trim = maker.AddAll("trim", {0xF0E9DA, 0xDDD3BE, 0xCFC8BA, 0xB9B2A4}, trim, 0.85F);
  const Skin red_brick = maker.Add(BrickTexture(true));
  Skin buff_brick = maker.Add(BrickTexture(false));
  palette.brick = maker.AddAll("brick_red", {0xFFFFFF, 0xE6D2C8, 0xF0DCC0}, red_brick, 0.9F);
  for (const int idx : maker.AddAll("brick_buff", {0xFFFFFF, 0xE8DCCB}, buff_brick, 0.9F)) {
    palette.brick.push_back(idx);
  }
  const Skin ashlar = maker.Add(AshlarTexture());
  palette.ashlar = maker.AddAll("ashlar", {0xF5EBD6, 0xEADFC6, 0xDDD6C8, 0xE8D6B8}, ashlar, 0.85F);
  const Skin concrete = maker.Add(ConcreteTexture());
  palette.concrete =
      maker.AddAll("concrete", {0xCFCBC2, 0xB9B8B3, 0xDAD2C0, 0xE4E1DA}, concrete, 0.9F);
  palette.coping = maker.Add("coping", 0xBDB9B0, concrete, 0.9F);
  const auto made_of = [&](const std::vector<int>& walls, WallSurface surface) {
    for (const int wall : walls) {
      palette.wall_surface[wall] = surface;
    }
  };
  made_of(palette.plaster, WallSurface::kPlaster);
  made_of(palette.trim, WallSurface::kPlaster);
  made_of(palette.brick, WallSurface::kBrick);
  made_of(palette.ashlar, WallSurface::kAshlar);
  made_of(palette.concrete, WallSurface::kConcrete);
}

void AddOpenings(PaletteMaker& maker) {
  Palette& palette = maker.Result();
  const Skin plain;
  palette.window_frame =
      maker.AddAll("frame", {0xF2F0EA, 0xE8E4DA, 0x5A4A3C, 0x3C4A42, 0x4A4C50}, plain, 0.4F);
  const Skin wood = maker.Add(WoodTexture());
  palette.door =
      maker.AddAll("door", {0x5C3A24, 0x27402F, 0x6E1F22, 0x24324A, 0x8A6A48}, wood, 0.5F);
  const Skin slat = maker.Add(SlatTexture());
  palette.shutter = maker.AddAll("shutter", {0x4F6B57, 0xB8B4A8, 0x6B4A36, 0x5F7480}, slat, 0.7F);
  palette.roller_blind = maker.Add("roller_blind", 0xDCDAD2, slat, 0.6F);
  palette.awning = maker.AddAll("awning", {0x8E2A2A, 0x2E4F3C, 0xD8CBA8, 0x2F3F63}, plain, 0.9F);
  palette.shop_front =
      maker.AddAll("shop_front", {0x2E3A34, 0x5A2624, 0x2B2D33, 0xD9D2C2, 0x6C4B30}, plain, 0.45F);
  palette.spandrel = maker.AddAll("spandrel", {0x4A5A62, 0x6E7A7C, 0x2E3438}, plain, 0.08F);
  palette.window_glass =
      maker.Add("window_glass", 0xE0E6E4, {maker.Add(WindowAtlas(false)), -1, 1.0}, 0.03F);
  palette.window_framed =
      maker.Add("window_framed", 0xE0E6E4, {maker.Add(WindowAtlas(true)), -1, 1.0}, 0.05F);
  palette.shop_glass = maker.Add("shop_glass", 0xE8ECEA, {maker.Add(ShopAtlas()), -1, 1.0}, 0.02F);
  palette.sign = maker.Add("sign", 0xFFFFFF, {maker.Add(SignAtlas()), -1, 1.0}, 0.6F);
  palette.facade_glass = maker.Add(
      "facade_glass",
      0xC4D4D8,
      {palette.materials[static_cast<size_t>(palette.window_glass)].base_color_texture_idx,
       -1,
       1.0},
      0.02F);
  palette.curtain_wall =
      maker.Add("curtain_wall", 0xFFFFFF, {maker.Add(CurtainWallTexture()), -1, 6.0}, 0.05F);
}

void AddRoofsAndMetal(PaletteMaker& maker) {
  Palette& palette = maker.Result();
  const Skin plain;
  palette.roof_tile = maker.AddAll(
      "roof_tile", {0xFFF4EA, 0xD8C4B8, 0xE8B8A0}, maker.Add(RoofTileTexture()), 0.85F);
  palette.slate = maker.AddAll("slate", {0xFFFFFF, 0xE0E6EE}, maker.Add(SlateTexture()), 0.55F);
  palette.roof_metal =
      maker.Add("roof_metal", 0xE8ECEE, maker.Add(SeamedMetalTexture()), 0.45F, 0.6F);
  palette.roof_gravel = maker.Add("roof_gravel", 0xFFFFFF, maker.Add(GravelTexture()), 1.0F);
  palette.chimney_pot = maker.Add("chimney_pot", 0xB4633F, plain, 0.9F);
  palette.railing = maker.Add("railing", 0x2A2B2D, plain, 0.45F, 0.3F);
  palette.pale_metal = maker.Add("pale_metal", 0xB8BCBE, plain, 0.35F, 0.9F);
  palette.gutter = maker.Add("gutter", 0x8C9296, plain, 0.5F, 0.7F);
}

void AddGround(PaletteMaker& maker) {
  Palette& palette = maker.Result();
  const Skin plain;
  palette.asphalt = maker.Add("asphalt", 0xFFFFFF, maker.Add(AsphaltTexture()), 0.92F);
  palette.pavement = maker.Add("pavement", 0xF4F0EA, maker.Add(PavementTexture()), 0.9F);
  palette.kerb = maker.Add("kerb", 0xA9A59E, plain, 0.85F);
  palette.marking = maker.Add("marking", 0xDADAD4, plain, 0.7F);
  palette.manhole = maker.Add("manhole", 0x3A3836, plain, 0.5F, 0.6F);
}

void AddStreetLife(PaletteMaker& maker) {
  Palette& palette = maker.Result();
  const Skin plain;
  palette.car_paint =
      maker.AddAll("car_paint",
                   {0xD9DADB, 0x1E2023, 0x7D8286, 0x1F3050, 0x6B1A1C, 0xE8E6E0, 0x4A5A50},
                   plain,
                   0.22F);
  palette.cloth =
      maker.AddAll("cloth",
                   {0x1D2230, 0x2E2A28, 0x6E2A2E, 0x3C5068, 0x8A7A60, 0xC9C4B8, 0x3A4A38, 0xB48A30},
                   plain,
                   0.95F);
  palette.leaf = maker.AddAll("leaf", {0x4F6B2A, 0x5E7A30, 0x3F5A2C, 0x77803A}, plain, 0.6F);
  palette.bloom = maker.AddAll("leaf_bloom", {0xC02A3A, 0xE8C040, 0xD878A0}, plain, 0.7F);
  palette.car_glass = maker.Add("car_glass", 0x1C2224, plain, 0.03F);
  palette.tyre = maker.Add("tyre", 0x1B1B1B, plain, 0.8F);
  palette.tail_lamp = maker.Add("tail_lamp", 0x9A1414, plain, 0.2F);
  palette.head_lamp = maker.Add("head_lamp", 0xE4E6E2, plain, 0.15F);
  palette.signal_green = maker.Add("signal_green", 0x2FA06A, plain, 0.3F);
  palette.skin = maker.Add("skin", 0xB98A6C, plain, 0.7F);
  palette.bark = maker.Add("bark", 0x5A5046, plain, 0.95F);
  palette.wire = maker.Add("wire", 0x161616, plain, 0.6F);
  palette.street_picture =
      maker.Add("street_picture", 0xFFFFFF, {maker.Add(StreetPictureAtlas()), -1, 1.0}, 0.4F);
}

}  // namespace

Palette MakePalette() {
  PaletteMaker maker;
  AddWalls(maker);
  AddOpenings(maker);
  AddRoofsAndMetal(maker);
  AddGround(maker);
  AddStreetLife(maker);
  return std::move(maker.Result());
}

int Pick(const std::vector<int>& choices, RandomStream& random) {
  PFSEQ_CHECK(!choices.empty());
  return choices[static_cast<size_t>(random.Integer(0, static_cast<int>(choices.size()) - 1))];
}

}  // namespace pfseq
