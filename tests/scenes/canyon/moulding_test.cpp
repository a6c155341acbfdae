// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/moulding.h"

#include "renderer/trace/ray_scene.h"
#include "tests/scenes/canyon/canyon_test_support.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

const std::vector<Lod> kStreetAndBack = {Lod::kFine, Lod::kFlush, Lod::kFlush, Lod::kFlush};

TEST(Mouldings, StayWithinTheHousesWidth) {
  for (const RoofKind roof : {RoofKind::kFlat, RoofKind::kGable, RoofKind::kMansard}) {
    PartBench bench;
    Building house = RowHouse(bench.palette, FacadeStyle::kPlaster, 3, 2.0);
    house.roof = roof;
    BuildMouldings(bench.Context(2.0), house, kStreetAndBack);
    const Bounds bounds = BoundsOfScene(bench.TakeScene());
    EXPECT_GT(bounds.low_m.x(), 0.01F);
    EXPECT_LT(bounds.high_m.x(), 13.99F);
    EXPECT_LE(bounds.high_m.z(), house.eave_m + 1e-4);
    EXPECT_LT(bounds.low_m.y(), -0.2F) << "a cornice or an eave sticks out";
  }
}

TEST(Mouldings, EaveContinuesTheRoofsPlane) {
  PartBench bench;
  Building house = RowHouse(bench.palette, FacadeStyle::kPlaster, 3, 1.0);
  house.roof = RoofKind::kGable;
  house.roof_rise_m = 5.5;  // 45 degrees over half of 11 m
  BuildMouldings(bench.Context(0.0), house, kStreetAndBack);
  const RayScene rays(std::make_shared<const Scene>(bench.TakeScene()));
  const auto hit = rays.Intersect(Vec3d(7.0, -0.2, 100.0), -Vec3d::UnitZ());
  ASSERT_TRUE(hit);
  EXPECT_NEAR(100.0 - hit->distance_m, house.eave_m - 0.2, 1e-4);
}

TEST(Mouldings, RunAroundACornerInOnePiece) {
  PartBench bench;
  Building house = RowHouse(bench.palette, FacadeStyle::kPlaster, 3, 1.0);
  house.roof = RoofKind::kFlat;
  house.cornice_m = 0.4;
  house.lot.edges[1] = EdgeKind::kStreet;
  BuildMouldings(bench.Context(), house, {Lod::kFine, Lod::kFine, Lod::kFlush, Lod::kFlush});
  const RayScene rays(std::make_shared<const Scene>(bench.TakeScene()));
  // Above the corner, outside both walls: only a mitre reaches there.
  EXPECT_TRUE(rays.Intersect(Vec3d(14.3, -0.3, 100.0), -Vec3d::UnitZ()));
}

}  // namespace
}  // namespace pfseq
