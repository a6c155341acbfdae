// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/canyon_stats.h"

#include <iterator>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace pfseq {
namespace {

void AppendCounts(const std::string& title,
                  const std::map<std::string, int>& counts,
                  std::string& text) {
  text += title;
  for (const auto& [name, count] : counts) {
    fmt::format_to(std::back_inserter(text), "  {} {}", name, count);
  }
  text += '\n';
}

}  // namespace

std::string DescribeCanyon(const CanyonStats& stats, const Scene& scene) {
  Vec3f low_m = Vec3f::Constant(std::numeric_limits<float>::max());
  Vec3f high_m = -low_m;
  size_t num_vertices = 0;
  std::vector<size_t> triangles_of_material(scene.materials.size(), 0);
  for (const Mesh& mesh : scene.meshes) {
    num_vertices += mesh.positions_m.size();
    triangles_of_material[static_cast<size_t>(mesh.material_idx)] += mesh.triangles.size();
    for (const Vec3f& position_m : mesh.positions_m) {
      low_m = low_m.cwiseMin(position_m);
      high_m = high_m.cwiseMax(position_m);
    }
  }
  size_t num_texels = 0;
  for (const Texture& texture : scene.textures) {
    num_texels += texture.texels.NumPixels();
  }

  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "blocks {}  buildings {}  floors {}  windows {}  balconies {}  shops {}  dormers "
                 "{}  chimneys {}\n",
                 stats.num_blocks,
                 stats.num_buildings,
                 stats.num_floors,
                 stats.num_windows,
                 stats.num_balconies,
                 stats.num_shops,
                 stats.num_dormers,
                 stats.num_chimneys);
  fmt::format_to(
      out,
      "vehicles {}  trees {}  people {}  lamps {}  signs {}  wires {}  painted walls {}\n",
      stats.num_vehicles,
      stats.num_trees,
      stats.num_people,
      stats.num_lamps,
      stats.num_signs,
      stats.num_wires,
      stats.num_painted_walls);
  AppendCounts("styles:", stats.buildings_by_style, text);
  AppendCounts("roofs:", stats.buildings_by_roof, text);
  fmt::format_to(
      out, "building heights: {:.1f} to {:.1f} m\n", stats.least_height_m, stats.greatest_height_m);
  fmt::format_to(out,
                 "extent: x {:.1f} to {:.1f} m, y {:.1f} to {:.1f} m, z {:.2f} to {:.1f} m\n",
                 low_m.x(),
                 high_m.x(),
                 low_m.y(),
                 high_m.y(),
                 low_m.z(),
                 high_m.z());
  fmt::format_to(
      out,
      "meshes {}  materials {}  textures {} ({:.1f} megapixels)  vertices {}  triangles {}\n",
      scene.meshes.size(),
      scene.materials.size(),
      scene.textures.size(),
      static_cast<double>(num_texels) * 1e-6,
      num_vertices,
      scene.NumTriangles());
  text += "triangles by material:\n";
  for (size_t i = 0; i < triangles_of_material.size(); ++i) {
    if (triangles_of_material[i] > 0) {
      fmt::format_to(out, "  {:<28} {}\n", scene.materials[i].name, triangles_of_material[i]);
    }
  }
  return text;
}

}  // namespace pfseq
