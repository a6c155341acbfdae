// SPDX-License-Identifier: Apache-2.0
// Plain walls to paint on, and what has been painted.
#pragma once

#include "scenes/canyon/wall_painting.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace pfseq {

/// A part of a front without openings and ledges, under the eave, in texels of 2 cm.
inline WallPainting PlainWall(WallSurface surface, const WallRect& area, uint64_t seed = 5) {
  WallPainting painting;
  painting.look.surface = surface;
  painting.look.color = Rgb(0.7F, 0.65F, 0.6F);
  painting.look.seed = seed;
  painting.area = area;
  painting.eave_m = area.high_m.y();
  painting.texel_m = 0.02;
  return painting;
}

/// An even grey canvas for a painting.
inline WallCanvas GreyCanvas(const WallPainting& painting) {
  WallCanvas canvas(painting.area.low_m, painting.area.high_m, painting.texel_m);
  canvas.Rect(canvas.LowM(), canvas.HighM(), Rgb::Constant(0.5F), 1.0);
  return canvas;
}

/// Whether anything has been done to a texel of a grey canvas.
inline bool IsPainted(const WallTexel& texel) {
  const WallTexel plain;
  return (texel.color != 0.5F).any() || texel.height_m != plain.height_m ||
         texel.dirt != plain.dirt || texel.roughness != plain.roughness;
}

/// The places of all texels of a kind.
template <typename IsOfKind>
std::vector<Vec2d> PlacesWhere(WallCanvas& canvas, const IsOfKind& is_of_kind) {
  std::vector<Vec2d> places_m;
  canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& point_m) {
    if (is_of_kind(texel)) {
      places_m.push_back(point_m);
    }
  });
  return places_m;
}

/// The same in patches of texels that touch.
template <typename IsOfKind>
std::vector<std::vector<Vec2d>> PatchesWhere(WallCanvas& canvas, const IsOfKind& is_of_kind) {
  const int width = canvas.WidthPx();
  const int height = canvas.HeightPx();
  std::vector<std::vector<Vec2d>> patches;
  std::vector<bool> is_seen(static_cast<size_t>(width) * static_cast<size_t>(height));
  std::vector<std::pair<int, int>> found;
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height || is_seen[y * width + x]) {
      return;
    }
    is_seen[y * width + x] = true;
    if (is_of_kind(canvas.At(x, y))) {
      found.emplace_back(x, y);
    }
  };
  for (int i = 0; i < width * height; ++i) {
    found.clear();
    visit(i % width, i / width);
    if (found.empty()) {
      continue;
    }
    patches.emplace_back();
    for (size_t next = 0; next < found.size(); ++next) {
      const auto [x, y] = found[next];
      patches.back().push_back(canvas.PointOf(x, y));
      visit(x - 1, y);
      visit(x + 1, y);
      visit(x, y - 1);
      visit(x, y + 1);
    }
  }
  return patches;
}

/// The smallest rectangle around places; empty (low above high) around none.
inline WallRect RectAround(const std::vector<Vec2d>& places_m) {
  WallRect rect = {Vec2d::Constant(1e9), Vec2d::Constant(-1e9)};
  for (const Vec2d& place_m : places_m) {
    rect.low_m = rect.low_m.cwiseMin(place_m);
    rect.high_m = rect.high_m.cwiseMax(place_m);
  }
  return rect;
}

/// The mean of a number of each texel over a part of a wall.
template <typename NumberOf>
double MeanOver(const WallRect& part, WallCanvas& canvas, const NumberOf& number_of) {
  double sum = 0.0;
  int count = 0;
  canvas.ForEach(part.low_m, part.high_m, [&](WallTexel& texel, const Vec2d& /*point_m*/) {
    sum += number_of(texel);
    ++count;
  });
  return sum / count;
}

inline double HeightOf(const WallTexel& texel) { return texel.height_m; }
inline double BrightnessOf(const WallTexel& texel) { return texel.color.mean(); }
inline double DirtOf(const WallTexel& texel) { return texel.dirt; }

/// Stretches along a part of a wall (axis 0) or up it (axis 1), begin and end of each, of which
/// each slice is of a kind.
template <typename IsOfKind>
std::vector<Vec2d> StretchesWhere(const WallRect& part,
                                  int axis,
                                  double slice_m,
                                  const IsOfKind& is_of_kind) {
  std::vector<Vec2d> stretches_m;
  bool is_inside = false;
  const auto count = std::lround((part.high_m[axis] - part.low_m[axis]) / slice_m);
  for (int i = 0; i < count; ++i) {
    WallRect slice = part;
    slice.low_m[axis] = part.low_m[axis] + i * slice_m;
    slice.high_m[axis] = slice.low_m[axis] + slice_m;
    const bool was_inside = std::exchange(is_inside, is_of_kind(slice));
    if (is_inside && !was_inside) {
      stretches_m.emplace_back(slice.low_m[axis], 0.0);
    }
    if (is_inside) {
      stretches_m.back().y() = slice.high_m[axis];
    }
  }
  return stretches_m;
}

}  // namespace pfseq
