// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/texture.h"

#include "renderer/trace/color.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pfseq {
namespace {

/// Two neighbouring texels along one axis and the weight of the second.
struct Neighbours {
  int first;
  int second;
  float second_weight;
};

Neighbours NeighboursAt(double coordinate, int num_texels) {
  const double position = (coordinate - std::floor(coordinate)) * num_texels - 0.5;
  const double below = std::floor(position);
  const auto first = static_cast<int>(below);
  // The position lies in [-0.5, num_texels - 0.5], so one step wraps either way.
  return {first < 0 ? num_texels - 1 : first,
          first + 1 >= num_texels ? 0 : first + 1,
          static_cast<float>(position - below)};
}

}  // namespace

TextureSet::TextureSet(const Scene& scene) : textures_(&scene.textures) {
  for (size_t i = 0; i < linear_from_srgb_.size(); ++i) {
    linear_from_linear_[i] = static_cast<float>(i) / 255.0F;
    linear_from_srgb_[i] = LinearFromSrgb(linear_from_linear_[i]);
  }
}

Rgba TextureSet::Lookup(int texture_idx, const Vec2d& texcoord) const {
  const Texture& texture = (*textures_)[static_cast<size_t>(texture_idx)];
  const Neighbours x = NeighboursAt(texcoord.x(), texture.texels.WidthPx());
  const Neighbours y = NeighboursAt(texcoord.y(), texture.texels.HeightPx());
  const std::array<float, 256>& linear = texture.is_srgb ? linear_from_srgb_ : linear_from_linear_;
  const auto texel = [&](int i, int j) {
    const uint8_t* values = &texture.texels.At(i, j);
    return Rgba(
        linear[values[0]], linear[values[1]], linear[values[2]], linear_from_linear_[values[3]]);
  };
  const Rgba top = texel(x.first, y.first) * (1.0F - x.second_weight) +
                   texel(x.second, y.first) * x.second_weight;
  const Rgba bottom = texel(x.first, y.second) * (1.0F - x.second_weight) +
                      texel(x.second, y.second) * x.second_weight;
  return top * (1.0F - y.second_weight) + bottom * y.second_weight;
}

}  // namespace pfseq
