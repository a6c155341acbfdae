// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/building.h"

#include "tests/scenes/canyon/canyon_test_support.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Lot RowLot() {
  Lot lot;
  lot.footprint_m = {{0, 0}, {14, 0}, {14, 11}, {0, 11}};
  lot.edges = {EdgeKind::kStreet, EdgeKind::kParty, EdgeKind::kCourt, EdgeKind::kParty};
  return lot;
}

TEST(Building, StoreysFillItsHeightAndHaveHumanSize) {
  const Palette palette = PlainPalette();
  for (uint64_t seed = 0; seed < 500; ++seed) {
    const Building house =
        DesignBuilding(RowLot(), {}, {0.4, static_cast<double>(seed % 10) / 9.0}, palette, seed);
    EXPECT_GE(house.eave_m, 10.0);
    EXPECT_LE(house.eave_m, 35.0);
    EXPECT_NEAR(kKerbHeight_m + house.ground_floor_m +
                    house.num_upper_floors * house.floor_height_m + house.top_band_m,
                house.eave_m,
                1e-9);
    EXPECT_GT(house.floor_height_m, 2.7);
    EXPECT_LT(house.floor_height_m, 3.5);
    EXPECT_GT(house.ground_floor_m, 3.2);
    EXPECT_LT(house.ground_floor_m, 4.7);
    EXPECT_GE(house.top_band_m, 0.3 - 1e-9);
    EXPECT_GT(house.window.height_m, 1.0);
    EXPECT_LT(house.window.sill_m + house.window.height_m, house.floor_height_m - 0.3);
  }
}

TEST(Building, KeepsToExtremeHeights) {
  const Palette palette = PlainPalette();
  CanyonSpec canyon;
  for (const double height_m : {3.0, 5.0, 300.0}) {
    canyon.building_height_m = {height_m, height_m};
    for (uint64_t seed = 0; seed < 50; ++seed) {
      const Building house = DesignBuilding(RowLot(), canyon, {}, palette, seed);
      EXPECT_DOUBLE_EQ(house.eave_m, height_m);
      EXPECT_GT(house.ground_floor_m, 0.0);
    }
  }
}

TEST(Building, RoofsFollowTheShareOfPitchedOnes) {
  const Palette palette = PlainPalette();
  CanyonSpec canyon;
  for (const double share : {0.0, 1.0}) {
    canyon.pitched_roof_share = share;
    for (uint64_t seed = 0; seed < 200; ++seed) {
      const Building house = DesignBuilding(RowLot(), canyon, {}, palette, seed);
      EXPECT_EQ(house.roof == RoofKind::kFlat, share == 0.0);
    }
  }
}

TEST(Building, SmallPanesDivideTheWindowsOfTheirShare) {
  const Palette palette = PlainPalette();
  CanyonSpec canyon;
  canyon.small_panes = 0.4;
  int num_divided = 0;
  int num_with_frames = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const Building plain = DesignBuilding(RowLot(), {}, {}, palette, seed);
    const Building house = DesignBuilding(RowLot(), canyon, {}, palette, seed);
    EXPECT_EQ(house.style, plain.style);
    EXPECT_EQ(house.wall, plain.wall);
    const bool is_divided = house.window.num_columns == plain.window.num_columns + 1;
    if (is_divided) {
      EXPECT_EQ(house.window.transom_share, 0.5);
      EXPECT_NE(house.style, FacadeStyle::kGlass);
    } else {
      EXPECT_EQ(house.window.num_columns, plain.window.num_columns);
      EXPECT_EQ(house.frame, plain.frame);
    }
    num_divided += is_divided ? 1 : 0;
    num_with_frames += house.style != FacadeStyle::kGlass ? 1 : 0;
  }
  EXPECT_NEAR(num_divided, 0.4 * num_with_frames, 30.0);
}

TEST(Building, RubbleIsTheWallOfItsShareAndChangesNothingElse) {
  const Palette palette = PlainPalette();
  CanyonSpec canyon;
  canyon.rubble = 0.3;
  int num_rubble = 0;
  int num_walls = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const Building plain = DesignBuilding(RowLot(), {}, {}, palette, seed);
    const Building house = DesignBuilding(RowLot(), canyon, {}, palette, seed);
    EXPECT_FALSE(plain.is_rubble);
    EXPECT_FALSE(house.is_rubble && house.style == FacadeStyle::kGlass);
    EXPECT_EQ(house.wall, plain.wall);
    EXPECT_EQ(house.frame, plain.frame);
    EXPECT_EQ(house.eave_m, plain.eave_m);
    num_rubble += house.is_rubble ? 1 : 0;
    num_walls += house.style != FacadeStyle::kGlass ? 1 : 0;
  }
  EXPECT_NEAR(num_rubble, 0.3 * num_walls, 30.0);
}

TEST(Building, DetailChangesNeitherHeightNorStyleNorColour) {
  const Palette palette = PlainPalette();
  CanyonSpec bare;
  bare.detail = 0.0;
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const Building a = DesignBuilding(RowLot(), {}, {}, palette, seed);
    const Building b = DesignBuilding(RowLot(), bare, {}, palette, seed);
    EXPECT_EQ(a.eave_m, b.eave_m);
    EXPECT_EQ(a.style, b.style);
    EXPECT_EQ(a.wall, b.wall);
    EXPECT_EQ(a.roof, b.roof);
    EXPECT_EQ(b.balcony, BalconyPattern::kNone);
  }
}

TEST(Building, MansardTopLiesBehindTheStreetFrontsAlone) {
  Building house;
  house.lot = RowLot();
  house.mansard_inset_m = 1.5;
  const std::vector<Vec2d> top_m = MansardTop(house);
  EXPECT_TRUE(top_m[0].isApprox(Vec2d(0.0, 1.5)));
  EXPECT_TRUE(top_m[2].isApprox(Vec2d(14.0, 11.0)));
}

}  // namespace
}  // namespace pfseq
