// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/one_to_one.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using Points = std::vector<std::optional<Vec3d>>;

Points OnALine(const std::vector<double>& positions_m) {
  Points points;
  for (const double x_m : positions_m) {
    points.push_back(Vec3d(x_m, 1.0, -2.0));
  }
  return points;
}

std::vector<std::pair<int, int>> Indices(const std::vector<PointPair>& pairs) {
  std::vector<std::pair<int, int>> indices;
  for (const PointPair& pair : pairs) {
    indices.emplace_back(pair.first_idx, pair.second_idx);
  }
  return indices;
}

using Expected = std::vector<std::pair<int, int>>;

TEST(OneToOne, TakesTheClosestPairFirst) {
  // The second set's point is near both; the nearer one gets it, whatever the order.
  EXPECT_EQ(Indices(OneToOneClosestFirst(OnALine({0.0, 0.03}), OnALine({0.02}), 0.1)),
            (Expected{{1, 0}}));
  EXPECT_EQ(Indices(OneToOneClosestFirst(OnALine({0.03, 0.0}), OnALine({0.02}), 0.1)),
            (Expected{{0, 0}}));
}

TEST(OneToOne, ThenTheClosestOfThoseLeft) {
  // 1-0 (0.01) goes first; 0 is left with 1 at 0.06, not with 0 at 0.02.
  const std::vector<PointPair> pairs =
      OneToOneClosestFirst(OnALine({0.0, 0.03}), OnALine({0.02, -0.06}), 0.1);
  EXPECT_EQ(Indices(pairs), (Expected{{1, 0}, {0, 1}}));
  EXPECT_NEAR(pairs[0].distance_m, 0.01, 1e-12);
  EXPECT_NEAR(pairs[1].distance_m, 0.06, 1e-12);
}

TEST(OneToOne, LimitIsADistanceNotItsSquare) {
  EXPECT_EQ(OneToOneClosestFirst(OnALine({0.0}), OnALine({0.3}), 0.2).size(), 0U);
  EXPECT_EQ(OneToOneClosestFirst(OnALine({0.0}), OnALine({0.1}), 0.2).size(), 1U);
  EXPECT_EQ(OneToOneClosestFirst(OnALine({0.0}), OnALine({1.9}), 2.0).size(), 1U);
}

TEST(OneToOne, PairsAtTheLimitAreNotCloser) {
  EXPECT_EQ(OneToOneClosestFirst(OnALine({0.0}), OnALine({0.25}), 0.25).size(), 0U);
  EXPECT_EQ(OneToOneClosestFirst(OnALine({0.0}), OnALine({0.25}), 0.2501).size(), 1U);
}

TEST(OneToOne, EqualDistancesGoToSmallerIndices) {
  const Points same = OnALine({1.0, 1.0, 1.0});
  EXPECT_EQ(Indices(OneToOneClosestFirst(same, same, 0.1)), (Expected{{0, 0}, {1, 1}, {2, 2}}));
}

TEST(OneToOne, PointsWithoutAPositionKeepTheirIndexAndStayAlone) {
  Points first = OnALine({0.0, 5.0, 9.0});
  first[0] = std::nullopt;
  Points second = OnALine({0.0, 7.0, 5.01});
  second[1] = std::nullopt;
  EXPECT_EQ(Indices(OneToOneClosestFirst(first, second, 0.1)), (Expected{{1, 2}}));
}

TEST(OneToOne, EmptySetsHaveNoPairs) {
  EXPECT_TRUE(OneToOneClosestFirst({}, OnALine({1.0}), 1.0).empty());
  EXPECT_TRUE(OneToOneClosestFirst(OnALine({1.0}), {}, 1.0).empty());
  EXPECT_TRUE(OneToOneClosestFirst({std::nullopt}, {std::nullopt}, 1.0).empty());
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
  EXPECT_EQ(Indices(OneToOneClosestFirst(first, second, 0.15)), expected);
}

}  // namespace
}  // namespace pfseq
