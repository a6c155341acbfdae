// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/noise_tile.h"

#include "renderer/core/parallel.h"
#include "renderer/core/random.h"

#include <algorithm>
#include <numbers>

namespace pfseq {
namespace {

/// Points of a periodic lattice with a vector each: gradients, or the places of features.
class Lattice {
 public:
  Lattice(NoiseOctave::Kind kind, int num_cells, uint64_t key) : num_cells_(num_cells) {
    RandomStream random({key});
    vectors_.resize(static_cast<size_t>(num_cells) * num_cells);
    for (Vec2f& vector : vectors_) {
      if (kind == NoiseOctave::Kind::kGradient) {
        const auto angle_rad = static_cast<float>(random.Uniform(0.0, 2.0 * std::numbers::pi));
        vector = {std::cos(angle_rad), std::sin(angle_rad)};
      } else {
        vector.x() = static_cast<float>(random.Uniform());
        vector.y() = static_cast<float>(random.Uniform());
      }
    }
  }

  /// From -1 on.
  const Vec2f& At(int column, int row) const {
    const auto wrap = [this](int index) {
      return static_cast<size_t>((index + num_cells_) % num_cells_);
    };
    return vectors_[wrap(row) * num_cells_ + wrap(column)];
  }

 private:
  int num_cells_;
  std::vector<Vec2f> vectors_;
};

/// In about [-1, 1]; the argument in cells.
float Gradient(const Lattice& lattice, float x, float y) {
  const auto column = static_cast<int>(x);
  const auto row = static_cast<int>(y);
  const Vec2f place(x - static_cast<float>(column), y - static_cast<float>(row));
  const auto corner = [&](int i, int j) {
    return lattice.At(column + i, row + j)
        .dot(place - Vec2f(static_cast<float>(i), static_cast<float>(j)));
  };
  const auto fade = [](float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); };
  const float wx = fade(place.x());
  const float above = corner(0, 0) + wx * (corner(1, 0) - corner(0, 0));
  const float below = corner(0, 1) + wx * (corner(1, 1) - corner(0, 1));
  return std::numbers::sqrt2_v<float> * (above + fade(place.y()) * (below - above));
}

/// In [0, 1]; the argument in cells.
float Billow(const Lattice& lattice, float x, float y) {
  const auto column = static_cast<int>(x);
  const auto row = static_cast<int>(y);
  const Vec2f place(x - static_cast<float>(column), y - static_cast<float>(row));
  float nearest = 1.0F;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const Vec2f offset = lattice.At(column + i, row + j) +
                           Vec2f(static_cast<float>(i), static_cast<float>(j)) - place;
      nearest = std::min(nearest, offset.squaredNorm());
    }
  }
  return 1.0F - nearest;
}

}  // namespace

NoiseTile::NoiseTile(double size_m, const std::vector<NoiseOctave>& octaves, uint64_t seed)
    : pixels_a_metre_(static_cast<float>(kSizePx / size_m)),
      values_(static_cast<size_t>(kSizePx) * kSizePx, Vec2f::Zero()) {
  for (size_t i = 0; i < octaves.size(); ++i) {
    const NoiseOctave& octave = octaves[i];
    const bool is_gradient = octave.kind == NoiseOctave::Kind::kGradient;
    const float cells_a_pixel = static_cast<float>(octave.num_cells) / kSizePx;
    for (int channel = 0; channel < 2; ++channel) {
      const Lattice lattice(
          octave.kind, octave.num_cells, HashKey({seed, i, static_cast<uint64_t>(channel)}));
      ParallelFor(kSizePx, NumHardwareThreads(), [&](size_t row) {
        const float y = static_cast<float>(row) * cells_a_pixel;
        for (size_t column = 0; column < kSizePx; ++column) {
          const float x = static_cast<float>(column) * cells_a_pixel;
          values_[row * kSizePx + column][channel] +=
              octave.weight * (is_gradient ? Gradient(lattice, x, y) : Billow(lattice, x, y));
        }
      });
    }
  }
  Vec2d sum = Vec2d::Zero();
  for (const Vec2f& value : values_) {
    sum += value.cast<double>();
  }
  const Vec2f mean = (sum / static_cast<double>(values_.size())).cast<float>();
  for (Vec2f& value : values_) {
    value -= mean;
  }
}

}  // namespace pfseq
