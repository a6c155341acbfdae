// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/film/spread_kernel.h"

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace pfseq {

/// The kernels of an image's blocks of pixels, made when they are first asked for and kept for the
/// images that follow. A spread is the same in mirror about the lens's axis: where that goes through
/// the middle of the image, a quarter of the blocks stands for all.
class KernelGrid {
 public:
  /// The kernel of a block with its middle at this place.
  using Maker = std::function<SpreadKernel(const Vec2d& middle_px)>;

  KernelGrid(int width_px, int height_px, int block_px, const Vec2d& axis_px, Maker maker);

  int WidthPx() const { return width_px_; }
  int HeightPx() const { return height_px_; }

  /// A kernel, maybe to be read from its last column or row.
  struct Oriented {
    const SpreadKernel* kernel = nullptr;
    bool is_mirrored_x = false;
    bool is_mirrored_y = false;

    float At(size_t channel, int x, int y) const {
      const int last = kernel->Side() - 1;
      return kernel->At(channel, is_mirrored_x ? last - x : x, is_mirrored_y ? last - y : y);
    }
  };

  /// That of a block by its column and row. Any number of threads may ask.
  Oriented Of(int column, int row);

 private:
  int width_px_;
  int height_px_;
  int block_px_;
  Maker maker_;
  int num_columns_;
  int num_rows_;
  bool is_symmetric_x_;
  bool is_symmetric_y_;
  std::vector<std::once_flag> is_made_;
  std::vector<std::unique_ptr<const SpreadKernel>> kernels_;
};

}  // namespace pfseq
