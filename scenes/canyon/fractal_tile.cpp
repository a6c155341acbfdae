// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/fractal_tile.h"

#include "scenes/canyon/texture_noise.h"

#include <cmath>
#include <cstddef>

namespace pfseq {
namespace {

constexpr double kOctaveRatio = 0.75;
constexpr int kCoarsestCells = 4;

int Wrap(int index) { return index & (FractalTile::kSize_px - 1); }

}  // namespace

FractalTile::FractalTile(uint64_t seed)
    : values_(static_cast<size_t>(kSize_px) * static_cast<size_t>(kSize_px)) {
  double sum = 0.0;
  double sum2 = 0.0;
  for (int y = 0; y < kSize_px; ++y) {
    for (int x = 0; x < kSize_px; ++x) {
      double value = 0.0;
      double weight = 1.0;
      for (int cells = kCoarsestCells; cells <= kSize_px / 2; cells *= 2) {
        value += weight * TileNoise(seed + static_cast<uint64_t>(cells),
                                    cells,
                                    static_cast<double>(x) / kSize_px,
                                    static_cast<double>(y) / kSize_px);
        weight *= kOctaveRatio;
      }
      values_[static_cast<size_t>(y) * kSize_px + static_cast<size_t>(x)] =
          static_cast<float>(value);
      sum += value;
      sum2 += value * value;
    }
  }
  const double count = static_cast<double>(values_.size());
  const double mean = sum / count;
  const double scale = 1.0 / std::sqrt(sum2 / count - mean * mean);
  for (float& value : values_) {
    value = static_cast<float>((value - mean) * scale);
  }
}

float FractalTile::At(double x_px, double y_px) const {
  const double left = std::floor(x_px);
  const double top = std::floor(y_px);
  const auto a = static_cast<float>(x_px - left);
  const auto b = static_cast<float>(y_px - top);
  const int x0 = Wrap(static_cast<int>(left));
  const int y0 = Wrap(static_cast<int>(top));
  const int x1 = Wrap(x0 + 1);
  const float* upper = &values_[static_cast<size_t>(y0) * kSize_px];
  const float* lower = &values_[static_cast<size_t>(Wrap(y0 + 1)) * kSize_px];
  return (1.0F - b) * ((1.0F - a) * upper[x0] + a * upper[x1]) +
         b * ((1.0F - a) * lower[x0] + a * lower[x1]);
}

const FractalTile& SharedFractal() {
  static const FractalTile tile(7);
  return tile;
}

}  // namespace pfseq
