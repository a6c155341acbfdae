// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/building.h"

#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

/// Room that mouldings need between a window's head and the next storey's sill or slab.
constexpr double kHeadRoom_m = 0.5;

FacadeStyle ChooseStyle(const BlockCharacter& character, RandomStream& random) {
  if (random.Chance(character.modernity)) {
    return random.Chance(0.62) ? FacadeStyle::kConcrete : FacadeStyle::kGlass;
  }
  const double draw = random.Uniform();
  return draw < 0.20   ? FacadeStyle::kPlaster
         : draw < 0.56 ? FacadeStyle::kBrick
         : draw < 0.92 ? FacadeStyle::kAshlar
                       : FacadeStyle::kInterwar;
}

/// The range that a style's houses take within the canyon's range of heights.
double HeightShare(FacadeStyle style, const BlockCharacter& character, RandomStream& random) {
  const double spread = 0.6 * character.height_share + 0.4 * random.Uniform();
  switch (style) {
    case FacadeStyle::kBrick:
      return 0.05 + 0.45 * spread;
    case FacadeStyle::kPlaster:
      return 0.10 + 0.45 * spread;
    case FacadeStyle::kAshlar:
      return 0.25 + 0.35 * spread;
    case FacadeStyle::kInterwar:
      return 0.20 + 0.50 * spread;
    case FacadeStyle::kConcrete:
      return 0.30 + 0.55 * spread;
    case FacadeStyle::kGlass:
      return 0.45 + 0.55 * spread;
  }
  return spread;
}

void SetStoreys(double height_m, RandomStream& random, Building& building) {
  const bool is_modern =
      building.style == FacadeStyle::kConcrete || building.style == FacadeStyle::kGlass;
  building.eave_m = height_m;
  building.ground_floor_m = std::round(random.Uniform(3.8, 4.5) * 20.0) / 20.0;
  building.top_band_m =
      building.roof == RoofKind::kFlat ? random.Uniform(0.9, 1.3) : random.Uniform(0.55, 0.85);
  const double wanted_m = is_modern ? random.Uniform(2.9, 3.3) : random.Uniform(3.0, 3.4);
  const double upper_m = height_m - kKerbHeight_m - building.ground_floor_m - building.top_band_m;
  building.num_upper_floors = std::max(0, static_cast<int>(std::lround(upper_m / wanted_m)));
  if (building.num_upper_floors == 0) {
    building.top_band_m = std::min(building.top_band_m, 0.25 * height_m);
    building.ground_floor_m = height_m - kKerbHeight_m - building.top_band_m;
    building.floor_height_m = wanted_m;
    return;
  }
  // The storeys take what their number leaves, within human size; the ground floor and the top band
  // take the rest.
  building.floor_height_m = std::clamp(upper_m / building.num_upper_floors, 2.85, 3.45);
  const double rest_m = upper_m - building.num_upper_floors * building.floor_height_m;
  const double ground_share_m = std::clamp(building.ground_floor_m + rest_m, 3.3, 4.6);
  building.top_band_m += rest_m - (ground_share_m - building.ground_floor_m);
  building.ground_floor_m = ground_share_m;
  if (building.top_band_m < 0.3) {
    building.floor_height_m -= (0.3 - building.top_band_m) / building.num_upper_floors;
    building.top_band_m = 0.3;
  }
}

void SetRoof(const CanyonSpec& canyon, RandomStream& random, Building& building) {
  const bool is_modern =
      building.style == FacadeStyle::kConcrete || building.style == FacadeStyle::kGlass;
  const PlanRect bounds = BoundsOf(building);
  const double depth_m = building.lot.street_along_x ? bounds.Size().y() : bounds.Size().x();
  const double draw = random.Uniform();
  building.roof = RoofKind::kFlat;
  building.roof_rise_m = is_modern ? random.Uniform(0.5, 0.9) : random.Uniform(0.35, 0.6);
  // Modern houses are flat, so that the others bear more than the share.
  const double pitched_share =
      is_modern ? (canyon.pitched_roof_share >= 1.0 ? 1.0 : 0.15 * canyon.pitched_roof_share)
                : std::min(1.0, 1.4 * canyon.pitched_roof_share);
  if (draw >= pitched_share) {
    return;
  }
  const bool can_be_gable =
      building.lot.has_one_street_axis && building.lot.footprint_m.size() == 4;
  const bool prefers_mansard = building.style == FacadeStyle::kAshlar && random.Chance(0.75);
  if (can_be_gable && !prefers_mansard) {
    building.roof = RoofKind::kGable;
    const double slope_rad = random.Uniform(30.0, 44.0) * std::numbers::pi / 180.0;
    building.roof_rise_m = 0.5 * depth_m * std::tan(slope_rad);
  } else if (bounds.Size().minCoeff() > 6.0) {
    building.roof = RoofKind::kMansard;
    building.roof_rise_m = random.Uniform(2.7, 3.4);
    building.mansard_inset_m = building.roof_rise_m * random.Uniform(0.30, 0.42);
  }
}

