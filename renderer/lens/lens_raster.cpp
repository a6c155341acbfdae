// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/lens_raster.h"

#include "renderer/core/parallel.h"

#include <cmath>
#include <limits>

namespace pfseq {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

LensRaster::LensRaster(const Lens& lens, int width_px, int height_px, int num_threads)
    : lens_(&lens),
      width_px_(width_px),
      height_px_(height_px),
      centres_(static_cast<size_t>(width_px) * static_cast<size_t>(height_px)),
      corners_(static_cast<size_t>(width_px + 1) * static_cast<size_t>(height_px + 1)),
      state_(centres_.size(), kInside) {
  const auto num_rows = static_cast<size_t>(height_px);
  ParallelFor(num_rows + 1, num_threads, [&](size_t row) {
    const auto y = static_cast<double>(row);
    for (int x = 0; x <= width_px; ++x) {
      const size_t corner_idx = row * static_cast<size_t>(width_px + 1) + static_cast<size_t>(x);
      corners_[corner_idx] = lens.Unproject({x, y}).value_or(Vec3d::Constant(kNan)).cast<float>();
      if (row < num_rows && x < width_px) {
        centres_[Index(x, static_cast<int>(row))] =
            lens.Unproject({x + 0.5, y + 0.5}).value_or(Vec3d::Constant(kNan));
      }
    }
  });
  // The field of view is a disc (a convex curve): a pixel with all corners inside lies inside, and
  // one that touches it has a corner, its centre or one of its neighbours' corners inside.
  const auto corner_inside = [&](int x, int y) {
    if (x < 0 || y < 0 || x > width_px || y > height_px) {
      return false;
    }
    return !std::isnan(corners_[static_cast<size_t>(y) * static_cast<size_t>(width_px + 1) +
                                static_cast<size_t>(x)]
                           .x());
  };
  ParallelFor(num_rows, num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < width_px; ++x) {
      int num_inside = 0;
      bool is_near = !std::isnan(centres_[Index(x, y)].x());
      for (int j = -1; j <= 2; ++j) {
        for (int i = -1; i <= 2; ++i) {
          const bool inside = corner_inside(x + i, y + j);
          is_near = is_near || inside;
          num_inside += inside && (i == 0 || i == 1) && (j == 0 || j == 1) ? 1 : 0;
        }
      }
      state_[Index(x, y)] = num_inside == 4 ? kInside : is_near ? kRim : kOutside;
    }
  });
}

std::optional<Vec3d> LensRaster::CentreDirection(int x, int y) const {
  const Vec3d& direction = centres_[Index(x, y)];
  return std::isnan(direction.x()) ? std::nullopt : std::optional<Vec3d>(direction);
}

std::array<Vec3f, 4> LensRaster::CornerDirections(int x, int y) const {
  const size_t upper =
      static_cast<size_t>(y) * static_cast<size_t>(width_px_ + 1) + static_cast<size_t>(x);
  const size_t lower = upper + static_cast<size_t>(width_px_ + 1);
  return {corners_[upper], corners_[upper + 1], corners_[lower], corners_[lower + 1]};
}

int64_t LensRaster::MemoryBytes() const {
  return static_cast<int64_t>(centres_.size() * sizeof(Vec3d) + corners_.size() * sizeof(Vec3f) +
                              state_.size());
}

}  // namespace pfseq
