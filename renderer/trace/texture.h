// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfseq {

/// Red, green, blue in linear light, and alpha.
using Rgba = Eigen::Array4f;

/// Looks up the textures of a scene in linear light; sRGB values are decoded before they are
/// interpolated. The scene must outlive this.
class TextureSet {
 public:
  explicit TextureSet(const Scene& scene);
  TextureSet(const TextureSet&) = delete;
  TextureSet& operator=(const TextureSet&) = delete;

  /// Texel (i, j) of a texture of n x m texels has its centre at ((i + 0.5) / n, (j + 0.5) / m);
  /// between centres the interpolation is bilinear; both directions repeat. Alpha is never decoded.
  Rgba Lookup(int texture_idx, const Vec2d& texcoord) const;

  /// Mean over a footprint about the point: bilinear within and linear between the two levels of
  /// the texture's pyramid (Williams 1983, "Pyramidal parametrics") whose texels are about as wide
  /// as the footprint. The footprint is given by its two axes, differences of texture coordinates;
  /// the longer one, in texels, decides. Of a base colour cut out by alpha, coarser levels hold the
  /// mean colour of what is no hole: a ray that asks for it has met something.
  Rgba LookupFiltered(int texture_idx,
                      const Vec2f& texcoord,
                      const Vec2f& footprint_x,
                      const Vec2f& footprint_y) const;

  /// Bytes of the pyramids' coarser levels.
  int64_t MemoryBytes() const;

 private:
  /// A level of a pyramid: texels as in Texture, 4 bytes each.
  struct Level {
    const uint8_t* texels = nullptr;
    int width_px = 0;
    int height_px = 0;
  };
  struct Pyramid {
    /// Level 0 is the scene's own texture; the last has one texel.
    std::vector<Level> levels;
    std::vector<Image<uint8_t>> coarser_texels;
    const float* color_table = nullptr;
  };

  /// Texels of less than `hole_alpha` are holes; zero: there are none.
  Pyramid MakePyramid(const Texture& texture, float hole_alpha) const;
  Rgba Bilinear(const Pyramid& pyramid, const Level& level, float u, float v) const;

  std::array<float, 256> linear_from_srgb_{};
  std::array<float, 256> linear_from_linear_{};
  std::vector<Pyramid> pyramids_;
};

}  // namespace pfseq
