// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/canyon_textures.h"

#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "scenes/canyon/texture_noise.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace pfseq {
namespace {

/// sRGB-encoded colour and height of a surface at a point.
struct SurfacePoint {
  Rgb color = Rgb::Ones();
  double height_m = 0.0;
};

/// (x, y) in the unit square, y downwards.
using Surface = std::function<SurfacePoint(double x, double y)>;

uint8_t ByteOf(double value) {
  return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0));
}

void SetTexel(const Rgb& color, int x, int y, Image<uint8_t>& texels) {
  for (int channel = 0; channel < 3; ++channel) {
    texels.At(x, y, channel) = ByteOf(color[channel]);
  }
  texels.At(x, y, 3) = 255;
}

/// The tangent-space normals of a height field of size_m x size_m, green up.
Texture NormalMap(const std::string& name,
                  const std::vector<double>& height_m,
                  int size_px,
                  double size_m) {
  Texture map{name + "_normal", Image<uint8_t>(size_px, size_px, 4), false};
  const double spacing_m = 2.0 * size_m / size_px;
  const auto height = [&](int x, int y) {
    const int column = (x + size_px) % size_px;
    const int row = (y + size_px) % size_px;
    return height_m[static_cast<size_t>(row) * static_cast<size_t>(size_px) +
                    static_cast<size_t>(column)];
  };
  for (int y = 0; y < size_px; ++y) {
    for (int x = 0; x < size_px; ++x) {
      // Rows run down, the bitangent up: the slope along it has the opposite sign.
      const Vec3d normal = Vec3d(-(height(x + 1, y) - height(x - 1, y)) / spacing_m,
                                 (height(x, y + 1) - height(x, y - 1)) / spacing_m,
                                 1.0)
                               .normalized();
      SetTexel((0.5 * normal + Vec3d::Constant(0.5)).cast<float>().array(), x, y, map.texels);
    }
  }
  return map;
}

SurfaceTexture Paint(const std::string& name,
                     int size_px,
                     double size_m,
                     bool with_normals,
                     const Surface& surface) {
  SurfaceTexture result{{name, Image<uint8_t>(size_px, size_px, 4), true}, {}, size_m};
  std::vector<double> height_m(static_cast<size_t>(size_px) * static_cast<size_t>(size_px));
  ParallelFor(static_cast<size_t>(size_px), NumHardwareThreads(), [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < size_px; ++x) {
      const SurfacePoint point = surface((x + 0.5) / size_px, (y + 0.5) / size_px);
      SetTexel(point.color, x, y, result.color.texels);
      height_m[row * static_cast<size_t>(size_px) + static_cast<size_t>(x)] = point.height_m;
    }
  });
  if (with_normals) {
    result.normal = NormalMap(name, height_m, size_px, size_m);
  }
  return result;
}

/// A unit of masonry in running bond that a point lies in.
struct Masonry {
  uint64_t unit = 0;
  /// Position in the unit, 0 to 1.
  double u = 0.0;
  double v = 0.0;
  /// Distance to the unit's rim in parts of the texture's edge; negative values do not occur.
  double rim = 0.0;
};

Masonry Locate(double x, double y, int columns, int rows, double shift_per_row) {
  const double row = std::floor(y * rows);
  double along = x * columns + shift_per_row * row;
  along -= columns * std::floor(along / columns);
  const double column = std::floor(along);
  Masonry place;
  place.unit = HashKey({static_cast<uint64_t>(row), static_cast<uint64_t>(column)});
  place.u = along - column;
  place.v = y * rows - row;
  place.rim =
      std::min(std::min(place.u, 1.0 - place.u) / columns, std::min(place.v, 1.0 - place.v) / rows);
  return place;
}

double Mix(double a, double b, double t) { return a + (b - a) * t; }

Rgb MixColor(const Rgb& a, const Rgb& b, double t) {
  return a + (b - a) * static_cast<float>(std::clamp(t, 0.0, 1.0));
}

