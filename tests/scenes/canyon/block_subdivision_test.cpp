// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/block_subdivision.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Block BlockOf(double width_m, double depth_m) {
  Block block;
  block.lots = {{10.0, 20.0}, {10.0 + width_m, 20.0 + depth_m}};
  block.island = {block.lots.low_m - Vec2d::Constant(2.5),
                  block.lots.high_m + Vec2d::Constant(2.5)};
  return block;
}

double Area(const std::vector<Vec2d>& polygon_m) {
  double sum = 0.0;
  for (size_t i = 0; i < polygon_m.size(); ++i) {
    const Vec2d& a = polygon_m[i];
    const Vec2d& b = polygon_m[(i + 1) % polygon_m.size()];
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

PlanRect BoundsOfLot(const Lot& lot) {
  PlanRect bounds{lot.footprint_m[0], lot.footprint_m[0]};
  for (const Vec2d& point_m : lot.footprint_m) {
    bounds.low_m = bounds.low_m.cwiseMin(point_m);
    bounds.high_m = bounds.high_m.cwiseMax(point_m);
  }
  return bounds;
}

class Subdivision : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(Subdivision, LotsAreDisjointAndInsideTheBlock) {
  const auto [width_m, depth_m] = GetParam();
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const Block block = BlockOf(width_m, depth_m);
    const std::vector<Lot> lots = SubdivideBlock(block, {{-100.0, 0.0}}, RandomStream({seed}));
    ASSERT_FALSE(lots.empty());
    for (size_t i = 0; i < lots.size(); ++i) {
      ASSERT_EQ(lots[i].edges.size(), lots[i].footprint_m.size());
      EXPECT_GT(Area(lots[i].footprint_m), 10.0) << "counter-clockwise, and of some size";
      const PlanRect a = BoundsOfLot(lots[i]);
      EXPECT_TRUE((a.low_m.array() >= block.lots.low_m.array() - 1e-9).all());
      EXPECT_TRUE((a.high_m.array() <= block.lots.high_m.array() + 1e-9).all());
      for (size_t j = i + 1; j < lots.size(); ++j) {
        const PlanRect b = BoundsOfLot(lots[j]);
        const Vec2d overlap_m = a.high_m.cwiseMin(b.high_m) - a.low_m.cwiseMax(b.low_m);
        EXPECT_LT(overlap_m.minCoeff(), 1e-9) << "seed " << seed << ": " << i << ", " << j;
      }
    }
  }
}

TEST_P(Subdivision, EveryStreetSideIsBuiltUpAlmostWholly) {
  const auto [width_m, depth_m] = GetParam();
  const std::vector<Lot> lots =
      SubdivideBlock(BlockOf(width_m, depth_m), {{-100.0, 0.0}}, RandomStream({7}));
  double street_m = 0.0;
  for (const Lot& lot : lots) {
    for (size_t i = 0; i < lot.edges.size(); ++i) {
      const Vec2d edge_m = lot.footprint_m[(i + 1) % lot.edges.size()] - lot.footprint_m[i];
      street_m += lot.edges[i] == EdgeKind::kStreet ? edge_m.norm() : 0.0;
    }
  }
  EXPECT_NEAR(street_m, 2.0 * (width_m + depth_m), 0.02 * (width_m + depth_m));
}

INSTANTIATE_TEST_SUITE_P(Sizes,
                         Subdivision,
                         testing::Values(std::pair(60.0, 40.0),
                                         std::pair(30.0, 70.0),
                                         std::pair(28.5, 28.5),
                                         std::pair(60.0, 20.0),
                                         std::pair(8.0, 50.0),
                                         std::pair(9.0, 9.0)),
                         [](const auto& test) {
                           return std::to_string(static_cast<int>(test.param.first)) + "x" +
                                  std::to_string(static_cast<int>(test.param.second));
                         });

TEST(SmallBlock, LeavesAFlatBlockOpen) {
  EXPECT_TRUE(SubdivideBlock(BlockOf(50.0, 4.0), {{-100.0, 0.0}}, RandomStream({1})).empty());
}

TEST(SmallBlock, LeavesOutLotsInTheDrivesWay) {
  const Block block = BlockOf(60.0, 40.0);
  const size_t all = SubdivideBlock(block, {{-100.0, 0.0}}, RandomStream({1})).size();
  EXPECT_EQ(SubdivideBlock(block, {{11.0, 21.0}}, RandomStream({1})).size(), all - 1);
}

}  // namespace
}  // namespace pfseq
