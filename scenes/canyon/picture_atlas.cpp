// SPDX-License-Identifier: Apache-2.0
// Pictures behind glass and on boards: the atlases of canyon_textures.h.
#include "renderer/core/random.h"
#include "scenes/canyon/canyon_textures.h"
#include "scenes/canyon/fractal_tile.h"
#include "scenes/canyon/texture_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfseq {
namespace {

/// A rectangle of texels that is painted in its own unit coordinates, y downwards.
class Picture {
 public:
  Picture(Image<uint8_t>& texels, int left_px, int top_px, int width_px, int height_px)
      : texels_(texels), left_(left_px), top_(top_px), width_(width_px), height_(height_px) {}

  /// Replaces the colours in [x0, x1] x [y0, y1] by `color(x, y)`.
  template <typename ColorAt>
  void Fill(double x0, double y0, double x1, double y1, const ColorAt& color) {
    const int left = std::clamp(static_cast<int>(std::lround(x0 * width_)), 0, width_);
    const int right = std::clamp(static_cast<int>(std::lround(x1 * width_)), 0, width_);
    const int top = std::clamp(static_cast<int>(std::lround(y0 * height_)), 0, height_);
    const int bottom = std::clamp(static_cast<int>(std::lround(y1 * height_)), 0, height_);
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        const Rgb value = color((x + 0.5) / width_, (y + 0.5) / height_);
        for (int channel = 0; channel < 3; ++channel) {
          texels_.At(left_ + x, top_ + y, channel) =
              static_cast<uint8_t>(std::lround(std::clamp(value[channel], 0.0F, 1.0F) * 255.0F));
        }
        texels_.At(left_ + x, top_ + y, 3) = 255;
      }
    }
  }

  void FillFlat(double x0, double y0, double x1, double y1, const Rgb& color) {
    Fill(x0, y0, x1, y1, [&](double, double) { return color; });
  }

 private:
  Image<uint8_t>& texels_;
  int left_;
  int top_;
  int width_;
  int height_;
};

Rgb Gray(double value) { return Rgb::Constant(static_cast<float>(value)); }

/// The room: darker to the depth, a lighter ceiling, something pale on the back wall here and
/// there.
void PaintRoom(RandomStream& random, Picture& picture) {
  const double base = random.Uniform(0.05, 0.13);
  const double ceiling_light = random.Uniform(0.15, 0.4);
  picture.Fill(0, 0, 1, 1, [&](double x, double y) {
    const double ceiling = std::max(0.0, 0.30 - y) * ceiling_light;
    const double value = base + ceiling + 0.03 * std::abs(x - 0.5);
    return Rgb(
        static_cast<float>(value), static_cast<float>(value), static_cast<float>(value * 1.08));
  });
  // The back wall with what hangs and stands there.
  const double back = base + random.Uniform(0.02, 0.1);
  picture.FillFlat(0.12, 0.22, 0.88, 0.9, Rgb(Rgb(1.06F, 1.0F, 0.9F) * static_cast<float>(back)));
  for (int i = random.Integer(1, 5); i > 0; --i) {
    const double x = random.Uniform(0.14, 0.75);
    const double y = random.Uniform(0.3, 0.75);
    const double width = random.Uniform(0.05, 0.2);
    const double height = random.Uniform(0.06, 0.22);
    const double tone = random.Uniform(0.08, 0.4);
    picture.FillFlat(x - 0.008, y - 0.006, x + width + 0.008, y + height + 0.006, Gray(0.4 * tone));
    picture.FillFlat(x,
                     y,
                     x + width,
                     y + height,
                     Rgb(static_cast<float>(tone * random.Uniform(0.8, 1.3)),
                         static_cast<float>(tone),
                         static_cast<float>(tone * random.Uniform(0.6, 1.2))));
  }
  if (random.Chance(0.3)) {
    const double x = random.Uniform(0.25, 0.7);
    picture.FillFlat(x, 0.0, x + 0.012, 0.16, Gray(0.05));
    picture.FillFlat(x - 0.06, 0.15, x + 0.07, 0.23, Rgb(0.85F, 0.76F, 0.55F));
  }
}

Rgb CurtainColor(RandomStream& random) {
  constexpr std::array<std::array<float, 3>, 6> kColors = {{{0.78F, 0.76F, 0.70F},
                                                            {0.70F, 0.68F, 0.64F},
                                                            {0.82F, 0.80F, 0.78F},
                                                            {0.60F, 0.52F, 0.42F},
                                                            {0.48F, 0.28F, 0.24F},
                                                            {0.38F, 0.42F, 0.46F}}};
  const auto& color = kColors[static_cast<size_t>(random.Integer(0, 5))];
  return {color[0], color[1], color[2]};
}

