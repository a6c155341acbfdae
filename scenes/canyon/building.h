// SPDX-License-Identifier: Apache-2.0
// One house as a set of decisions: style, storeys, windows, roof, materials.
#pragma once

#include "scenes/canyon/block_subdivision.h"
#include "scenes/canyon/palette.h"

#include <memory>
#include <string_view>
#include <vector>

namespace pfseq {

struct FacadePhoto;

/// 19th-century brick, plaster and ashlar; smooth fronts with bands of windows from between the
/// wars; post-war concrete; modern glass.
enum class FacadeStyle { kBrick, kPlaster, kAshlar, kInterwar, kConcrete, kGlass };
enum class RoofKind { kFlat, kMansard, kGable };
enum class BalconyPattern { kNone, kFrench, kSingle, kContinuous, kPlate };

std::string_view NameOf(FacadeStyle style);
std::string_view NameOf(RoofKind kind);

struct WindowDesign {
  /// Of the opening.
  double width_m = 1.2;
  double height_m = 1.7;
  double sill_m = 0.9;
  double reveal_m = 0.2;
  int num_columns = 2;
  /// Height of the transom's centre from the top, as a share; 0: none.
  double transom_share = 0.0;
  /// Whether lintel and jambs stand out from the wall, or the lintel alone.
  bool has_surround = false;
  bool has_lintel = false;
  bool has_shutters = false;
  /// Share of windows with a roller blind that is partly down.
  double blind_share = 0.0;
};

struct Building {
  Lot lot;
  FacadeStyle style = FacadeStyle::kPlaster;
  /// Distance from which each edge is seen on the drive, infinite where it is not; empty: unknown.
  std::vector<double> sight_m;
  /// What its street fronts in sight of the drive show instead of built storeys, or null.
  std::shared_ptr<const FacadePhoto> photo;
  /// Draws of this house start from here.
  uint64_t seed = 0;

  double ground_floor_m = 4.0;
  double floor_height_m = 3.2;
  /// Storeys above the ground floor.
  int num_upper_floors = 4;
  /// Wall between the last storey's ceiling and the eave or parapet.
  double top_band_m = 0.8;
  /// Eave or top of the parapet above the carriageway.
  double eave_m = 18.0;

  RoofKind roof = RoofKind::kFlat;
  /// Flat: the parapet above the roof. Mansard and gable: the roof above the eave.
  double roof_rise_m = 0.6;
  /// Mansard: how far its top lies behind the street fronts.
  double mansard_inset_m = 1.2;

  /// How long weather and soot have worked on it: 0 new, 1 neglected.
  double age = 0.5;

  double bay_width_m = 2.8;
  WindowDesign window;
  BalconyPattern balcony = BalconyPattern::kNone;
  bool has_shops = true;
  bool has_string_courses = false;
  /// Walls in sight of the drive are painted as rubble of the wall's colour.
  bool is_rubble = false;
  /// Stones that dress the corners of the wall, painted.
  bool has_quoins = false;
  /// 0: none.
  double cornice_m = 0.3;

  int wall = 0;
  int ground_wall = 0;
  int blank_wall = 0;
  int trim = 0;
  int frame = 0;
  int door = 0;
  int shutter = 0;
  int spandrel = 0;
  int roof_material = 0;
};

/// What the houses of a block have in common.
struct BlockCharacter {
  /// 0: old town; 1: modern.
  double modernity = 0.2;
  /// Where in the range of heights its houses lie, 0 to 1.
  double height_share = 0.4;
};

Building DesignBuilding(const Lot& lot,
                        const CanyonSpec& canyon,
                        const BlockCharacter& character,
                        const Palette& palette,
                        uint64_t seed);

/// The least and greatest coordinates of the footprint.
PlanRect BoundsOf(const Building& building);

/// The top of a mansard roof: the footprint with its street edges moved in.
std::vector<Vec2d> MansardTop(const Building& building);

}  // namespace pfseq
