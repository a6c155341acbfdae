// SPDX-License-Identifier: Apache-2.0
// Pictures on boards: shop signs, road signs, plates and posters.
#include "renderer/core/random.h"
#include "scenes/canyon/canyon_textures.h"
#include "scenes/canyon/fractal_tile.h"
#include "scenes/canyon/lettering.h"
#include "scenes/canyon/wall_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace pfseq {
namespace {

constexpr int kPictureCells = 8;
/// Rows of the atlas: signs, plates, and posters in all others.
constexpr int kSignRows = 2;
constexpr int kPlateRows = 1;

Rgb Hex(uint32_t hex) {
  return Rgb(static_cast<float>(hex >> 16 & 0xFF),
             static_cast<float>(hex >> 8 & 0xFF),
             static_cast<float>(hex & 0xFF)) /
         255.0F;
}

template <size_t N>
Rgb PickHex(const std::array<uint32_t, N>& colors, RandomStream& random) {
  return Hex(colors[static_cast<size_t>(random.Integer(0, static_cast<int>(N) - 1))]);
}

template <size_t N>
std::string_view PickWord(const std::array<std::string_view, N>& words, RandomStream& random) {
  return words[static_cast<size_t>(random.Integer(0, static_cast<int>(N) - 1))];
}

/// Dust, fading and rain marks over a finished picture.
void Age(RandomStream& random, WallCanvas& canvas) {
  const FractalTile& fractal = SharedFractal();
  const double grain = 1.5 * canvas.TexelM();
  const uint64_t offset = random.Bits() % 307;
  canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& point_m) {
    const double broad = fractal.At(point_m.x(), point_m.y(), 4.0 * grain, offset);
    const double run = fractal.At(point_m.x(), 0.1 * point_m.y(), grain, offset + 9);
    texel.color = texel.color * static_cast<float>(1.0 + 0.04 * broad);
    texel.dirt = static_cast<float>(std::clamp(0.06 + 0.06 * broad + 0.07 * run, 0.0, 0.4));
  });
}

void CopyInto(const WallCanvas& canvas, int left_px, int top_px, Image<uint8_t>& texels) {
  const Texture cell = canvas.Finish("cell", 8).color;
  for (int y = 0; y < cell.texels.HeightPx(); ++y) {
    for (int x = 0; x < cell.texels.WidthPx(); ++x) {
      for (int channel = 0; channel < 4; ++channel) {
        texels.At(left_px + x, top_px + y, channel) = cell.texels.At(x, y, channel);
      }
    }
  }
}

/// A board of 8 x 1.
void PaintShopSign(std::string_view text, RandomStream& random, WallCanvas& canvas) {
  constexpr std::array<uint32_t, 10> kBoards = {0x24382E,
                                                0x611717,
                                                0x1A2447,
                                                0x1F1F1F,
                                                0xDBD4BD,
                                                0x4D331F,
                                                0xCC9E2E,
                                                0xF0EEE8,
                                                0x2F5D7C,
                                                0x7A2A4E};
  const Rgb ground = PickHex(kBoards, random);
  const bool is_dark = ground.mean() < 0.5F;
  const Rgb ink = is_dark ? (random.Chance(0.3) ? Hex(0xD9B24C) : Hex(0xEDE8D8))
                          : Hex(random.Chance(0.5) ? 0x1C1A1A : 0x7A1B22);
  canvas.Rect({0, 0}, {8, 1}, ground, 1.0);
  if (random.Chance(0.6)) {
    for (const double y : {0.07, 0.93}) {
      canvas.Line({0.08, y}, {7.92, y}, 0.025, ink, 0.8);
    }
    for (const double x : {0.08, 7.92}) {
      canvas.Line({x, 0.07}, {x, 0.93}, 0.025, ink, 0.8);
    }
  }
  const double weight = random.Uniform(0.11, 0.24);
  const bool has_line = random.Chance(0.35);
  const double foot = has_line ? 0.38 : 0.22;
  // A drop shadow, as raised letters throw it.
  DrawText(text,
           {0.9 + 0.03, foot - 0.03},
           {6.2, has_line ? 0.48 : 0.56},
           weight,
           ground * 0.45F,
           canvas);
  DrawText(text, {0.9, foot}, {6.2, has_line ? 0.48 : 0.56}, weight, ink, canvas);
  if (has_line) {
    constexpr std::array<std::string_view, 6> kLines = {
        "SINCE 1898", "TEL 01 45 20 71", "FINE GOODS", "AND SONS", "OPEN ALL DAY", "NO 12"};
    DrawText(PickWord(kLines, random), {2.0, 0.14}, {4.0, 0.15}, 0.14, ink, canvas);
  }
  Age(random, canvas);
}