double Ramp(double from, double to, double value) {
  return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

}  // namespace

SurfaceTexture PlasterTexture() {
  return Paint("plaster", 512, 4.0, false, [](double x, double y) {
    const double broad = TileFractal(11, 3, 4, x, y);
    // Rain leaves upright streaks: noise that is stretched along y.
    const double streak = TileNoise(12, 64, x, 0.0) * TileNoise(13, 4, x, y);
    const double grain = TileNoise(14, 256, x, y);
    const double value = 0.90 + 0.13 * (broad - 0.5) - 0.06 * streak + 0.035 * (grain - 0.5);
    const Rgb color(static_cast<float>(value),
                    static_cast<float>(value - 0.004),
                    static_cast<float>(value - 0.012));
    return SurfacePoint{color, 0.0};
  });
}

SurfaceTexture TrimTexture() {
  return Paint("trim", 512, 2.4, true, [](double x, double y) {
    const double broad = TileFractal(15, 3, 4, x, y);
    const double patch = TileFractal(16, 12, 4, x, y);
    const double streak = TileNoise(17, 96, x, 0.0) * TileFractal(18, 4, 3, x, y);
    const double grain = TileNoise(19, 256, x, y);
    // Soot stays where rain does not reach; chips show lighter stone.
    const double soot = Ramp(0.42, 0.75, broad) * (0.35 + 0.65 * patch);
    const double chip = Ramp(0.70, 0.74, TileFractal(20, 40, 2, x, y));
    const double value = 0.93 - 0.38 * soot - 0.22 * streak + 0.07 * (grain - 0.5) + 0.06 * chip;
    const Rgb color(static_cast<float>(value),
                    static_cast<float>(value - 0.008),
                    static_cast<float>(value - 0.026));
    return SurfacePoint{color, 0.0008 * grain + 0.002 * patch - 0.003 * chip};
  });
}

SurfaceTexture BrickTexture(bool is_red) {
  const Rgb dark = is_red ? Rgb(0.42F, 0.27F, 0.22F) : Rgb(0.55F, 0.47F, 0.33F);
  const Rgb light = is_red ? Rgb(0.64F, 0.43F, 0.34F) : Rgb(0.80F, 0.72F, 0.53F);
  const Rgb burnt = is_red ? Rgb(0.30F, 0.22F, 0.20F) : Rgb(0.42F, 0.36F, 0.28F);
  return Paint(is_red ? "brick_red" : "brick_buff", 1024, 3.6, true, [=](double x, double y) {
    // 48 courses of 7.5 cm; every sixth one shows headers.
    const bool is_header = static_cast<int>(std::floor(y * 48.0)) % 6 == 5;
    const Masonry brick = is_header ? Locate(x, y, 32, 48, 0.0) : Locate(x, y, 16, 48, 0.5);
    const double tone = UniformFromHash(MixBits(brick.unit));
    const double grain = TileFractal(21, 96, 2, x, y);
    const double soot = TileFractal(22, 3, 3, x, y);
    const double joint_m = brick.rim * 3.6 + 0.002 * (grain - 0.5);
    const double face = Ramp(0.004, 0.0075, joint_m);
    Rgb color = MixColor(dark, light, Mix(tone, grain, 0.35));
    if (UniformFromHash(MixBits(brick.unit + 1)) < 0.07) {
      color = MixColor(color, burnt, 0.8);
    }
    const Rgb mortar = Rgb(0.66F, 0.62F, 0.56F) * static_cast<float>(0.9 + 0.2 * (grain - 0.5));
    color = MixColor(mortar, color, face) * static_cast<float>(1.0 - 0.22 * (soot - 0.35));
    return SurfacePoint{color, 0.006 * face + 0.002 * grain * face};
  });
}

