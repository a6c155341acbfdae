// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/record_grid.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// A rectangle of 4 x 1 m in z = 0, as two triangles.
const std::array<Vec3f, 3> kCorners_m = {Vec3f(0, 0, 0), Vec3f(4, 0, 0), Vec3f(0, 1, 0)};
constexpr std::array<uint8_t, 2> kApexes = {0, 0};

RecordGrid Rectangle(float spacing_m) {
  return {kCorners_m, kApexes, [=](const Vec3f&, float) { return spacing_m; }};
}

/// The place that a stencil's records have in the mean.
Vec3f MeanPlace(const RecordGrid& grid, const RecordGrid::Stencil& stencil) {
  Vec3f place_m = Vec3f::Zero();
  for (size_t i = 0; i < static_cast<size_t>(stencil.count); ++i) {
    place_m += stencil.weights[i] * grid.PositionM(kCorners_m, stencil.records[i], 0.0F);
  }
  return place_m;
}

TEST(RecordGrid, StencilsStandForTheirPoint) {
  const RecordGrid grid = Rectangle(0.25F);
  for (float x = 0.1F; x < 3.9F; x += 0.13F) {
    for (float y = 0.1F; y < 0.9F; y += 0.11F) {
      const bool is_second = x / 4.0F + y > 1.0F;
      const RecordGrid::Stencil stencil = is_second
                                              ? grid.StencilAt(true, 1.0F - x / 4.0F, 1.0F - y)
                                              : grid.StencilAt(false, x / 4.0F, y);
      float sum = 0.0F;
      for (size_t i = 0; i < static_cast<size_t>(stencil.count); ++i) {
        EXPECT_GT(stencil.weights[i], 0.0F);
        EXPECT_LT(stencil.records[i], grid.NumRecords());
        sum += stencil.weights[i];
      }
      EXPECT_NEAR(sum, 1.0F, 1e-6F);
      if (!is_second) {
        EXPECT_LT((MeanPlace(grid, stencil) - Vec3f(x, y, 0.0F)).norm(), 1e-4F) << x << " " << y;
      }
    }
  }
}

TEST(RecordGrid, OutermostRecordsLieAFifthOfACellInside) {
  const RecordGrid grid = Rectangle(0.25F);
  EXPECT_EQ(grid.NumRecords(), 17U * 5U);
  float least_x = 4.0F;
  float greatest_y = 0.0F;
  for (uint32_t i = 0; i < grid.NumRecords(); ++i) {
    const Vec3f place_m = grid.PositionM(kCorners_m, i, 0.0F);
    least_x = std::min(least_x, place_m.x());
    greatest_y = std::max(greatest_y, place_m.y());
  }
  EXPECT_NEAR(least_x, 0.05F, 1e-5F);
  EXPECT_NEAR(greatest_y, 0.95F, 1e-5F);
}

TEST(RecordGrid, OffsetsMoveByCellsAndStayOnTheFace) {
  const RecordGrid grid = Rectangle(0.25F);
  for (uint32_t i = 0; i < grid.NumRecords(); ++i) {
    const Vec3f place_m = grid.PositionM(kCorners_m, i, 0.0F);
    const Vec3f moved_m = grid.PositionM(kCorners_m, i, 0.0F, Vec2f(0.5F, -0.5F));
    EXPECT_NEAR(moved_m.x(), std::min(4.0F, place_m.x() + 0.125F), 1e-5F);
    EXPECT_NEAR(moved_m.y(), std::max(0.0F, place_m.y() - 0.125F), 1e-5F);
  }
}

TEST(RecordGrid, SmallFacesHaveOneRecordInTheirMiddle) {
  const RecordGrid grid = Rectangle(10.0F);
  EXPECT_EQ(grid.NumRecords(), 1U);
  EXPECT_LT((grid.PositionM(kCorners_m, 0, 0.0F) - Vec3f(2.0F, 0.5F, 0.0F)).norm(), 1e-5F);
}

TEST(RecordGrid, StripsHaveRecordsAtBothLongEdges) {
  // 4 m by 0.2 m of the spacing, and hardly anything.
  const auto records_of_strip = [](float width_m) {
    const std::array<Vec3f, 3> corners_m = {Vec3f(0, 0, 0), Vec3f(4, 0, 0), Vec3f(0, width_m, 0)};
    return RecordGrid(
               corners_m, std::array<uint8_t, 2>{0, 0}, [](const Vec3f&, float) { return 0.5F; })
        .NumRecords();
  };
  EXPECT_EQ(records_of_strip(0.1F), 2U * 9U);
  EXPECT_EQ(records_of_strip(0.03F), 2U * 9U);
  EXPECT_EQ(records_of_strip(0.02F), 9U);
}

TEST(ParallelogramApexes, BentOnesAreNone) {
  // Skewed in their plane by less than a thousandth they are taken, off it only by rounding.
  const auto is_one = [](const Vec3f& last_corner_m) {
    Mesh mesh;
    mesh.positions_m = {{0, 0, 0}, {2, 0, 0}, last_corner_m, {0, 1, 0}};
    mesh.triangles = {{0, 1, 3}, {2, 3, 1}};
    return ParallelogramApexes(mesh, mesh.triangles[0], mesh.triangles[1]).has_value();
  };
  EXPECT_TRUE(is_one({2, 1, 0}));
  EXPECT_TRUE(is_one({2.001F, 1, 0}));
  EXPECT_FALSE(is_one({2.003F, 1, 0}));
  EXPECT_TRUE(is_one({2, 1, 1e-5F}));
  EXPECT_FALSE(is_one({2, 1, 2e-4F}));
  EXPECT_FALSE(is_one({2, 1, -2e-4F}));
}

}  // namespace
}  // namespace pfseq
