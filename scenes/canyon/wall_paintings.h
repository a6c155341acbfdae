// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenes/canyon/mesh_builder.h"
#include "scenes/canyon/palette.h"
#include "scenes/canyon/wall_painting.h"

#include <map>
#include <vector>

namespace pfseq {

/// The painted walls of a city: ordered while it is built, painted at its end, on all threads.
class WallPaintings {
 public:
  /// `texel_m` is the texels' size at street level. The palette must outlive this.
  WallPaintings(const Palette& palette, double texel_m) : palette_(palette), texel_m_(texel_m) {}

  double TexelM() const { return texel_m_; }

  /// A new material of the builder whose textures are the painting laid on the facade; `wall` is
  /// the palette's material that it stands for.
  int Add(MeshBuilder& builder, const SurfaceFrame& facade, int wall, WallPainting painting);

  /// What a house's wall of this palette material looks like.
  WallLook LookOf(int wall, uint64_t house_seed, double age);

  /// Paints all and appends their materials and textures.
  void Finish(Palette& palette) const;

 private:
  struct Order {
    WallPainting painting;
    Material material;
  };

  const Palette& palette_;
  double texel_m_;
  std::vector<Order> orders_;
  std::map<int, Rgb> mean_colors_;
};

}  // namespace pfseq
