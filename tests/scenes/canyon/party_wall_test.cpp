// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/party_wall.h"

#include "tests/scenes/canyon/canyon_test_support.h"

#include <array>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// A house of 10 m along X and 12 m deep, its street to the south.
Building House(double left_m, double eave_m, double front_m = 0.0) {
  Building house;
  house.lot.footprint_m = {
      {left_m, front_m}, {left_m + 10, front_m}, {left_m + 10, 12}, {left_m, 12}};
  house.lot.edges = {EdgeKind::kStreet, EdgeKind::kParty, EdgeKind::kCourt, EdgeKind::kParty};
  house.eave_m = eave_m;
  return house;
}

/// The area of house 0's walls towards +X.
double EastArea(const std::vector<Building>& houses) {
  PartBench bench;
  BuildBlankWalls(houses, 0, bench.builder);
  double area_m2 = 0.0;
  const Scene scene = bench.TakeScene();
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3f vector = (mesh.positions_m[b] - mesh.positions_m[a])
                               .cross(mesh.positions_m[c] - mesh.positions_m[a]);
      area_m2 += std::max(0.0F, 0.5F * vector.x());
    }
  }
  return area_m2;
}

// Walls begin 4 cm under the pavement or the neighbour's roof.
constexpr double kSunk_m = 0.04;

TEST(PartyWall, AloneStandsFromThePavementToTheEave) {
  EXPECT_NEAR(EastArea({House(0, 20)}), 12.0 * (20.0 - kKerbHeight_m + kSunk_m), 1e-3);
}

TEST(PartyWall, ShowsOnlyAboveALowerNeighbour) {
  EXPECT_NEAR(EastArea({House(0, 20), House(10, 15)}), 12.0 * (5.0 + kSunk_m), 1e-3);
}

TEST(PartyWall, HidesBehindAHigherOrEqualNeighbour) {
  EXPECT_EQ(EastArea({House(0, 20), House(10, 25)}), 0.0);
  EXPECT_EQ(EastArea({House(0, 20), House(10, 20)}), 0.0);
}

TEST(PartyWall, ShowsBesideANeighbourThatStandsBack) {
  EXPECT_NEAR(
      EastArea({House(0, 20), House(10, 25, 0.5)}), 0.5 * (20.0 - kKerbHeight_m + kSunk_m), 1e-3);
}

TEST(PartyWall, OfAGableIsTheDifferenceOfTwoOutlines) {
  Building gable = House(0, 10);
  gable.roof = RoofKind::kGable;
  gable.roof_rise_m = 6.0;
  // Over a neighbour of 13 m the gable shows a triangle of half the width and half the rise.
  const double triangle_m2 = 0.5 * 6.0 * 3.0;
  EXPECT_NEAR(EastArea({gable, House(10, 13)}), triangle_m2 + 6.0 * kSunk_m, 0.3);
  // Seen from the neighbour: what is left of his 3 m beside the triangle.
  Building right = House(0, 13);
  Building left_gable = House(10, 10);
  left_gable.roof = RoofKind::kGable;
  left_gable.roof_rise_m = 6.0;
  EXPECT_NEAR(EastArea({right, left_gable}), 2.0 * 0.5 * 3.0 * 3.0 + 6.0 * kSunk_m, 0.1);
}

TEST(PartyWall, MansardOutlineSlopesBehindTheStreet) {
  Building house = House(0, 10);
  house.roof = RoofKind::kMansard;
  house.roof_rise_m = 3.0;
  house.mansard_inset_m = 1.0;
  const Outline outline = OutlineOf(house, 1);
  ASSERT_EQ(outline.size(), 4U);
  EXPECT_TRUE(outline[0].isApprox(Vec2d(0, 10)));
  EXPECT_TRUE(outline[1].isApprox(Vec2d(1, 13)));
  EXPECT_TRUE(outline[2].isApprox(Vec2d(12, 13)));
}

}  // namespace
}  // namespace pfseq
