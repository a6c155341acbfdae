// SPDX-License-Identifier: Apache-2.0
#include "validator/matching/match.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/features2d.hpp>

namespace pfseq {
namespace {

/// Noisy copies of each other, in another order.
Descriptors Rows(int count, Norm norm, int columns, int noise, uint64_t seed) {
  Descriptors descriptors;
  descriptors.norm = norm;
  descriptors.rows = cv::Mat(count, columns, CV_8U);
  RandomStream noise_of{seed};
  for (int row = 0; row < count; ++row) {
    const int place = seed % 2 == 0 ? row : (row * 7 + 3) % count;
    RandomStream random{99, static_cast<uint64_t>(place)};
    descriptors.key_point_idx.push_back(row);
    for (int i = 0; i < columns; ++i) {
      const int value = random.Integer(0, 255) + noise_of.Integer(-noise, noise);
      descriptors.rows.at<uint8_t>(row, i) = cv::saturate_cast<uint8_t>(value);
    }
  }
  return descriptors;
}

struct Pass {
  Pass(const Descriptors& first, const Descriptors& second)
      : classed_first(ClassedDescriptors::Whole(first)),
        classed_second(ClassedDescriptors::Whole(second)),
        tables(FindNearest(classed_first, classed_second, 1)) {}

  SubsetNeighbours All() const {
    return {&tables, &classed_first, &classed_second, {true}, {true}};
  }

  ClassedDescriptors classed_first;
  ClassedDescriptors classed_second;
  NearestTables tables;
};

std::vector<RowMatch> OpenCvCrossCheck(const Descriptors& first,
                                       const Descriptors& second,
                                       int norm) {
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(norm, true).match(first.rows, second.rows, matches);
  std::vector<RowMatch> rows;
  for (const cv::DMatch& match : matches) {
    rows.push_back({match.queryIdx, match.trainIdx});
  }
  return rows;
}

TEST(CrossCheckedMatches, AreThoseOfOpenCv) {
  for (const auto& [norm, cv_norm, columns] :
       {std::tuple(Norm::kL2, cv::NORM_L2, 128),
        std::tuple(Norm::kHamming, cv::NORM_HAMMING, 64),
        std::tuple(Norm::kHamming2, cv::NORM_HAMMING2, 32)}) {
    const Descriptors first = Rows(400, norm, columns, 60, 2);
    const Descriptors second = Rows(350, norm, columns, 60, 3);
    const std::vector<RowMatch> matches = CrossCheckedMatches(Pass(first, second).All());
    EXPECT_GT(matches.size(), 30U);
    EXPECT_EQ(matches, OpenCvCrossCheck(first, second, cv_norm)) << cv_norm;
  }
}

TEST(RatioMatches, AreThoseOfOpenCv) {
  const Descriptors first = Rows(300, Norm::kL2, 128, 120, 2);
  const Descriptors second = Rows(300, Norm::kL2, 128, 120, 3);
  std::vector<std::vector<cv::DMatch>> neighbours;
  cv::BFMatcher(cv::NORM_L2).knnMatch(first.rows, second.rows, neighbours, 2);
  std::vector<RowMatch> expected;
  for (const std::vector<cv::DMatch>& two : neighbours) {
    if (two[0].distance < 0.8 * two[1].distance) {
      expected.push_back({two[0].queryIdx, two[0].trainIdx});
    }
  }
  EXPECT_GT(expected.size(), 20U);
  EXPECT_LT(expected.size(), 300U);
  EXPECT_EQ(RatioMatches(Pass(first, second).All(), 0.8), expected);
}

TEST(RatioMatches, NeedASecondNeighbour) {
  const Descriptors first = Rows(5, Norm::kL2, 128, 0, 2);
  const Descriptors one = Rows(1, Norm::kL2, 128, 0, 2);
  EXPECT_TRUE(RatioMatches(Pass(first, one).All(), 0.8).empty());
  EXPECT_EQ(CrossCheckedMatches(Pass(first, one).All()).size(), 1U);
}

TEST(FlannMatches, AreNearlyTheRatioTestsAndRepeatable) {
  const Descriptors first = Rows(500, Norm::kL2, 128, 15, 2);
  const Descriptors second = Rows(500, Norm::kL2, 128, 15, 3);
  std::vector<int> rows(500);
  std::iota(rows.begin(), rows.end(), 0);
  const std::vector<RowMatch> matches = FlannMatches(first, rows, second, rows, {});
  EXPECT_EQ(matches, FlannMatches(first, rows, second, rows, {}));
  const std::vector<RowMatch> exact = RatioMatches(Pass(first, second).All(), 0.8);
  ASSERT_GT(exact.size(), 100U);
  size_t common = 0;
  for (const RowMatch& match : matches) {
    common += std::count(exact.begin(), exact.end(), match);
  }
  EXPECT_GT(common, exact.size() * 6 / 10);
}

TEST(FlannMatches, TakeOnlyTheRowsGiven) {
  const Descriptors first = Rows(100, Norm::kL2, 128, 5, 2);
  const std::vector<int> some = {3, 50, 70};
  EXPECT_EQ(FlannMatches(first, some, first, some, {}),
            (std::vector<RowMatch>{{3, 3}, {50, 50}, {70, 70}}));
  EXPECT_TRUE(FlannMatches(first, some, first, {3}, {}).empty());
  EXPECT_TRUE(FlannMatches(first, {}, first, some, {}).empty());
}

}  // namespace
}  // namespace pfseq