void PaintDisc(const Vec2d& center, double radius, const Rgb& color, WallCanvas& canvas) {
  canvas.Line(center, center, 2.0 * radius, color, 1.0);
}

/// A square plate of 1 x 1 with what drivers should know.
void PaintRoadSign(RandomStream& random, WallCanvas& canvas) {
  const Rgb white = Hex(0xEDEDE8);
  const Rgb red = Hex(0xB51E1E);
  const Rgb blue = Hex(0x1C4C96);
  const Vec2d middle(0.5, 0.5);
  canvas.Rect({0, 0}, {1, 1}, white, 1.0);
  switch (random.Integer(0, 5)) {
    case 0:  // speed
      PaintDisc(middle, 0.45, red, canvas);
      PaintDisc(middle, 0.34, white, canvas);
      DrawText(random.Chance(0.5) ? "30" : "50",
               {0.24, 0.32},
               {0.52, 0.36},
               0.18,
               Hex(0x151515),
               canvas);
      break;
    case 1:  // no stopping
      PaintDisc(middle, 0.45, red, canvas);
      PaintDisc(middle, 0.36, blue, canvas);
      canvas.Line({0.22, 0.22}, {0.78, 0.78}, 0.09, red, 1.0);
      if (random.Chance(0.5)) {
        canvas.Line({0.78, 0.22}, {0.22, 0.78}, 0.09, red, 1.0);
      }
      break;
    case 2:  // parking
      canvas.Rect({0.04, 0.04}, {0.96, 0.96}, blue, 1.0);
      DrawText("P", {0.25, 0.2}, {0.5, 0.6}, 0.2, white, canvas);
      break;
    case 3:  // no entry
      PaintDisc(middle, 0.46, red, canvas);
      canvas.Rect({0.18, 0.42}, {0.82, 0.58}, white, 1.0);
      break;
    case 4:  // one way
      canvas.Rect({0.04, 0.04}, {0.96, 0.96}, blue, 1.0);
      canvas.Line({0.2, 0.5}, {0.75, 0.5}, 0.13, white, 1.0);
      canvas.Line({0.55, 0.72}, {0.8, 0.5}, 0.12, white, 1.0);
      canvas.Line({0.55, 0.28}, {0.8, 0.5}, 0.12, white, 1.0);
      break;
    default:  // give way
      canvas.Line({0.12, 0.84}, {0.88, 0.84}, 0.12, red, 1.0);
      canvas.Line({0.12, 0.84}, {0.5, 0.16}, 0.12, red, 1.0);
      canvas.Line({0.88, 0.84}, {0.5, 0.16}, 0.12, red, 1.0);
      break;
  }
  Age(random, canvas);
}

void PaintPlate(RandomStream& random, WallCanvas& canvas) {
  constexpr std::array<std::string_view, 8> kWords = {"STATION",
                                                      "MARKET SQ",
                                                      "HARBOUR",
                                                      "MILL LANE",
                                                      "8 TO 18 H",
                                                      "MUSEUM",
                                                      "NORTH ST",
                                                      "EXCEPT BUS"};
  const bool is_blue = random.Chance(0.5);
  canvas.Rect({0, 0}, {1, 1}, is_blue ? Hex(0x1B3F7E) : Hex(0xE9E7DF), 1.0);
  const Rgb ink = is_blue ? Hex(0xEEEEEA) : Hex(0x1A1A1A);
  DrawText(PickWord(kWords, random), {0.08, 0.52}, {0.84, 0.3}, 0.17, ink, canvas);
  DrawText(PickWord(kWords, random), {0.08, 0.14}, {0.84, 0.26}, 0.15, ink, canvas);
  Age(random, canvas);
}

