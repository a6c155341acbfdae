// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/scene_points.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using Points = ScenePoints;

std::vector<PointPair> OneToOne(const Points& first_m, const Points& second_m, double limit_m) {
  return OneToOneWithinDistance({first_m, second_m}, limit_m);
}

Points OnALine(const std::vector<double>& positions_m) {
  Points points;
  for (const double x_m : positions_m) {
    points.push_back(Vec3d(x_m, 1.0, -2.0));
  }
  return points;
}

using Expected = std::vector<std::pair<int, int>>;

std::vector<std::pair<int, int>> Indices(const std::vector<PointPair>& pairs) {
  std::vector<std::pair<int, int>> indices;
  for (const PointPair& pair : pairs) {
    indices.emplace_back(pair.first_idx, pair.second_idx);
  }
  return indices;
}

TEST(OneToOne, TakesTheClosestPairFirst) {
  // The second set's point is near both; the nearer one gets it, whatever the order.
  EXPECT_EQ(Indices(OneToOne(OnALine({0.0, 0.03}), OnALine({0.02}), 0.1)), (Expected{{1, 0}}));
  EXPECT_EQ(Indices(OneToOne(OnALine({0.03, 0.0}), OnALine({0.02}), 0.1)), (Expected{{0, 0}}));
}

TEST(OneToOne, ThenTheClosestOfThoseLeft) {
  // 1-0 (0.01) goes first; 0 is left with 1 at 0.06, not with 0 at 0.02.
  const std::vector<PointPair> pairs = OneToOne(OnALine({0.0, 0.03}), OnALine({0.02, -0.06}), 0.1);
  EXPECT_EQ(Indices(pairs), (Expected{{1, 0}, {0, 1}}));
  EXPECT_NEAR(pairs[0].separation, 0.01, 1e-12);
  EXPECT_NEAR(pairs[1].separation, 0.06, 1e-12);
}

TEST(OneToOne, LimitIsADistanceNotItsSquare) {
  EXPECT_EQ(OneToOne(OnALine({0.0}), OnALine({0.3}), 0.2).size(), 0U);
  EXPECT_EQ(OneToOne(OnALine({0.0}), OnALine({0.1}), 0.2).size(), 1U);
  EXPECT_EQ(OneToOne(OnALine({0.0}), OnALine({1.9}), 2.0).size(), 1U);
}

TEST(OneToOne, PairsAtTheLimitAreNotCloser) {
  EXPECT_EQ(OneToOne(OnALine({0.0}), OnALine({0.25}), 0.25).size(), 0U);
  EXPECT_EQ(OneToOne(OnALine({0.0}), OnALine({0.25}), 0.2501).size(), 1U);
}

TEST(OneToOne, EqualDistancesGoToSmallerIndices) {
  const Points same = OnALine({1.0, 1.0, 1.0});
  EXPECT_EQ(Indices(OneToOne(same, same, 0.1)), (Expected{{0, 0}, {1, 1}, {2, 2}}));
}

TEST(OneToOne, PointsWithoutAPositionKeepTheirIndexAndStayAlone) {
  Points first = OnALine({0.0, 5.0, 9.0});
  first[0] = std::nullopt;
  Points second = OnALine({0.0, 7.0, 5.01});
  second[1] = std::nullopt;
  EXPECT_EQ(Indices(OneToOne(first, second, 0.1)), (Expected{{1, 2}}));
}

TEST(OneToOne, EmptySetsHaveNoPairs) {
  EXPECT_TRUE(OneToOne({}, OnALine({1.0}), 1.0).empty());
  EXPECT_TRUE(OneToOne(OnALine({1.0}), {}, 1.0).empty());
  EXPECT_TRUE(OneToOne({std::nullopt}, {std::nullopt}, 1.0).empty());
}

TEST(OneToOne, EqualsTheDefinitionOnRandomPoints) {
  RandomStream random{11};
  const auto points = [&random](int count) {
    Points result;
    for (int i = 0; i < count; ++i) {
      result.push_back(Vec3d(random.Uniform(), random.Uniform(), random.Uniform()));
    }
    return result;
  };
  const Points first = points(300);
  const Points second = points(280);
  std::vector<std::tuple<double, int, int>> all;
  for (int i = 0; i < 300; ++i) {
    for (int j = 0; j < 280; ++j) {
      all.emplace_back((*first[i] - *second[j]).norm(), i, j);
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<bool> first_taken(300), second_taken(280);
  Expected expected;
  for (const auto& [distance_m, i, j] : all) {
    if (distance_m < 0.15 && !first_taken[i] && !second_taken[j]) {
      first_taken[i] = second_taken[j] = true;
      expected.emplace_back(i, j);
    }
  }
  EXPECT_GT(expected.size(), 150U);
  EXPECT_EQ(Indices(OneToOne(first, second, 0.15)), expected);
}

TEST(OneToOneWithinAngle, SeesTheWayBetweenThePointsFromBothCameras) {
  // 1 m apart, 10 m off the second camera and 20 m off the first: the larger angle counts.
  PointsOfPair points{{Vec3d(0.0, 0.0, 10.0)}, {Vec3d(1.0, 0.0, 10.0)}};
  points.first_centre_m = Vec3d(0.0, 0.0, -10.0);
  const double angle_rad = std::atan(0.1);
  EXPECT_NEAR(AngleRad(points, 0, 0), angle_rad, 1e-12);
  EXPECT_EQ(OneToOneWithinAngle(points, angle_rad + 1e-9).size(), 1U);
  EXPECT_EQ(OneToOneWithinAngle(points, angle_rad - 1e-9).size(), 0U);
  std::swap(points.first_centre_m, points.second_centre_m);
  EXPECT_NEAR(AngleRad(points, 0, 0), angle_rad, 1e-12);
  EXPECT_EQ(OneToOneWithinAngle(points, angle_rad + 1e-9).size(), 1U);
}

TEST(OneToOneWithinAngle, ToleranceGrowsWithTheDistance) {
  const PointsOfPair points{{Vec3d(0.0, 0.0, 1.0), Vec3d(0.0, 0.0, 100.0)},
                            {Vec3d(0.05, 0.0, 1.0), Vec3d(0.05, 0.0, 100.0)}};
  EXPECT_EQ(Indices(OneToOneWithinAngle(points, 0.01)), (Expected{{1, 1}}));
}

}  // namespace
}  // namespace pfseq
