// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/ground_floor.h"

#include "scenes/canyon/facade_clutter.h"
#include "scenes/canyon/painted_front.h"
#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

enum class UnitKind { kShop, kDoor, kWindow };

struct Unit {
  UnitKind kind = UnitKind::kWindow;
  Opening opening;
};

/// The foot of walls and openings: a little under the pavement.
constexpr double kFoot_m = kKerbHeight_m - 0.02;
constexpr double kSignBand_m = 0.75;
constexpr double kShopReveal_m = 0.18;

Unit MakeUnit(
    UnitKind kind, const Building& building, double left_m, double right_m, double head_m) {
  const double center_m = 0.5 * (left_m + right_m);
  const double width_m = right_m - left_m;
  Unit unit{kind, {}};
  switch (kind) {
    case UnitKind::kShop:
      unit.opening = {{left_m + 0.22, kFoot_m}, {right_m - 0.22, head_m - kSignBand_m}};
      break;
    case UnitKind::kDoor: {
      const double half_m = std::min(0.7, 0.5 * width_m - 0.3);
      unit.opening = {{center_m - half_m, kFoot_m},
                      {center_m + half_m, std::min(kKerbHeight_m + 2.75, head_m - 0.4)}};
      break;
    }
    case UnitKind::kWindow: {
      const double half_m = 0.5 * std::min(building.window.width_m, width_m - 0.5);
      const double sill_m = kKerbHeight_m + std::min(1.05, 0.3 * head_m);
      unit.opening = {{center_m - half_m, sill_m},
                      {center_m + half_m, std::min(sill_m + 1.9, head_m - 0.45)}};
      break;
    }
  }
  return unit;
}

std::vector<Unit> PlanUnits(
    const Building& building, double width_m, double head_m, bool has_door, RandomStream& random) {
  std::vector<Unit> units;
  const double unit_m = building.has_shops ? random.Uniform(3.4, 5.2) : building.bay_width_m;
  const int count = static_cast<int>(std::lround((width_m - 0.4) / unit_m));
  const int num_units = std::max(count, width_m > 2.2 ? 1 : 0);
  const int door_at = has_door && num_units > 0 ? random.Integer(0, num_units - 1) : -1;
  // A door takes less room than a shop.
  const double door_share = building.has_shops && num_units > 1 ? 0.6 : 1.0;
  const double whole_m = (width_m - 0.4) / (num_units - (door_at >= 0 ? 1.0 - door_share : 0.0));
  double left_m = 0.2;
  for (int i = 0; i < num_units; ++i) {
    const double right_m = left_m + (i == door_at ? door_share : 1.0) * whole_m;
    const UnitKind kind = i == door_at                                   ? UnitKind::kDoor
                          : building.has_shops && right_m - left_m > 1.6 ? UnitKind::kShop
                                                                         : UnitKind::kWindow;
    units.push_back(MakeUnit(kind, building, left_m, right_m, head_m));
    left_m = right_m;
  }
  std::erase_if(units, [](const Unit& unit) {
    return unit.opening.Width() < 0.6 || unit.opening.Height() < 0.6;
  });
  return units;
}

void BuildDoor(const BuildContext& context,
               const Building& building,
               const SurfaceFrame& facade,
               const Opening& opening,
               Lod lod,
               RandomStream& random) {
  MeshBuilder& builder = context.builder;
  const double reveal_m = std::max(0.2, building.window.reveal_m);
  BuildReveal(builder, building.ground_wall, facade, opening, 0.0, -reveal_m, false);
  const double light_m = opening.Height() > 2.4 ? 0.5 : 0.0;
  const double leaf_high_m = opening.high_m.y() - light_m;
  builder.Rectangle(
      building.door, facade, opening.low_m, {opening.high_m.x(), leaf_high_m}, -reveal_m);
  if (light_m > 0.0) {
    Glazing glazing{building.door, context.palette.window_glass};
    glazing.picture = AtlasCell(kWindowAtlasCells, random);
    BuildGlazing(
        builder, facade, {{opening.low_m.x(), leaf_high_m}, opening.high_m}, -reveal_m, glazing);
  }
  if (lod != Lod::kFine || context.detail <= 0.0) {
    return;
  }
  // Two leaves of three panels each, a handle and a threshold.
  const double leaf_m = 0.5 * opening.Width();
  for (const double left_m : {opening.low_m.x() + 0.08, opening.low_m.x() + leaf_m + 0.05}) {
    double foot_m = kKerbHeight_m + 0.22;
    const double panel_m = (leaf_high_m - foot_m - 0.3) / 3.0;
    for (int i = 0; i < 3; ++i) {
      AddBox(builder,
             building.door,
             facade,
             {left_m, foot_m, -reveal_m},
             {left_m + leaf_m - 0.13, foot_m + panel_m - 0.06, -reveal_m + 0.025},
             kFacesOnWall);
      foot_m += panel_m + 0.03;
    }
  }
  AddBox(builder,
         context.palette.pale_metal,
         facade,
         {opening.low_m.x() + leaf_m + 0.005, kKerbHeight_m + 1.0, -reveal_m},
         {opening.low_m.x() + leaf_m + 0.035, kKerbHeight_m + 1.25, -reveal_m + 0.06},
         kFacesOnWall);
  AddBox(builder,
         building.trim,
         facade,
         {opening.low_m.x() - 0.1, kFoot_m, 0.0},
         {opening.high_m.x() + 0.1, kKerbHeight_m + 0.07, 0.25},
         kFacesOnWall & ~kFaceBottom);
  AddBox(builder,
         building.trim,
         facade,
         {opening.low_m.x() + 0.001, kFoot_m, -reveal_m},
         {opening.high_m.x() - 0.001, kKerbHeight_m + 0.065, 0.0},
         kFaceTop);
}