void SetOpenings(const CanyonSpec& canyon, RandomStream& random, Building& building) {
  const double detail = canyon.detail;
  WindowDesign& window = building.window;
  const auto chance = [&](double probability) {
    return random.Chance(std::min(1.0, probability * detail));
  };
  const auto has_balconies = [&](double probability) {
    return chance(probability * canyon.relief);
  };
  switch (building.style) {
    case FacadeStyle::kBrick:
      building.bay_width_m = random.Uniform(2.2, 2.9);
      window = {
          random.Uniform(0.95, 1.25), random.Uniform(1.7, 1.95), 0.75, random.Uniform(0.12, 0.2)};
      window.num_columns = 2;
      window.transom_share = 0.5;
      window.has_lintel = chance(0.5);
      building.balcony = has_balconies(0.15) ? BalconyPattern::kFrench : BalconyPattern::kNone;
      building.has_string_courses = chance(0.6);
      building.has_quoins = chance(0.35);
      building.cornice_m = random.Uniform(0.2, 0.35);
      break;
    case FacadeStyle::kPlaster:
      building.bay_width_m = random.Uniform(2.5, 3.2);
      window = {
          random.Uniform(1.05, 1.35), random.Uniform(1.7, 2.0), 0.7, random.Uniform(0.16, 0.28)};
      window.transom_share = random.Chance(0.7) ? 0.28 : 0.0;
      window.has_surround = chance(0.65);
      window.has_shutters = !window.has_surround && chance(0.6);
      window.blind_share = chance(0.5) ? 0.4 : 0.0;
      building.balcony = has_balconies(0.35)  ? BalconyPattern::kSingle
                         : has_balconies(0.2) ? BalconyPattern::kFrench
                                              : BalconyPattern::kNone;
      building.has_string_courses = chance(0.75);
      building.has_quoins = chance(0.3);
      building.cornice_m = random.Uniform(0.3, 0.5);
      break;
    case FacadeStyle::kAshlar:
      building.bay_width_m = random.Uniform(2.5, 3.0);
      window = {
          random.Uniform(1.15, 1.35), random.Uniform(2.15, 2.35), 0.15, random.Uniform(0.22, 0.35)};
      window.transom_share = 0.24;
      window.has_surround = chance(0.8);
      building.balcony = detail <= 0.0        ? BalconyPattern::kNone
                         : has_balconies(0.8) ? BalconyPattern::kContinuous
                                              : BalconyPattern::kFrench;
      building.has_string_courses = chance(0.8);
      building.cornice_m = random.Uniform(0.4, 0.6);
      break;
    case FacadeStyle::kInterwar:
      building.bay_width_m = random.Uniform(2.7, 3.5);
      window = {building.bay_width_m - random.Uniform(0.7, 1.4),
                random.Uniform(1.3, 1.55),
                0.9,
                random.Uniform(0.08, 0.16)};
      window.num_columns = random.Integer(2, 4);
      window.transom_share = random.Chance(0.5) ? 0.33 : 0.0;
      window.blind_share = 0.35;
      building.balcony = has_balconies(0.3) ? BalconyPattern::kPlate : BalconyPattern::kNone;
      // Bands at the floors draw the storeys out.
      building.has_string_courses = building.balcony == BalconyPattern::kNone && chance(0.7);
      building.cornice_m = random.Chance(0.5) ? random.Uniform(0.12, 0.2) : 0.0;
      break;
    case FacadeStyle::kConcrete:
      building.bay_width_m = random.Uniform(3.0, 3.9);
      window = {building.bay_width_m - random.Uniform(0.8, 1.3),
                random.Uniform(1.4, 1.6),
                0.85,
                random.Uniform(0.12, 0.22)};
      window.num_columns = random.Integer(2, 3);
      window.blind_share = 0.45;
      building.balcony = has_balconies(0.5) ? BalconyPattern::kPlate : BalconyPattern::kNone;
      building.cornice_m = 0.0;
      break;
    case FacadeStyle::kGlass:
      building.bay_width_m = random.Uniform(1.3, 1.6);
      window.reveal_m = 0.1;
      building.cornice_m = 0.0;
      break;
  }
  // Windows fit between floor and ceiling whatever the storeys came out as.
  window.height_m =
      std::min(window.height_m, building.floor_height_m - kHeadRoom_m - window.sill_m);
  if (building.balcony == BalconyPattern::kFrench || building.balcony == BalconyPattern::kSingle) {
    window.height_m += window.sill_m - 0.15;
    window.sill_m = 0.15;
  }
  building.has_shops = random.Chance(building.style == FacadeStyle::kConcrete ? 0.5 : 0.68);
}