void PaintCurtain(double x0, double x1, RandomStream& random, Picture& picture, const Rgb& color) {
  const double folds = random.Uniform(18.0, 34.0);
  const double phase = random.Uniform(0.0, 6.0);
  picture.Fill(x0, 0.0, x1, 1.0, [&](double x, double y) {
    const double fold = 0.76 + 0.16 * std::sin(folds * x + phase + 0.5 * std::sin(3.0 * y)) +
                        0.07 * std::sin(2.7 * folds * x) +
                        0.03 * SharedFractal().At(90.0 * x, 6.0 * y);
    return Rgb(color * static_cast<float>(fold * (0.92 - 0.12 * y)));
  });
}

void PaintInterior(RandomStream& random, Picture& picture) {
  PaintRoom(random, picture);
  const double kind = random.Uniform();
  const Rgb color = CurtainColor(random);
  if (kind < 0.34) {
    const double width = random.Uniform(0.10, 0.30);
    PaintCurtain(0.0, width, random, picture, color);
    PaintCurtain(1.0 - random.Uniform(0.8, 1.2) * width, 1.0, random, picture, color);
  } else if (kind < 0.46) {
    PaintCurtain(0.0, 1.0, random, picture, Rgb(color * 0.8F));
  } else if (kind < 0.72) {
    const double drop = random.Uniform(0.12, 0.85);
    picture.Fill(0.0, 0.0, 1.0, drop, [&](double, double y) {
      return Rgb(color * static_cast<float>(0.86 + 0.08 * std::sin(160.0 * y)));
    });
  } else if (kind < 0.86) {
    // Things on the sill: pots and leaves, a lamp, books.
    for (double x = random.Uniform(0.04, 0.2); x < 0.9; x += random.Uniform(0.1, 0.3)) {
      const double pot = random.Uniform(0.05, 0.09);
      const Rgb clay(0.42F, 0.24F, 0.16F);
      picture.FillFlat(
          x, 0.93, x + pot, 1.0, random.Chance(0.5) ? clay : Gray(random.Uniform(0.2, 0.8)));
      for (int leaf = random.Integer(0, 14); leaf > 0; --leaf) {
        const double u = x + random.Uniform(-0.05, pot + 0.02);
        const double v = random.Uniform(0.74, 0.93);
        picture.FillFlat(u,
                         v,
                         u + 0.035,
                         v + 0.03,
                         Rgb(0.12F, 0.25F, 0.09F) * static_cast<float>(random.Uniform(0.5, 1.6)));
      }
    }
  }
  if (random.Chance(0.25)) {
    // A net before it all, over the lower part.
    const double top = random.Uniform(0.3, 0.6);
    picture.Fill(0.0, top, 1.0, 1.0, [&](double x, double y) {
      return Gray(0.62 + 0.08 * std::sin(70.0 * x) + 0.04 * std::sin(240.0 * (y - top)));
    });
  }
}

/// A casement of two wings with a transom light.
void PaintFrame(Picture& picture) {
  const Rgb paint(0.82F, 0.81F, 0.78F);
  const Rgb shade(0.30F, 0.30F, 0.30F);
  constexpr double kBar = 0.055;
  const auto bar = [&](double x0, double y0, double x1, double y1) {
    picture.FillFlat(x0 - 0.012, y0 - 0.010, x1 + 0.012, y1 + 0.014, shade);
    picture.FillFlat(x0, y0, x1, y1, paint);
  };
  bar(0.5 - 0.6 * kBar, 0.0, 0.5 + 0.6 * kBar, 1.0);
  bar(0.0, 0.27, 1.0, 0.27 + 0.7 * kBar);
  bar(0.0, 0.0, kBar, 1.0);
  bar(1.0 - kBar, 0.0, 1.0, 1.0);
  bar(0.0, 0.0, 1.0, 0.8 * kBar);
  bar(0.0, 1.0 - kBar, 1.0, 1.0);
}

