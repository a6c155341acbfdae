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

/// Quantise(SrgbFromLinear(value)) by tables: a power for each texel would take longer than all
/// else.
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

/// A level of a pyramid while it is made.
struct LinearLevel {
  int width_px = 0;
  int height_px = 0;
  std::vector<Rgba> texels;
  /// The share of each texel that is no hole; empty: all of it.
  std::vector<float> solid;

  size_t At(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_px) + static_cast<size_t>(x);
  }
};

/// Half as many texels along each axis. Holes have no say in the colour of what is beside them.
LinearLevel Halved(const LinearLevel& finer) {
  LinearLevel coarser;
  coarser.width_px = std::max(1, finer.width_px / 2);
  coarser.height_px = std::max(1, finer.height_px / 2);
  coarser.texels.reserve(static_cast<size_t>(coarser.width_px) *
                         static_cast<size_t>(coarser.height_px));
  const bool has_holes = !finer.solid.empty();
  const std::vector<Overlap> columns = Overlaps(finer.width_px, coarser.width_px);
  const std::vector<Overlap> rows = Overlaps(finer.height_px, coarser.height_px);
  for (const Overlap& row : rows) {
    for (const Overlap& column : columns) {
      Rgba mean = Rgba::Zero();
      Rgba solid_sum = Rgba::Zero();
      float solid = 0.0F;
      for (int j = 0; j < row.count; ++j) {
        for (int i = 0; i < column.count; ++i) {
          const size_t texel = finer.At(column.first + i, row.first + j);
          const float share =
              row.weights[static_cast<size_t>(j)] * column.weights[static_cast<size_t>(i)];
          mean += finer.texels[texel] * share;
          if (has_holes) {
            solid_sum += finer.texels[texel] * (share * finer.solid[texel]);
            solid += share * finer.solid[texel];
          }
        }
      }
      if (solid > 0.0F) {
        mean.head<3>() = solid_sum.head<3>() / solid;
      }
      coarser.texels.push_back(mean);
      if (has_holes) {
        coarser.solid.push_back(solid);
      }
    }
  }
  return coarser;
}

/// Gives texels that are holes altogether the colour of the coarser level, which interpolation
/// next to them would take in (Gortler et al. 1996, "The Lumigraph": push-pull).
void FillHoles(LinearLevel& level, const LinearLevel& coarser) {
  for (size_t i = 0; i < level.solid.size(); ++i) {
    if (level.solid[i] == 0.0F) {
      const int x = static_cast<int>(i) % level.width_px;
      const int y = static_cast<int>(i) / level.width_px;
      level.texels[i].head<3>() = coarser
                                      .texels[coarser.At(std::min(x / 2, coarser.width_px - 1),
                                                         std::min(y / 2, coarser.height_px - 1))]
                                      .head<3>();
    }
  }
}

Image<uint8_t> Quantised(const LinearLevel& level, bool is_srgb) {
  static const SrgbQuantiser quantise_srgb;
  Image<uint8_t> texels(level.width_px, level.height_px, 4);
  for (int y = 0; y < level.height_px; ++y) {
    for (int x = 0; x < level.width_px; ++x) {
      const Rgba& value = level.texels[level.At(x, y)];
      for (int channel = 0; channel < 4; ++channel) {
        texels.At(x, y, channel) =
            is_srgb && channel < 3 ? quantise_srgb(value[channel]) : Quantise(value[channel]);
      }
    }
  }
  return texels;
}

/// The alpha below which a texel of each texture is a hole. Zero for textures that are no
/// masked material's base colour, or another material's besides.
std::vector<float> HoleAlphas(const Scene& scene) {
  constexpr float kUnused = std::numeric_limits<float>::infinity();
  std::vector<float> alphas(scene.textures.size(), kUnused);
  for (const Material& material : scene.materials) {
    if (material.base_color_texture_idx >= 0) {
      float& alpha = alphas[static_cast<size_t>(material.base_color_texture_idx)];
      const bool is_masked = material.alpha_cutoff.has_value() && material.base_alpha > 0.0F;
      alpha = std::min(alpha, is_masked ? *material.alpha_cutoff / material.base_alpha : 0.0F);
    }
  }
  std::replace(alphas.begin(), alphas.end(), kUnused, 0.0F);
  return alphas;
}

}  // namespace

TextureSet::TextureSet(const Scene& scene) : pyramids_(scene.textures.size()) {
  for (size_t i = 0; i < linear_from_srgb_.size(); ++i) {
    linear_from_linear_[i] = static_cast<float>(i) / 255.0F;
    linear_from_srgb_[i] = LinearFromSrgb(linear_from_linear_[i]);
  }
  const std::vector<float> hole_alphas = HoleAlphas(scene);
  ParallelFor(scene.textures.size(), NumHardwareThreads(), [&](size_t i) {
    pyramids_[i] = MakePyramid(scene.textures[i], hole_alphas[i]);
  });
}

TextureSet::Pyramid TextureSet::MakePyramid(const Texture& texture, float hole_alpha) const {
  Pyramid pyramid;
  pyramid.color_table = texture.is_srgb ? linear_from_srgb_.data() : linear_from_linear_.data();
  const auto level_of = [](const Image<uint8_t>& texels) {
    return Level{texels.Values().data(), texels.WidthPx(), texels.HeightPx()};
  };
  pyramid.levels.push_back(level_of(texture.texels));
  // Means are made of the finer level's linear light, in float, so that rounding to 8 bit does not
  // add up.
  std::vector<LinearLevel> levels(1);
  levels[0].width_px = texture.texels.WidthPx();
  levels[0].height_px = texture.texels.HeightPx();
  levels[0].texels.resize(texture.texels.NumPixels());
  for (size_t i = 0; i < levels[0].texels.size(); ++i) {
    levels[0].texels[i] =
        Decode(&texture.texels.Values()[4 * i], pyramid.color_table, linear_from_linear_.data());
  }
  if (hole_alpha > 0.0F) {
    for (const Rgba& texel : levels[0].texels) {
      levels[0].solid.push_back(texel[3] < hole_alpha ? 0.0F : 1.0F);
    }
  }
  while (levels.back().width_px > 1 || levels.back().height_px > 1) {
    levels.push_back(Halved(levels.back()));
  }
  for (size_t i = levels.size() - 1; i-- > 1;) {
    FillHoles(levels[i], levels[i + 1]);
  }
  for (size_t i = 1; i < levels.size(); ++i) {
    pyramid.coarser_texels.push_back(Quantised(levels[i], texture.is_srgb));
    pyramid.levels.push_back(level_of(pyramid.coarser_texels.back()));
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