void SetMaterials(const Palette& palette, RandomStream& random, Building& building) {
  building.blank_wall = Pick(palette.blank_wall, random);
  building.trim = Pick(palette.trim, random);
  building.frame = Pick(palette.window_frame, random);
  building.door = Pick(palette.door, random);
  building.shutter = Pick(palette.shutter, random);
  building.spandrel = Pick(palette.spandrel, random);
  switch (building.style) {
    case FacadeStyle::kBrick:
      building.wall = Pick(palette.brick, random);
      building.ground_wall = random.Chance(0.5) ? building.wall : Pick(palette.trim, random);
      building.blank_wall = random.Chance(0.5) ? building.wall : building.blank_wall;
      break;
    case FacadeStyle::kPlaster:
      building.wall = Pick(palette.plaster, random);
      building.ground_wall =
          random.Chance(0.4) ? Pick(palette.ashlar, random) : Pick(palette.trim, random);
      break;
    case FacadeStyle::kAshlar:
      building.wall = Pick(palette.ashlar, random);
      building.ground_wall = building.wall;
      building.trim = palette.trim[static_cast<size_t>(random.Integer(0, 2))];
      break;
    case FacadeStyle::kInterwar:
      building.wall = Pick(random.Chance(0.65) ? palette.plaster : palette.brick, random);
      building.ground_wall = random.Chance(0.5) ? building.wall : Pick(palette.ashlar, random);
      break;
    case FacadeStyle::kConcrete:
      building.wall = Pick(palette.concrete, random);
      building.ground_wall = Pick(palette.concrete, random);
      building.frame = palette.window_frame[static_cast<size_t>(random.Integer(0, 1) * 4)];
      break;
    case FacadeStyle::kGlass:
      building.wall = Pick(palette.concrete, random);
      building.ground_wall = building.wall;
      building.frame = random.Chance(0.6) ? palette.pale_metal : palette.window_frame.back();
      break;
  }
  building.roof_material =
      building.roof == RoofKind::kFlat ? palette.roof_gravel
      : building.roof == RoofKind::kMansard
          ? (random.Chance(0.6) ? Pick(palette.slate, random) : palette.roof_metal)
      : random.Chance(0.7) ? Pick(palette.roof_tile, random)
                           : Pick(palette.slate, random);
}

/// Light bars between one column of panes more, in two rows.
void DivideWindows(const CanyonSpec& canyon,
                   const Palette& palette,
                   RandomStream& random,
                   Building& building) {
  if (building.style == FacadeStyle::kGlass || !random.Chance(canyon.small_panes)) {
    return;
  }
  ++building.window.num_columns;
  building.window.transom_share = 0.5;
  building.frame = palette.window_frame[static_cast<size_t>(random.Integer(0, 1))];
}

}  // namespace

std::string_view NameOf(FacadeStyle style) {
  switch (style) {
    case FacadeStyle::kBrick:
      return "brick";
    case FacadeStyle::kPlaster:
      return "plaster";
    case FacadeStyle::kAshlar:
      return "ashlar";
    case FacadeStyle::kInterwar:
      return "interwar";
    case FacadeStyle::kConcrete:
      return "concrete";
    case FacadeStyle::kGlass:
      return "glass";
  }
  return "";
}

std::string_view NameOf(RoofKind kind) {
  switch (kind) {
    case RoofKind::kFlat:
      return "flat";
    case RoofKind::kMansard:
      return "mansard";
    case RoofKind::kGable:
      return "gable";
  }
  return "";
}

Building DesignBuilding(const Lot& lot,
                        const CanyonSpec& canyon,
                        const BlockCharacter& character,
                        const Palette& palette,
                        uint64_t seed) {
  Building building;
  building.lot = lot;
  building.seed = seed;
  // Each group of decisions has a stream of its own: more detail must not change heights or
  // colours.
  RandomStream form({seed, 1});
  RandomStream openings({seed, 2});
  RandomStream materials({seed, 3});
  building.style = ChooseStyle(character, form);
  const double share = HeightShare(building.style, character, form);
  const auto [least_m, greatest_m] = canyon.building_height_m;
  const double height_m = std::round((least_m + share * (greatest_m - least_m)) * 100.0) / 100.0;
  SetRoof(canyon, form, building);
  SetStoreys(std::clamp(height_m, least_m, greatest_m), form, building);
  SetOpenings(canyon, openings, building);
  SetMaterials(palette, materials, building);
  RandomStream panes({seed, 5});
  DivideWindows(canyon, palette, panes, building);
  RandomStream walls({seed, 6});
  building.is_rubble = building.style != FacadeStyle::kGlass && walls.Chance(canyon.rubble);
  RandomStream weather({seed, 4});
  const bool is_old =
      building.style != FacadeStyle::kGlass && building.style != FacadeStyle::kConcrete;
  building.age = weather.Uniform(is_old ? 0.2 : 0.1, is_old ? 1.0 : 0.8);
  return building;
}

PlanRect BoundsOf(const Building& building) {
  PlanRect bounds{building.lot.footprint_m.front(), building.lot.footprint_m.front()};
  for (const Vec2d& point_m : building.lot.footprint_m) {
    bounds.low_m = bounds.low_m.cwiseMin(point_m);
    bounds.high_m = bounds.high_m.cwiseMax(point_m);
  }
  return bounds;
}

std::vector<Vec2d> MansardTop(const Building& building) {
  std::vector<double> inset_m;
  for (const EdgeKind kind : building.lot.edges) {
    inset_m.push_back(kind == EdgeKind::kStreet ? building.mansard_inset_m : 0.0);
  }
  return InsetPolygon(building.lot.footprint_m, inset_m);
}

}  // namespace pfseq
