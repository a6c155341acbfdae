// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/kernel_grid.h"

#include <cmath>
#include <utility>

namespace pfseq {
namespace {

/// Whether blocks lie alike on both sides of the axis.
bool IsSymmetric(int size_px, int block_px, double axis_px) {
  constexpr double kTolerancePx = 1e-6;
  return size_px % block_px == 0 && std::abs(2.0 * axis_px - size_px) < kTolerancePx;
}

}  // namespace

KernelGrid::KernelGrid(
    int width_px, int height_px, int block_px, const Vec2d& axis_px, Maker maker)
    : width_px_(width_px),
      height_px_(height_px),
      block_px_(block_px),
      maker_(std::move(maker)),
      num_columns_((width_px + block_px - 1) / block_px),
      num_rows_((height_px + block_px - 1) / block_px),
      is_symmetric_x_(IsSymmetric(width_px, block_px, axis_px.x())),
      is_symmetric_y_(IsSymmetric(height_px, block_px, axis_px.y())),
      is_made_(static_cast<size_t>(num_columns_) * static_cast<size_t>(num_rows_)),
      kernels_(is_made_.size()) {}

KernelGrid::Oriented KernelGrid::Of(int column, int row) {
  Oriented found;
  found.is_mirrored_x = is_symmetric_x_ && 2 * column >= num_columns_;
  found.is_mirrored_y = is_symmetric_y_ && 2 * row >= num_rows_;
  const int source_column = found.is_mirrored_x ? num_columns_ - 1 - column : column;
  const int source_row = found.is_mirrored_y ? num_rows_ - 1 - row : row;
  const auto idx = static_cast<size_t>(source_row) * static_cast<size_t>(num_columns_) +
                   static_cast<size_t>(source_column);
  std::call_once(is_made_[idx], [&] {
    kernels_[idx] = std::make_unique<const SpreadKernel>(
        maker_(Vec2d((source_column + 0.5) * block_px_, (source_row + 0.5) * block_px_)));
  });
  found.kernel = kernels_[idx].get();
  return found;
}

}  // namespace pfseq
