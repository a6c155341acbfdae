// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/texture.h"

#include "renderer/core/parallel.h"
#include "renderer/trace/color.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace pfseq {
namespace {

/// Two neighbouring texels along one axis and the weight of the second.
template <typename Real>
struct Neighbours {
  Neighbours(Real coordinate, int num_texels) {
    const Real position =
        (coordinate - std::floor(coordinate)) * static_cast<Real>(num_texels) - Real(0.5);
    const Real below = std::floor(position);
    first = static_cast<int>(below);
    second = first + 1;
    second_weight = static_cast<float>(position - below);
    // The position lies in [-0.5, num_texels - 0.5], so one step wraps either way.
    if (first < 0) {
      first = num_texels - 1;
    }
    if (second >= num_texels) {
      second = 0;
    }
  }
  int first;
  int second;
  float second_weight;
};

Rgba Decode(const uint8_t* texel, const float* color_table, const float* alpha_table) {
  return {
      color_table[texel[0]], color_table[texel[1]], color_table[texel[2]], alpha_table[texel[3]]};
}

/// The texels of a finer level under one of a coarser level along one axis, and the shares of it
/// that they cover.
struct Overlap {
  int first = 0;
  int count = 0;
  std::array<float, 4> weights{};
};

std::vector<Overlap> Overlaps(int num_finer, int num_coarser) {
  std::vector<Overlap> overlaps(static_cast<size_t>(num_coarser));
  // In units of which a finer texel is num_coarser wide and a coarser one num_finer: exact. A
  // coarser texel is less than three finer ones wide, so it lies on four at most.
  for (int i = 0; i < num_coarser; ++i) {
    Overlap& overlap = overlaps[static_cast<size_t>(i)];
    const int start = i * num_finer;
    const int end = start + num_finer;
    overlap.first = start / num_coarser;
    for (int k = overlap.first; k * num_coarser < end; ++k) {
      const int share = std::min((k + 1) * num_coarser, end) - std::max(k * num_coarser, start);
      overlap.weights[static_cast<size_t>(overlap.count++)] =
          static_cast<float>(share) / static_cast<float>(num_finer);
    }
  }
  return overlaps;
}

uint8_t Quantise(float value) {
  return static_cast<uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
}

/// Quantise(SrgbFromLinear(value)) by tables: a power for each texel would take longer than all else.
class SrgbQuantiser {
 public:
  SrgbQuantiser() {
    for (size_t code = 0; code < least_.size(); ++code) {
      least_[code] = LinearFromSrgb((static_cast<float>(code) - 0.5F) / 255.0F);
    }
    least_.back() = std::numeric_limits<float>::infinity();
    uint8_t code = 0;
    for (size_t cell = 0; cell < code_of_cell_.size(); ++cell) {
      while (static_cast<float>(cell) / kCells >= least_[code + size_t{1}]) {
        ++code;
      }
      code_of_cell_[cell] = code;
    }
  }

  uint8_t operator()(float linear) const {
    const float value = std::clamp(linear, 0.0F, 1.0F);
    uint8_t code = code_of_cell_[static_cast<size_t>(value * kCells)];
    while (value >= least_[code + size_t{1}]) {
      ++code;
    }
    return code;
  }

 private:
  static constexpr int kCells = 4096;
  /// The least value of each code; beyond the last one there is none.
  std::array<float, 257> least_{};
  std::array<uint8_t, kCells + 1> code_of_cell_{};
};

/// log2 to within 0.09, exact at powers of two, for normal positive numbers.
float ApproximateLog2(float value) {
  const auto bits = std::bit_cast<uint32_t>(value);
  return static_cast<float>(bits) * 0x1p-23F - 127.0F;
}

}  // namespace

TextureSet::TextureSet(const Scene& scene) : pyramids_(scene.textures.size()) {
  for (size_t i = 0; i < linear_from_srgb_.size(); ++i) {
    linear_from_linear_[i] = static_cast<float>(i) / 255.0F;
    linear_from_srgb_[i] = LinearFromSrgb(linear_from_linear_[i]);
  }
  ParallelFor(scene.textures.size(), NumHardwareThreads(), [&](size_t i) {
    pyramids_[i] = MakePyramid(scene.textures[i]);
  });
}