void PaintBill(RandomStream& random, WallCanvas& canvas) {
  constexpr std::array<uint32_t, 12> kInks = {0xB8322A,
                                              0x1F3F77,
                                              0xE0B030,
                                              0x22201F,
                                              0xEDE8DA,
                                              0x2D6B4A,
                                              0xD9682B,
                                              0x6A2E70,
                                              0x4A9AB8,
                                              0xD8B9A0,
                                              0x8C1C3C,
                                              0xBFC7C9};
  constexpr std::array<std::string_view, 12> kTitles = {"CINEMA",
                                                        "JAZZ 24",
                                                        "OPERA",
                                                        "SALE",
                                                        "CIRCUS",
                                                        "FESTIVAL",
                                                        "COLA",
                                                        "RADIO 5",
                                                        "VOTE",
                                                        "EXPO",
                                                        "TOUR",
                                                        "SUMMER"};
  const Rgb ground = PickHex(kInks, random);
  canvas.Rect({0, 0}, {1, 1}, ground, 1.0);
  // A picture of overlapping forms, lighter from one side.
  for (int i = 0; i < 14; ++i) {
    const Vec2d at(random.Uniform(0.05, 0.95), random.Uniform(0.3, 0.95));
    const Rgb ink = PickHex(kInks, random);
    if (random.Chance(0.5)) {
      PaintDisc(at, random.Uniform(0.02, 0.16), ink, canvas);
    } else {
      canvas.Line(at,
                  at + Vec2d(random.Uniform(-0.4, 0.4), random.Uniform(-0.3, 0.3)),
                  random.Uniform(0.01, 0.12),
                  ink,
                  0.95);
    }
  }
  const Rgb ink = ground.mean() > 0.5F ? Hex(0x161616) : Hex(0xF2EEE2);
  canvas.Rect({0, 0}, {1, 0.28}, ground, 0.9);
  DrawText(PickWord(kTitles, random), {0.06, 0.13}, {0.88, 0.14}, 0.2, ink, canvas);
  for (int line = 0; line < 2; ++line) {
    DrawText(PickWord(kTitles, random), {0.1, 0.07 - 0.045 * line}, {0.6, 0.03}, 0.16, ink, canvas);
  }
  canvas.Line({0.015, 0.015}, {0.985, 0.015}, 0.03, Hex(0xDCD8CC), 1.0);
  Age(random, canvas);
}

}  // namespace

Texture SignAtlas() {
  constexpr std::array<std::string_view, 32> kWords = {
      "BAKERY",   "CAFE",     "BOOKS",  "PHARMACY", "FLOWERS",  "WINE BAR", "HAIR",    "TAILOR",
      "OPTICIAN", "SHOES",    "MARKET", "HOTEL",    "DELI",     "GALLERY",  "MUSIC",   "BICYCLES",
      "BISTRO",   "JEWELLER", "CLINIC", "ANTIQUES", "TEA ROOM", "HARDWARE", "TOYS",    "FABRICS",
      "BANK",     "COFFEE",   "PRINTS", "BUTCHER",  "CHEESE",   "TRAVEL",   "LAUNDRY", "BARBER"};
  constexpr int kHeight_px = 64;
  Texture atlas{"signs",
                Image<uint8_t>(8 * kHeight_px * kSignAtlasColumns, kHeight_px * kSignAtlasRows, 4),
                true};
  for (int i = 0; i < kSignAtlasRows * kSignAtlasColumns; ++i) {
    RandomStream random({203, static_cast<uint64_t>(i)});
    WallCanvas canvas({0, 0}, {8, 1}, 1.0 / kHeight_px);
    PaintShopSign(kWords[static_cast<size_t>(i)], random, canvas);
    CopyInto(canvas,
             i % kSignAtlasColumns * 8 * kHeight_px,
             i / kSignAtlasColumns * kHeight_px,
             atlas.texels);
  }
  return atlas;
}

Texture StreetPictureAtlas() {
  constexpr int kCell_px = 128;
  Texture atlas{"street_pictures",
                Image<uint8_t>(kPictureCells * kCell_px, kPictureCells * kCell_px, 4),
                true};
  for (int i = 0; i < kPictureCells * kPictureCells; ++i) {
    RandomStream random({205, static_cast<uint64_t>(i)});
    WallCanvas canvas({0, 0}, {1, 1}, 1.0 / kCell_px);
    const int row = i / kPictureCells;
    if (row < kSignRows) {
      PaintRoadSign(random, canvas);
    } else if (row < kSignRows + kPlateRows) {
      PaintPlate(random, canvas);
    } else {
      PaintBill(random, canvas);
    }
    CopyInto(canvas, i % kPictureCells * kCell_px, row * kCell_px, atlas.texels);
  }
  return atlas;
}

TextureWindow StreetPictureCell(StreetPicture kind, RandomStream& random) {
  constexpr double kRim = 0.01;
  const int first = kind == StreetPicture::kSign    ? 0
                    : kind == StreetPicture::kPlate ? kSignRows
                                                    : kSignRows + kPlateRows;
  const int last = kind == StreetPicture::kSign    ? kSignRows - 1
                   : kind == StreetPicture::kPlate ? kSignRows + kPlateRows - 1
                                                   : kPictureCells - 1;
  const int column = random.Integer(0, kPictureCells - 1);
  const int row = random.Integer(first, last);
  constexpr double kSize = 1.0 / kPictureCells;
  return TextureWindow{column * kSize, row * kSize, (column + 1) * kSize, (row + 1) * kSize}.Part(
      kRim, kRim, 1.0 - kRim, 1.0 - kRim);
}

}  // namespace pfseq
