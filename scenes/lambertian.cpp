// SPDX-License-Identifier: Apache-2.0
#include "scenes/lambertian.h"

#include "renderer/trace/color.h"

#include <array>
#include <utility>
#include <vector>

namespace pfseq {
namespace {

constexpr int kNumColorChannels = 3;
constexpr uint8_t kWhite = 255;

/// The mean of a texture's colours after decoding.
Rgb MeanColor(const Texture& texture) {
  std::array<float, 256> linear{};
  for (size_t i = 0; i < linear.size(); ++i) {
    const float value = static_cast<float>(i) / 255.0F;
    linear[i] = texture.is_srgb ? LinearFromSrgb(value) : value;
  }
  std::array<double, kNumColorChannels> sum{};
  const int num_channels = texture.texels.NumChannels();
  const std::span<const uint8_t> values = texture.texels.Values();
  for (size_t i = 0; i < values.size(); i += static_cast<size_t>(num_channels)) {
    for (size_t k = 0; k < sum.size(); ++k) {
      sum[k] += linear[values[i + k]];
    }
  }
  const auto num_texels = static_cast<double>(texture.texels.NumPixels());
  return {static_cast<float>(sum[0] / num_texels),
          static_cast<float>(sum[1] / num_texels),
          static_cast<float>(sum[2] / num_texels)};
}

void WhitenColor(Texture& texture) {
  for (int y = 0; y < texture.texels.HeightPx(); ++y) {
    for (int x = 0; x < texture.texels.WidthPx(); ++x) {
      for (int k = 0; k < kNumColorChannels; ++k) {
        texture.texels.At(x, y, k) = kWhite;
      }
    }
  }
}

/// Leaves out the textures that no material's base colour refers to.
void DropUnusedTextures(Scene& scene) {
  std::vector<int> new_idx(scene.textures.size(), -1);
  std::vector<Texture> kept;
  for (Material& material : scene.materials) {
    if (material.base_color_texture_idx < 0) {
      continue;
    }
    const auto old_idx = static_cast<size_t>(material.base_color_texture_idx);
    if (new_idx[old_idx] < 0) {
      new_idx[old_idx] = static_cast<int>(kept.size());
      kept.push_back(std::move(scene.textures[old_idx]));
    }
    material.base_color_texture_idx = new_idx[old_idx];
  }
  scene.textures = std::move(kept);
}

}  // namespace

Scene LambertianScene(Scene scene) {
  for (Material& material : scene.materials) {
    material.metallic = 0.0F;
    material.roughness = 1.0F;
    material.metallic_roughness_texture_idx = -1;
    material.normal_texture_idx = -1;
    material.normal_scale = 1.0F;
    material.emission = Rgb::Zero();
    material.emission_texture_idx = -1;
    material.ior = 1.0F;
  }
  DropUnusedTextures(scene);
  return scene;
}

Scene UntexturedScene(Scene scene) {
  scene = LambertianScene(std::move(scene));
  std::vector<Rgb> means;
  for (Texture& texture : scene.textures) {
    means.push_back(MeanColor(texture));
    WhitenColor(texture);
  }
  for (Material& material : scene.materials) {
    if (material.base_color_texture_idx < 0) {
      continue;
    }
    material.base_color *= means[static_cast<size_t>(material.base_color_texture_idx)];
    if (!material.alpha_cutoff) {
      material.base_color_texture_idx = -1;
    }
  }
  DropUnusedTextures(scene);
  return scene;
}

}  // namespace pfseq