SurfaceTexture AshlarTexture() {
  return Paint("ashlar", 1024, 3.2, true, [](double x, double y) {
    const Masonry block = Locate(x, y, 4, 8, 0.5);
    const double tone = UniformFromHash(MixBits(block.unit));
    const double grain = TileFractal(31, 64, 3, x, y);
    const double stain = TileFractal(32, 4, 3, x, y);
    const double face = Ramp(0.003, 0.007, block.rim * 3.2);
    const double value =
        (0.80 + 0.09 * tone + 0.07 * (grain - 0.5) - 0.10 * (stain - 0.4)) * Mix(0.72, 1.0, face);
    const double warm = 0.012 * UniformFromHash(MixBits(block.unit + 1));
    return SurfacePoint{Rgb(static_cast<float>(value + warm),
                            static_cast<float>(value),
                            static_cast<float>(value - warm - 0.01)),
                        0.007 * face + 0.0015 * grain};
  });
}

SurfaceTexture ConcreteTexture() {
  return Paint("concrete", 512, 3.0, false, [](double x, double y) {
    const double broad = TileFractal(41, 3, 4, x, y);
    const double streak = TileNoise(42, 48, x, 0.0) * TileNoise(43, 3, x, y);
    const double pit = TileNoise(44, 128, x, y) > 0.93 ? 0.12 : 0.0;
    const double value = 0.82 + 0.16 * (broad - 0.5) - 0.10 * streak - pit;
    return SurfacePoint{
        Rgb(static_cast<float>(value), static_cast<float>(value), static_cast<float>(value - 0.01)),
        0.0};
  });
}

SurfaceTexture RoofTileTexture() {
  return Paint("roof_tile", 512, 2.4, true, [](double x, double y) {
    const Masonry tile = Locate(x, y, 10, 8, 0.0);
    const double tone = UniformFromHash(MixBits(tile.unit));
    const double moss = TileFractal(51, 4, 4, x, y);
    // A pantile: a roll across, and each row lies on the one below it.
    const double roll = std::sin(3.14159265 * tile.u);
    const double shade = Mix(0.72, 1.0, roll) * Mix(1.0, 0.62, Ramp(0.9, 1.0, tile.v));
    Rgb color = MixColor(Rgb(0.47F, 0.31F, 0.25F), Rgb(0.67F, 0.45F, 0.35F), tone);
    color = MixColor(color, Rgb(0.36F, 0.34F, 0.26F), Ramp(0.55, 0.8, moss) * 0.7);
    return SurfacePoint{color * static_cast<float>(shade), 0.03 * roll + 0.02 * tile.v};
  });
}

SurfaceTexture SlateTexture() {
  return Paint("slate", 512, 2.4, true, [](double x, double y) {
    const Masonry slate = Locate(x, y, 10, 12, 0.5);
    const double tone = UniformFromHash(MixBits(slate.unit));
    const double grain = TileFractal(61, 48, 2, x, y);
    const double face = Ramp(0.0, 0.006, slate.rim * 2.4) * Mix(1.0, 0.7, Ramp(0.92, 1.0, slate.v));
    const double value = (0.30 + 0.12 * tone + 0.06 * (grain - 0.5)) * Mix(0.5, 1.0, face);
    return SurfacePoint{Rgb(static_cast<float>(value),
                            static_cast<float>(value + 0.012),
                            static_cast<float>(value + 0.035)),
                        0.006 * slate.v + 0.002 * tone};
  });
}

SurfaceTexture SeamedMetalTexture() {
  return Paint("seamed_metal", 512, 2.4, true, [](double x, double y) {
    const Masonry sheet = Locate(x, y, 4, 1, 0.0);
    const double seam = 1.0 - Ramp(0.008, 0.02, std::min(sheet.u, 1.0 - sheet.u) * 0.6);
    const double tone = UniformFromHash(MixBits(sheet.unit));
    const double cloud = TileFractal(71, 5, 4, x, y);
    const double value = 0.58 + 0.05 * tone + 0.14 * (cloud - 0.5) + 0.05 * seam;
    return SurfacePoint{Rgb(static_cast<float>(value - 0.01),
                            static_cast<float>(value),
                            static_cast<float>(value + 0.02)),
                        0.02 * seam};
  });
}

