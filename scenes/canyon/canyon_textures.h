// SPDX-License-Identifier: Apache-2.0
// Procedural textures of the city. All repeat without a seam unless they are atlases of pictures.
#pragma once

#include "renderer/core/random.h"
#include "renderer/trace/scene.h"
#include "scenes/canyon/mesh_builder.h"

#include <vector>

namespace pfseq {

/// A wall or ground texture: its colours, its normal map where it pays, and the size of the square
/// it covers.
struct SurfaceTexture {
  Texture color;
  /// Empty texels where there is none.
  Texture normal;
  double size_m = 1.0;
};

/// Near white, mottled; to be tinted.
SurfaceTexture PlasterTexture();
/// Mouldings, sills and surrounds: stone or stucco with soot, streaks and chips.
SurfaceTexture TrimTexture();
/// Bricks of 21 x 6.5 cm in stretcher bond with header courses; the hue is red or buff.
SurfaceTexture BrickTexture(bool is_red);
/// Blocks of 80 x 40 cm, near white.
SurfaceTexture AshlarTexture();
SurfaceTexture ConcreteTexture();
SurfaceTexture RoofTileTexture();
SurfaceTexture SlateTexture();
/// Sheet metal with standing seams every 60 cm.
SurfaceTexture SeamedMetalTexture();
SurfaceTexture GravelTexture();
SurfaceTexture AsphaltTexture();
SurfaceTexture PavementTexture();
/// Upright boards, near white.
SurfaceTexture WoodTexture();
/// Slats of shutters and roller blinds, near white.
SurfaceTexture SlatTexture();

/// Cells per side of the atlases below.
inline constexpr int kWindowAtlasCells = 12;
inline constexpr int kShopAtlasCells = 4;
inline constexpr int kSignAtlasColumns = 2;
inline constexpr int kSignAtlasRows = 16;

/// What shows behind window panes: dark rooms, curtains, blinds; kWindowAtlasCells squared
/// pictures.
Texture WindowAtlas(bool with_frames);
/// Shop interiors behind glass.
Texture ShopAtlas();
/// Lettered boards, eight times as wide as high.
Texture SignAtlas();
/// What stands on plates and bills in the street.
enum class StreetPicture { kSign, kPlate, kPoster };
/// 8 x 8 pictures: signs, plates and posters.
Texture StreetPictureAtlas();
/// A random picture of the kind.
TextureWindow StreetPictureCell(StreetPicture kind, RandomStream& random);

/// One storey and one module of a glass facade: pane, spandrel and mullions.
Texture CurtainWallTexture();

}  // namespace pfseq
