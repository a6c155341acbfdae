// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/scene.h"

#include <array>
#include <vector>

namespace pfseq {

/// Red, green, blue, alpha in [0, 1].
using Rgba = Eigen::Array4f;

/// Looks up the textures of a scene. Texel (i, j) of a texture of n x m texels has its centre at
/// ((i + 0.5) / n, (j + 0.5) / m); between centres the interpolation is bilinear, on linear values;
/// both directions repeat. The texels stay where they are, 8 bits a channel: the scene must outlive
/// this.
class TextureSet {
 public:
  explicit TextureSet(const Scene& scene);

  /// Colours of sRGB textures are decoded, alpha never is. The texture's index must be in range.
  Rgba Lookup(int texture_idx, const Vec2d& texcoord) const;

 private:
  const std::vector<Texture>* textures_;
  std::array<float, 256> linear_from_srgb_;
  std::array<float, 256> linear_from_linear_;
};

}  // namespace pfseq