void PaintShop(RandomStream& random, Picture& picture) {
  const double light = random.Uniform(0.16, 0.34);
  picture.Fill(0, 0, 1, 1, [&](double x, double y) {
    const double value = light * (1.1 - 0.5 * y) * (0.85 + 0.3 * std::abs(x - 0.5));
    return Rgb(static_cast<float>(value * 1.06),
               static_cast<float>(value),
               static_cast<float>(value * 0.88));
  });
  for (int lamp = 0; lamp < 5; ++lamp) {
    const double x = 0.1 + 0.2 * lamp + random.Uniform(-0.03, 0.03);
    picture.FillFlat(x - 0.015, 0.05, x + 0.015, 0.07, Rgb(1.0F, 0.95F, 0.8F));
  }
  // Shelves on the back wall, goods on them, and the display in front.
  for (int shelf = 0; shelf < 4; ++shelf) {
    const double y = 0.24 + 0.15 * shelf;
    double x = random.Uniform(0.03, 0.1);
    while (x < 0.94) {
      const double width = random.Uniform(0.02, 0.07);
      const double height = random.Uniform(0.04, 0.11);
      const double tone = random.Uniform(0.15, 0.6);
      const double tint = random.Uniform(-0.08, 0.12);
      const Rgb goods(static_cast<float>(tone + tint),
                      static_cast<float>(tone),
                      static_cast<float>(tone - 0.6 * tint));
      picture.FillFlat(x, y - height, x + width, y, Rgb(goods * 0.7F));
      x += width + random.Uniform(0.004, 0.05);
    }
    picture.FillFlat(0.02, y, 0.98, y + 0.012, Gray(0.42));
  }
  for (int item = 0; item < 4; ++item) {
    const double x = random.Uniform(0.03, 0.82);
    const double y = random.Uniform(0.62, 0.8);
    const double tone = random.Uniform(0.2, 0.75);
    const double tint = random.Uniform(-0.1, 0.16);
    const Rgb color(static_cast<float>(tone + tint),
                    static_cast<float>(tone + random.Uniform(-0.04, 0.04)),
                    static_cast<float>(tone - tint));
    picture.FillFlat(x, y, x + random.Uniform(0.05, 0.15), 1.0, color);
  }
}

}  // namespace

Texture WindowAtlas(bool with_frames) {
  constexpr int kCell_px = 144;
  Texture atlas{with_frames ? "windows_framed" : "windows",
                Image<uint8_t>(kCell_px * kWindowAtlasCells, kCell_px * kWindowAtlasCells, 4),
                true};
  for (int row = 0; row < kWindowAtlasCells; ++row) {
    for (int column = 0; column < kWindowAtlasCells; ++column) {
      Picture picture(atlas.texels, column * kCell_px, row * kCell_px, kCell_px, kCell_px);
      RandomStream random({201, static_cast<uint64_t>(row), static_cast<uint64_t>(column)});
      PaintInterior(random, picture);
      if (with_frames) {
        PaintFrame(picture);
      }
    }
  }
  return atlas;
}

Texture ShopAtlas() {
  constexpr int kCell_px = 256;
  Texture atlas{
      "shops", Image<uint8_t>(kCell_px * kShopAtlasCells, kCell_px * kShopAtlasCells, 4), true};
  for (int row = 0; row < kShopAtlasCells; ++row) {
    for (int column = 0; column < kShopAtlasCells; ++column) {
      Picture picture(atlas.texels, column * kCell_px, row * kCell_px, kCell_px, kCell_px);
      RandomStream random({202, static_cast<uint64_t>(row), static_cast<uint64_t>(column)});
      PaintShop(random, picture);
    }
  }
  return atlas;
}

Texture CurtainWallTexture() {
  constexpr int kSize_px = 512;
  // Four modules wide and two storeys high, so that panes differ.
  constexpr int kColumns = 4;
  constexpr int kRows = 2;
  Texture texture{"curtain_wall", Image<uint8_t>(kSize_px, kSize_px, 4), true};
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      Picture picture(texture.texels,
                      column * kSize_px / kColumns,
                      row * kSize_px / kRows,
                      kSize_px / kColumns,
                      kSize_px / kRows);
      RandomStream random({204, static_cast<uint64_t>(row), static_cast<uint64_t>(column)});
      const double tone = random.Uniform(0.10, 0.18);
      picture.FillFlat(0,
                       0,
                       1,
                       1,
                       Rgb(static_cast<float>(tone),
                           static_cast<float>(tone * 1.15),
                           static_cast<float>(tone * 1.25)));
      if (random.Chance(0.4)) {
        picture.FillFlat(0, 0, 1, random.Uniform(0.2, 0.6), Gray(random.Uniform(0.35, 0.5)));
      }
      picture.FillFlat(0, 0.74, 1, 1, Rgb(0.22F, 0.26F, 0.29F));
      picture.FillFlat(0, 0.72, 1, 0.75, Gray(0.55));
      picture.FillFlat(0, 0.0, 0.05, 1, Gray(0.58));
    }
  }
  return texture;
}

}  // namespace pfseq
