// SPDX-License-Identifier: Apache-2.0
// A plain raster: row-major, interleaved channels, first row on top.
#pragma once

#include "renderer/core/check.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pfseq {

/// Pixels of `num_channels` values of type T. Pixel (x, y) covers [x, x + 1) x [y, y + 1) in
/// continuous pixel coordinates, so its centre is (x + 0.5, y + 0.5).
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width_px, int height_px, int num_channels, T value = T{})
      : width_px_(width_px),
        height_px_(height_px),
        num_channels_(num_channels),
        data_(static_cast<size_t>(width_px) * height_px * num_channels, value) {}

  int WidthPx() const { return width_px_; }
  int HeightPx() const { return height_px_; }
  int NumChannels() const { return num_channels_; }
  size_t NumPixels() const { return static_cast<size_t>(width_px_) * height_px_; }
  bool Empty() const { return data_.empty(); }

  T& At(int x, int y, int channel = 0) { return data_[Index(x, y, channel)]; }
  const T& At(int x, int y, int channel = 0) const { return data_[Index(x, y, channel)]; }

  std::span<T> Values() { return data_; }
  std::span<const T> Values() const { return data_; }

  bool operator==(const Image&) const = default;

 private:
  size_t Index(int x, int y, int channel) const {
    PFSEQ_DCHECK(x >= 0 && x < width_px_ && y >= 0 && y < height_px_ && channel >= 0 &&
                     channel < num_channels_,
                 "({}, {}, {}) in {} x {} x {}",
                 x,
                 y,
                 channel,
                 width_px_,
                 height_px_,
                 num_channels_);
    return (static_cast<size_t>(y) * width_px_ + x) * num_channels_ + channel;
  }

  int width_px_ = 0;
  int height_px_ = 0;
  int num_channels_ = 0;
  std::vector<T> data_;
};

}  // namespace pfseq
