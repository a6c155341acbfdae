// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_paintings.h"

#include "renderer/core/check.h"
#include "renderer/core/parallel.h"
#include "renderer/trace/color.h"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// Mean of a material's colour times its texture, sRGB-encoded.
Rgb MeanColor(const Material& material, const std::vector<Texture>& textures) {
  Vec3d mean = Vec3d::Ones();
  if (material.base_color_texture_idx >= 0) {
    const Image<uint8_t>& texels =
        textures[static_cast<size_t>(material.base_color_texture_idx)].texels;
    mean.setZero();
    int count = 0;
    // Every seventh texel of every fifth row tells the mean well enough.
    for (int y = 0; y < texels.HeightPx(); y += 5) {
      for (int x = 0; x < texels.WidthPx(); x += 7, ++count) {
        for (int channel = 0; channel < 3; ++channel) {
          mean[channel] += LinearFromSrgb(static_cast<float>(texels.At(x, y, channel)) / 255.0F);
        }
      }
    }
    mean /= count;
  }
  Rgb color;
  for (int channel = 0; channel < 3; ++channel) {
    color[channel] = SrgbFromLinear(static_cast<float>(mean[channel]) * material.base_color[channel]);
  }
  return color;
}

}  // namespace

WallLook WallPaintings::LookOf(int wall, uint64_t house_seed, double age) {
  WallLook look;
  const auto surface = palette_.wall_surface.find(wall);
  look.surface = surface != palette_.wall_surface.end() ? surface->second : WallSurface::kPlaster;
  const auto found = mean_colors_.find(wall);
  look.color = found != mean_colors_.end()
                   ? found->second
                   : MeanColor(palette_.materials[static_cast<size_t>(wall)], palette_.textures);
  mean_colors_[wall] = look.color;
  look.seed = house_seed;
  look.age = age;
  return look;
}

int WallPaintings::Add(MeshBuilder& builder,
                       const SurfaceFrame& facade,
                       int wall,
                       WallPainting painting) {
  painting.name = fmt::format("wall_{}", orders_.size());
  Material material = palette_.materials[static_cast<size_t>(wall)];
  material.name += fmt::format("_wall_{}", orders_.size());
  material.base_color = Rgb::Ones();
  material.roughness = 1.0F;
  // The outermost texels' centres lie on the rim, so that nothing wraps round.
  const WallRect& area = painting.area;
  const Vec2d size_m = area.high_m - area.low_m;
  const Vec2d texels = WallCanvas::SizeTexels(area.low_m, area.high_m, painting.texel_m);
  const Vec2d stretch = texels.cwiseQuotient(texels - Vec2d::Ones());
  const Vec2d origin_m(facade.origin_m.dot(facade.right), facade.origin_m.z());
  const Vec2d center_m = origin_m + 0.5 * (area.low_m + area.high_m);
  const Vec2d span_m = size_m.cwiseProduct(stretch);
  const int idx = builder.AddMaterial({span_m, center_m - 0.5 * span_m, true});
  PFSEQ_CHECK(static_cast<size_t>(idx) == palette_.materials.size() + orders_.size());
  orders_.push_back({std::move(painting), std::move(material)});
  return idx;
}

void WallPaintings::Finish(Palette& palette) const {
  std::vector<PaintedWall> walls(orders_.size());
  ParallelFor(orders_.size(), NumHardwareThreads(), [&](size_t i) {
    walls[i] = Paint(orders_[i].painting);
  });
  for (size_t i = 0; i < orders_.size(); ++i) {
    const auto add = [&](Texture& texture) {
      palette.textures.push_back(std::move(texture));
      return static_cast<int>(palette.textures.size()) - 1;
    };
    Material material = orders_[i].material;
    material.base_color_texture_idx = add(walls[i].color);
    material.normal_texture_idx = add(walls[i].normal);
    material.metallic_roughness_texture_idx = add(walls[i].roughness);
    palette.materials.push_back(material);
  }
}

}  // namespace pfseq