void BuildSign(const BuildContext& context,
               int board,
               const SurfaceFrame& facade,
               const Opening& opening,
               RandomStream& random) {
  MeshBuilder& builder = context.builder;
  const double left_m = opening.low_m.x() - 0.08;
  const double right_m = opening.high_m.x() + 0.08;
  const double low_m = opening.high_m.y() + 0.08;
  const double high_m = low_m + std::clamp((right_m - left_m) / 8.0, 0.3, 0.5);
  constexpr double kBoard_m = 0.07;
  AddBox(builder,
         board,
         facade,
         {left_m, low_m, 0.0},
         {right_m, high_m, kBoard_m},
         kFacesOnWall & ~kFaceFront);
  const double half_m = std::min(0.5 * (right_m - left_m), 4.0 * (high_m - low_m));
  const double middle_m = 0.5 * (left_m + right_m);
  builder.Rectangle(board, facade, {left_m, low_m}, {middle_m - half_m, high_m}, kBoard_m);
  builder.Rectangle(board, facade, {middle_m + half_m, low_m}, {right_m, high_m}, kBoard_m);
  const int column = random.Integer(0, kSignAtlasColumns - 1);
  const int row = random.Integer(0, kSignAtlasRows - 1);
  const double width = 1.0 / kSignAtlasColumns;
  const double height = 1.0 / kSignAtlasRows;
  const TextureWindow picture =
      TextureWindow{column * width, row * height, (column + 1) * width, (row + 1) * height}.Part(
          0.003, 0.02, 0.997, 0.98);
  builder.PictureQuad(context.palette.sign,
                      facade.At(middle_m - half_m, low_m, kBoard_m),
                      facade.At(middle_m + half_m, low_m, kBoard_m),
                      facade.At(middle_m + half_m, high_m, kBoard_m),
                      facade.At(middle_m - half_m, high_m, kBoard_m),
                      picture);
}

/// A sloping cloth with a valance, closed on all sides but the wall's.
void BuildAwning(const BuildContext& context,
                 int material_idx,
                 const SurfaceFrame& facade,
                 double left_m,
                 double right_m,
                 double head_m) {
  constexpr double kReach_m = 0.9;
  constexpr double kThick_m = 0.02;
  const double front_m = head_m - 0.42;
  const double valance_m = front_m - 0.2;
  // (w, v) from the wall over the front and back to the wall.
  const std::array<Vec2d, 6> profile_m = {Vec2d(0.0, head_m),
                                          Vec2d(kReach_m, front_m),
                                          Vec2d(kReach_m, valance_m),
                                          Vec2d(kReach_m - kThick_m, valance_m),
                                          Vec2d(kReach_m - kThick_m, front_m - kThick_m),
                                          Vec2d(0.0, head_m - kThick_m)};
  const auto at = [&](double u, size_t i) {
    return facade.At(u, profile_m[i].y(), profile_m[i].x());
  };
  MeshBuilder& builder = context.builder;
  for (size_t i = 0; i + 1 < profile_m.size(); ++i) {
    builder.Quad(
        material_idx, at(left_m, i + 1), at(right_m, i + 1), at(right_m, i), at(left_m, i));
  }
  builder.Quad(material_idx, at(left_m, 5), at(left_m, 4), at(left_m, 1), at(left_m, 0));
  builder.Quad(material_idx, at(left_m, 4), at(left_m, 3), at(left_m, 2), at(left_m, 1));
  builder.Quad(material_idx, at(right_m, 0), at(right_m, 1), at(right_m, 4), at(right_m, 5));
  builder.Quad(material_idx, at(right_m, 1), at(right_m, 2), at(right_m, 3), at(right_m, 4));
}