TextureSet::Pyramid TextureSet::MakePyramid(const Texture& texture) const {
  Pyramid pyramid;
  pyramid.color_table = texture.is_srgb ? linear_from_srgb_.data() : linear_from_linear_.data();
  const auto level_of = [](const Image<uint8_t>& texels) {
    return Level{texels.Values().data(), texels.WidthPx(), texels.HeightPx()};
  };
  pyramid.levels.push_back(level_of(texture.texels));
  // Means are made of the finer level's linear light, in float, so that rounding to 8 bit does not
  // add up.
  std::vector<Rgba> finer(texture.texels.NumPixels());
  for (size_t i = 0; i < finer.size(); ++i) {
    finer[i] =
        Decode(&texture.texels.Values()[4 * i], pyramid.color_table, linear_from_linear_.data());
  }
  static const SrgbQuantiser quantise_srgb;
  Level size = pyramid.levels.front();
  while (size.width_px > 1 || size.height_px > 1) {
    const int width_px = std::max(1, size.width_px / 2);
    const int height_px = std::max(1, size.height_px / 2);
    std::vector<Rgba> coarser(static_cast<size_t>(width_px) * static_cast<size_t>(height_px));
    Image<uint8_t> texels(width_px, height_px, 4);
    const std::vector<Overlap> columns = Overlaps(size.width_px, width_px);
    const std::vector<Overlap> rows = Overlaps(size.height_px, height_px);
    for (int y = 0; y < height_px; ++y) {
      const Overlap& row = rows[static_cast<size_t>(y)];
      for (int x = 0; x < width_px; ++x) {
        const Overlap& column = columns[static_cast<size_t>(x)];
        Rgba sum = Rgba::Zero();
        for (int j = 0; j < row.count; ++j) {
          for (int i = 0; i < column.count; ++i) {
            sum += finer[static_cast<size_t>(row.first + j) * static_cast<size_t>(size.width_px) +
                         static_cast<size_t>(column.first + i)] *
                   (row.weights[static_cast<size_t>(j)] * column.weights[static_cast<size_t>(i)]);
          }
        }
        coarser[static_cast<size_t>(y) * static_cast<size_t>(width_px) + static_cast<size_t>(x)] =
            sum;
        for (int channel = 0; channel < 4; ++channel) {
          const bool is_encoded = texture.is_srgb && channel < 3;
          texels.At(x, y, channel) =
              is_encoded ? quantise_srgb(sum[channel]) : Quantise(sum[channel]);
        }
      }
    }
    pyramid.coarser_texels.push_back(std::move(texels));
    pyramid.levels.push_back(level_of(pyramid.coarser_texels.back()));
    finer = std::move(coarser);
    size = pyramid.levels.back();
  }
  return pyramid;
}

Rgba TextureSet::Lookup(int texture_idx, const Vec2d& texcoord) const {
  const Pyramid& pyramid = pyramids_[static_cast<size_t>(texture_idx)];
  const Level& level = pyramid.levels.front();
  const Neighbours<double> x(texcoord.x(), level.width_px);
  const Neighbours<double> y(texcoord.y(), level.height_px);
  const auto texel = [&](int i, int j) {
    return Decode(level.texels + 4 * (static_cast<ptrdiff_t>(j) * level.width_px + i),
                  pyramid.color_table,
                  linear_from_linear_.data());
  };
  const Rgba top = texel(x.first, y.first) * (1.0F - x.second_weight) +
                   texel(x.second, y.first) * x.second_weight;
  const Rgba bottom = texel(x.first, y.second) * (1.0F - x.second_weight) +
                      texel(x.second, y.second) * x.second_weight;
  return top * (1.0F - y.second_weight) + bottom * y.second_weight;
}

Rgba TextureSet::Bilinear(const Pyramid& pyramid, const Level& level, float u, float v) const {
  const Neighbours<float> x(u, level.width_px);
  const Neighbours<float> y(v, level.height_px);
  const auto texel = [&](int i, int j) {
    return Decode(level.texels + 4 * (static_cast<ptrdiff_t>(j) * level.width_px + i),
                  pyramid.color_table,
                  linear_from_linear_.data());
  };
  const Rgba top_left = texel(x.first, y.first);
  const Rgba bottom_left = texel(x.first, y.second);
  const Rgba top = top_left + (texel(x.second, y.first) - top_left) * x.second_weight;
  const Rgba bottom = bottom_left + (texel(x.second, y.second) - bottom_left) * x.second_weight;
  return top + (bottom - top) * y.second_weight;
}

Rgba TextureSet::LookupFiltered(int texture_idx,
                                const Vec2f& texcoord,
                                const Vec2f& footprint_x,
                                const Vec2f& footprint_y) const {
  const Pyramid& pyramid = pyramids_[static_cast<size_t>(texture_idx)];
  const Level& finest = pyramid.levels.front();
  const auto width = static_cast<float>(finest.width_px);
  const auto height = static_cast<float>(finest.height_px);
  const auto squared_texels = [&](const Vec2f& axis) {
    const float x = axis.x() * width;
    const float y = axis.y() * height;
    return x * x + y * y;
  };
  const float squared = std::max(squared_texels(footprint_x), squared_texels(footprint_y));
  if (!(squared > 1.0F)) {
    return Bilinear(pyramid, finest, texcoord.x(), texcoord.y());
  }
  const float position =
      std::min(0.5F * ApproximateLog2(squared), static_cast<float>(pyramid.levels.size() - 1));
  const auto below = static_cast<size_t>(position);
  const float weight = position - static_cast<float>(below);
  const Rgba fine = Bilinear(pyramid, pyramid.levels[below], texcoord.x(), texcoord.y());
  if (weight == 0.0F) {
    return fine;
  }
  const Rgba coarse = Bilinear(pyramid, pyramid.levels[below + 1], texcoord.x(), texcoord.y());
  return fine + (coarse - fine) * weight;
}

int64_t TextureSet::MemoryBytes() const {
  int64_t bytes = 0;
  for (const Pyramid& pyramid : pyramids_) {
    for (const Image<uint8_t>& texels : pyramid.coarser_texels) {
      bytes += static_cast<int64_t>(texels.Values().size());
    }
  }
  return bytes;
}

}  // namespace pfseq
