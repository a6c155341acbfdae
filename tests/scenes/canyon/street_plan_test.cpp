// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_plan.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <algorithm>

namespace pfseq {
namespace {

TEST(StreetPlan, HoldsTheStreetsOfTheDrive) {
  DriveSpec drive;
  drive.first_street_m = 46.0;
  drive.cross_street_m = 60.0;
  drive.corner_radius_m = 8.0;
  const auto has = [](const std::vector<Street>& streets, double center_m) {
    return std::any_of(streets.begin(), streets.end(), [&](const Street& street) {
      return std::abs(street.center_m - center_m) < 1e-9;
    });
  };
  const StreetPlan left = PlanStreets({}, drive);
  EXPECT_TRUE(has(left.streets_along_x, 0.0));
  EXPECT_TRUE(has(left.streets_along_x, 76.0));
  EXPECT_TRUE(has(left.streets_along_y, 54.0));
  drive.turn = "right";
  EXPECT_TRUE(has(PlanStreets({}, drive).streets_along_x, -76.0));
}

TEST(StreetPlan, DrivePathFollowsTheU) {
  DriveSpec drive;
  drive.first_street_m = 10.0;
  drive.cross_street_m = 20.0;
  drive.last_street_m = 30.0;
  drive.corner_radius_m = 5.0;
  const std::vector<Vec2d> path_m = SampleDrivePath(drive, 0.5);
  EXPECT_TRUE(path_m.front().isZero());
  EXPECT_TRUE(path_m.back().isApprox(Vec2d(-20.0, 30.0), 1e-9));
  for (size_t i = 0; i + 1 < path_m.size(); ++i) {
    EXPECT_LE((path_m[i + 1] - path_m[i]).norm(), 0.5 + 1e-9);
  }
}

TEST(StreetPlan, BlocksDoNotTouchEachOtherOrTheDrive) {
  for (const uint64_t seed : {1U, 2U, 3U}) {
    CanyonSpec canyon;
    canyon.seed = seed;
    const StreetPlan plan = PlanStreets(canyon, {});
    for (size_t i = 0; i < plan.blocks.size(); ++i) {
      const PlanRect& a = plan.blocks[i].island;
      const std::vector<Vec2d> kerb_m = ChamferedRect(a, plan.blocks[i].island_chamfer_m);
      EXPECT_GT(DistanceToPath(kerb_m, plan.drive_path_m), 1.5) << i;
      for (size_t j = i + 1; j < plan.blocks.size(); ++j) {
        const PlanRect& b = plan.blocks[j].island;
        const Vec2d overlap_m = a.high_m.cwiseMin(b.high_m) - a.low_m.cwiseMax(b.low_m);
        EXPECT_LT(overlap_m.minCoeff(), 1e-9) << i << " and " << j;
      }
    }
  }
}

TEST(StreetPlan, StreetsHaveTheWidthsAskedFor) {
  CanyonSpec canyon;
  canyon.street_width_m = {20.0, 22.0};
  const StreetPlan plan = PlanStreets(canyon, {});
  for (const std::vector<Street>& streets : {plan.streets_along_x, plan.streets_along_y}) {
    for (const Street& street : streets) {
      EXPECT_GE(street.width_m, 20.0);
      EXPECT_LE(street.width_m, 22.0);
    }
  }
}

TEST(StreetPlan, StaysNearTheDriveHoweverManyRowsAreAskedFor) {
  CanyonSpec canyon;
  canyon.surrounding_blocks = 20;
  for (const double width_m : {4.0, 100.0}) {
    canyon.street_width_m = {width_m, width_m};
    DriveSpec drive;
    drive.last_street_m = 600.0;
    const StreetPlan plan = PlanStreets(canyon, drive);
    const double turn_m = drive.first_street_m + drive.corner_radius_m;
    const double across_m = drive.cross_street_m + 2.0 * drive.corner_radius_m;
    EXPECT_GT(plan.extent.low_m.x(), turn_m - 600.0 - 450.0);
    EXPECT_LT(plan.extent.high_m.x(), turn_m + 450.0);
    EXPECT_GT(plan.extent.low_m.y(), -450.0);
    EXPECT_LT(plan.extent.high_m.y(), across_m + 450.0);
  }
}

TEST(StreetPlan, HoldsTheWholeDriveWithoutSurroundings) {
  CanyonSpec canyon;
  canyon.surrounding_blocks = 0;
  const StreetPlan plan = PlanStreets(canyon, {});
  for (const Vec2d& point_m : plan.drive_path_m) {
    EXPECT_GE(point_m.x(), plan.streets_along_y.front().LowFacade());
    EXPECT_LE(point_m.x(), plan.streets_along_y.back().HighFacade());
  }
}

TEST(StreetPlan, CutsTheCornerThatAWideTurnNeeds) {
  CanyonSpec canyon;
  canyon.street_width_m = {12.0, 12.0};
  DriveSpec drive;
  drive.corner_radius_m = 30.0;
  const StreetPlan plan = PlanStreets(canyon, drive);
  double nearest_m = 1e9;
  for (const Block& block : plan.blocks) {
    nearest_m = std::min(
        nearest_m,
        DistanceToPath(ChamferedRect(block.island, block.island_chamfer_m), plan.drive_path_m));
    EXPECT_GT(DistanceToPath(ChamferedRect(block.lots, block.lots_chamfer_m), plan.drive_path_m),
              2.0);
  }
  EXPECT_GT(nearest_m, 1.5);
}

TEST(StreetPlan, RefusesFiguresOutOfRange) {
  CanyonSpec canyon;
  canyon.street_width_m = {3.0, 12.0};
  EXPECT_THAT(MessageOf<InputError>([&] { PlanStreets(canyon, {}); }),
              testing::HasSubstr("street_width_m"));
  canyon = {};
  canyon.building_height_m = {20.0, 10.0};
  EXPECT_THAT(MessageOf<InputError>([&] { PlanStreets(canyon, {}); }),
              testing::HasSubstr("building_height_m"));
  canyon = {};
  canyon.detail = 2.5;
  EXPECT_THAT(MessageOf<InputError>([&] { PlanStreets(canyon, {}); }),
              testing::HasSubstr("detail"));
  canyon = {};
  canyon.relief = 0.0;
  EXPECT_THAT(MessageOf<InputError>([&] { PlanStreets(canyon, {}); }),
              testing::HasSubstr("relief"));
  canyon = {};
  canyon.small_panes = 1.5;
  EXPECT_THAT(MessageOf<InputError>([&] { PlanStreets(canyon, {}); }),
              testing::HasSubstr("small_panes"));
  canyon = {};
  canyon.rubble = -0.5;
  EXPECT_THAT(MessageOf<InputError>([&] { PlanStreets(canyon, {}); }),
              testing::HasSubstr("rubble"));
  canyon = {};
  canyon.pitched_roof_share = 1.01;
  EXPECT_THAT(MessageOf<InputError>([&] { PlanStreets(canyon, {}); }),
              testing::HasSubstr("pitched_roof_share"));
  canyon = {};
  canyon.surrounding_blocks = -1;
  EXPECT_THAT(MessageOf<InputError>([&] { PlanStreets(canyon, {}); }),
              testing::HasSubstr("surrounding_blocks"));
}

TEST(DistanceToPath, IsZeroInsideAndEuclideanOutside) {
  const std::vector<Vec2d> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(DistanceToPath(square, {{1, 1}}), 0.0);
  EXPECT_NEAR(DistanceToPath(square, {{5, 6}, {9, 9}}), 5.0, 1e-12);
}

TEST(ChamferedRect, CutsCornersAtFortyFiveDegrees) {
  const std::vector<Vec2d> polygon_m = ChamferedRect({{0, 0}, {10, 6}}, {0.0, 2.0, 0.0, 0.0});
  ASSERT_EQ(polygon_m.size(), 5U);
  EXPECT_TRUE(polygon_m[1].isApprox(Vec2d(8, 0)));
  EXPECT_TRUE(polygon_m[2].isApprox(Vec2d(10, 2)));
}

}  // namespace
}  // namespace pfseq
