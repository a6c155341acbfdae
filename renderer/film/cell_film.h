// SPDX-License-Identifier: Apache-2.0
// Where samples of the light on the film are collected before the lens spreads them: each pixel has
// 2 x 2 cells, so that a sample's place is known to a quarter of a pixel.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"

#include <vector>

namespace pfseq {

class CellFilm {
 public:
  /// Cells along a pixel's side.
  static constexpr int kCells = 2;

  struct Cell {
    Rgb sum = Rgb::Zero();
    float num_samples = 0.0F;
  };

  CellFilm(int width_px, int height_px)
      : width_px_(width_px),
        height_px_(height_px),
        cells_(static_cast<size_t>(width_px) * static_cast<size_t>(height_px) * kCells * kCells) {}

  /// The cell of a place in a pixel, in [0, 1)^2.
  Cell& At(int x, int y, const Vec2f& place) {
    return cells_[Index(x, y) + (place.y() < 0.5F ? 0 : kCells) + (place.x() < 0.5F ? 0 : 1)];
  }

  /// Mean radiance of a cell, that of its pixel where it has no sample. Pixels without samples are
  /// black.
  Rgb Mean(int x, int y, int cell_x, int cell_y) const {
    const size_t pixel = Index(x, y);
    const Cell& cell = cells_[pixel + static_cast<size_t>(cell_y * kCells + cell_x)];
    if (cell.num_samples > 0.0F) {
      return cell.sum / cell.num_samples;
    }
    Cell all;
    for (size_t i = 0; i < kCells * kCells; ++i) {
      all.sum += cells_[pixel + i].sum;
      all.num_samples += cells_[pixel + i].num_samples;
    }
    return all.num_samples > 0.0F ? Rgb(all.sum / all.num_samples) : Rgb(Rgb::Zero());
  }

  int WidthPx() const { return width_px_; }
  int HeightPx() const { return height_px_; }

 private:
  size_t Index(int x, int y) const {
    return (static_cast<size_t>(y) * static_cast<size_t>(width_px_) + static_cast<size_t>(x)) *
           kCells * kCells;
  }

  int width_px_;
  int height_px_;
  std::vector<Cell> cells_;
};

}  // namespace pfseq