SurfaceTexture GravelTexture() {
  return Paint("gravel", 256, 2.0, false, [](double x, double y) {
    const double value = 0.36 + 0.35 * TileNoise(81, 128, x, y) * TileNoise(82, 64, x, y) +
                         0.10 * TileFractal(83, 3, 3, x, y);
    return SurfacePoint{Rgb(static_cast<float>(value + 0.01),
                            static_cast<float>(value),
                            static_cast<float>(value - 0.02)),
                        0.0};
  });
}

SurfaceTexture AsphaltTexture() {
  return Paint("asphalt", 512, 4.0, false, [](double x, double y) {
    const double stone = TileNoise(91, 256, x, y);
    const double patch = TileFractal(92, 4, 4, x, y);
    // A crack runs where a slow noise crosses its middle.
    const double crack = std::abs(TileFractal(93, 5, 3, x, y) - 0.5) < 0.002 ? 0.06 : 0.0;
    const double value = 0.33 + 0.09 * (stone - 0.5) + 0.14 * (patch - 0.5) - crack;
    return SurfacePoint{Rgb(static_cast<float>(value),
                            static_cast<float>(value),
                            static_cast<float>(value + 0.008)),
                        0.0};
  });
}

SurfaceTexture PavementTexture() {
  return Paint("pavement", 1024, 4.0, true, [](double x, double y) {
    const Masonry slab = Locate(x, y, 5, 8, 0.5);
    const double tone = UniformFromHash(MixBits(slab.unit));
    const double grain = TileFractal(101, 128, 2, x, y);
    const double stain = TileFractal(102, 5, 4, x, y);
    // Old chewing gum and spots of oil.
    const double spot = TileNoise(103, 40, x, y) > 0.94 ? 0.10 : 0.0;
    const double face = Ramp(0.002, 0.006, slab.rim * 4.0);
    const double value = (0.56 + 0.09 * tone + 0.07 * (grain - 0.5) - 0.16 * (stain - 0.4) - spot) *
                         Mix(0.62, 1.0, face);
    return SurfacePoint{Rgb(static_cast<float>(value + 0.008),
                            static_cast<float>(value),
                            static_cast<float>(value - 0.015)),
                        0.004 * face + 0.001 * tone};
  });
}

SurfaceTexture WoodTexture() {
  return Paint("wood", 256, 1.0, false, [](double x, double y) {
    const Masonry board = Locate(x, y, 6, 1, 0.0);
    const double grain = TileNoise(111, 64, x, 0.15 * y) * 0.6 + TileNoise(112, 128, x, y) * 0.4;
    const double joint = Ramp(0.0, 0.006, std::min(board.u, 1.0 - board.u) / 6.0);
    const double value =
        (0.80 + 0.12 * (grain - 0.5) + 0.08 * UniformFromHash(board.unit)) * Mix(0.55, 1.0, joint);
    return SurfacePoint{Rgb::Constant(static_cast<float>(value)), 0.0};
  });
}

SurfaceTexture SlatTexture() {
  return Paint("slat", 256, 1.0, true, [](double x, double y) {
    const Masonry slat = Locate(x, y, 1, 20, 0.0);
    const double dirt = TileFractal(121, 4, 3, x, y);
    const double value = (0.92 - 0.12 * (dirt - 0.4)) * Mix(1.0, 0.55, Ramp(0.82, 0.95, slat.v));
    return SurfacePoint{Rgb::Constant(static_cast<float>(value)),
                        0.012 * std::sin(3.14159265 * slat.v)};
  });
}

}  // namespace pfseq