void BuildShop(const BuildContext& context,
               const Building& building,
               const SurfaceFrame& facade,
               const Opening& opening,
               Lod lod,
               RandomStream& random) {
  MeshBuilder& builder = context.builder;
  ++context.stats.num_shops;
  const int front = Pick(context.palette.shop_front, random);
  const int cloth = Pick(context.palette.awning, random);
  const bool has_awning = random.Chance(context.Share(0.35));
  BuildReveal(builder, building.ground_wall, facade, opening, 0.0, -kShopReveal_m, false);
  const double riser_m = kKerbHeight_m + random.Uniform(0.35, 0.6);
  const double door_left_m = opening.high_m.x() - std::min(1.0, 0.4 * opening.Width());
  builder.Rectangle(front, facade, opening.low_m, {door_left_m, riser_m}, -kShopReveal_m);
  Glazing glazing{front, context.palette.shop_glass};
  glazing.picture = AtlasCell(kShopAtlasCells, random);
  glazing.num_columns =
      std::max(1, static_cast<int>(std::lround((door_left_m - opening.low_m.x()) / 1.4)));
  glazing.transom_share = opening.Height() > 2.8 ? 0.2 : 0.0;
  const double share = (door_left_m - opening.low_m.x()) / opening.Width();
  const TextureWindow whole = glazing.picture;
  glazing.picture = whole.Part(0.0, 0.0, share, 0.85);
  BuildGlazing(builder,
               facade,
               {{opening.low_m.x(), riser_m}, {door_left_m, opening.high_m.y()}},
               -kShopReveal_m,
               glazing);
  Glazing door{front, context.palette.shop_glass};
  door.num_columns = 1;
  door.transom_share = glazing.transom_share;
  door.rim_m = 0.1;
  door.picture = whole.Part(share, 0.0, 1.0, 1.0);
  BuildGlazing(
      builder, facade, {{door_left_m, opening.low_m.y()}, opening.high_m}, -kShopReveal_m, door);
  if (context.detail <= 0.0 || lod == Lod::kCoarse) {
    return;
  }
  BuildSign(context, front, facade, opening, random);
  RandomStream hanging({building.seed, 42, random.Bits()});
  if (!has_awning && hanging.Chance(std::min(1.0, 0.45 * context.street_life))) {
    BuildHangingSign(context, facade, opening.low_m.x() - 0.02, opening.high_m.y() + 0.9, hanging);
  }
  if (has_awning) {
    BuildAwning(
        context, cloth, facade, opening.low_m.x(), opening.high_m.x(), opening.high_m.y() + 0.05);
  }
}

}  // namespace

void BuildGroundFloor(const BuildContext& context,
                      const Building& building,
                      const SurfaceFrame& facade,
                      double width_m,
                      double head_m,
                      bool has_door,
                      double sight_m,
                      Lod lod,
                      RandomStream& random) {
  const std::vector<Unit> units = PlanUnits(building, width_m, head_m, has_door, random);
  std::vector<OpeningColumn> columns;
  for (const Unit& unit : units) {
    columns.push_back({unit.opening.low_m.x(),
                       unit.opening.high_m.x(),
                       {{unit.opening.low_m.y(), unit.opening.high_m.y()}}});
  }
  const int wall = OrderWall(context,
                             building,
                             facade,
                             building.ground_wall,
                             {{0.0, kFoot_m}, {width_m, head_m}},
                             columns,
                             sight_m,
                             lod);
  BuildWallWithOpenings(context.builder, wall, facade, {0.0, kFoot_m}, {width_m, head_m}, columns);
  Building plain = building;
  plain.window.has_shutters = false;
  for (const Unit& unit : units) {
    switch (unit.kind) {
      case UnitKind::kShop:
        BuildShop(context, building, facade, unit.opening, lod, random);
        break;
      case UnitKind::kDoor:
        BuildDoor(context, building, facade, unit.opening, lod, random);
        break;
      case UnitKind::kWindow:
        BuildWindow(context, plain, facade, unit.opening, building.ground_wall, lod, random);
        break;
    }
  }
}

}  // namespace pfseq
