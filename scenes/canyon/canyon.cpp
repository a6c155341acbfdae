// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/canyon.h"

#include "scenes/canyon/city.h"
#include "scenes/canyon/mesh_builder.h"
#include "scenes/canyon/palette.h"

#include <utility>

namespace pfseq {

Canyon BuildCanyonWithStats(const CanyonSpec& canyon, const DriveSpec& drive) {
  Palette palette = MakePalette();
  MeshBuilder builder(palette.texture_size_m);
  WallPaintings paintings(palette, canyon.texel_m);
  Canyon result;
  FacadePhotos photos;
  if (!canyon.facades.empty()) {
    photos = ReadFacadePhotos(canyon.facades);
  }
  BuildCity({builder,
             palette,
             canyon.detail,
             result.stats,
             &paintings,
             canyon.street_life,
             &photos,
             canyon.relief},
            canyon,
            drive);
  paintings.Finish(palette);
  result.scene.meshes = builder.TakeMeshes(palette.materials);
  result.scene.materials = std::move(palette.materials);
  result.scene.textures = std::move(palette.textures);
  return result;
}

Scene BuildCanyon(const CanyonSpec& canyon, const DriveSpec& drive) {
  return BuildCanyonWithStats(canyon, drive).scene;
}

}  // namespace pfseq
