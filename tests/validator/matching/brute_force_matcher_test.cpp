// SPDX-License-Identifier: Apache-2.0
#include "validator/matching/brute_force_matcher.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

namespace pfseq {
namespace {

ByteDescriptors RandomDescriptors(int num_rows, int length, int max_value, uint64_t seed) {
  ByteDescriptors rows(length, num_rows, 1);
  RandomStream random{seed};
  for (uint8_t& value : rows.Values()) {
    value = static_cast<uint8_t>(random.Integer(0, max_value));
  }
  return rows;
}

std::vector<DescriptorMatch> MatchByDefinition(const ByteDescriptors& first,
                                               const ByteDescriptors& second) {
  const auto squared = [&](int a, int b) {
    int32_t sum = 0;
    for (int i = 0; i < first.WidthPx(); ++i) {
      const int32_t difference = int32_t{first.At(i, a)} - int32_t{second.At(i, b)};
      sum += difference * difference;
    }
    return sum;
  };
  std::vector<DescriptorMatch> matches;
  for (int a = 0; a < first.HeightPx(); ++a) {
    int b = 0;
    for (int i = 1; i < second.HeightPx(); ++i) {
      b = squared(a, i) < squared(a, b) ? i : b;
    }
    int back = 0;
    for (int i = 1; i < first.HeightPx(); ++i) {
      back = squared(i, b) < squared(back, b) ? i : back;
    }
    if (back == a) {
      matches.push_back({a, b, squared(a, b)});
    }
  }
  return matches;
}

std::vector<DescriptorMatch> MatchWithOpenCv(const ByteDescriptors& first,
                                             const ByteDescriptors& second) {
  const auto as_mat = [](const ByteDescriptors& rows) {
    cv::Mat floats;
    cv::Mat(rows.HeightPx(), rows.WidthPx(), CV_8U, const_cast<uint8_t*>(rows.Values().data()))
        .convertTo(floats, CV_32F);
    return floats;
  };
  std::vector<cv::DMatch> found;
  cv::BFMatcher(cv::NORM_L2, true).match(as_mat(first), as_mat(second), found);
  std::vector<DescriptorMatch> matches;
  for (const cv::DMatch& match : found) {
    matches.push_back({match.queryIdx, match.trainIdx, cvRound(match.distance * match.distance)});
  }
  std::sort(matches.begin(), matches.end(), [](const auto& a, const auto& b) {
    return a.first_idx < b.first_idx;
  });
  return matches;
}

struct Case {
  int num_first;
  int num_second;
  int length;
  int max_value;
};

class BruteForceMatcherCases : public testing::TestWithParam<Case> {};

TEST_P(BruteForceMatcherCases, EqualsTheDefinition) {
  const auto& [num_first, num_second, length, max_value] = GetParam();
  const ByteDescriptors first = RandomDescriptors(num_first, length, max_value, 1);
  const ByteDescriptors second = RandomDescriptors(num_second, length, max_value, 2);
  EXPECT_EQ(MatchBruteForce(first, second, 1), MatchByDefinition(first, second));
}

std::string CaseName(const testing::TestParamInfo<Case>& info) {
  return fmt::format("{}to{}of{}upTo{}",
                     info.param.num_first,
                     info.param.num_second,
                     info.param.length,
                     info.param.max_value);
}

// Odd sizes exercise the padding; few and small values make many ties.
INSTANTIATE_TEST_SUITE_P(Sizes,
                         BruteForceMatcherCases,
                         testing::Values(Case{1, 1, 128, 255},
                                         Case{3, 17, 128, 255},
                                         Case{130, 77, 128, 255},
                                         Case{64, 64, 2, 3},
                                         Case{301, 300, 7, 2},
                                         Case{50, 60, 1, 1}),
                         CaseName);

TEST(BruteForceMatcher, EqualsOpenCv) {
  const ByteDescriptors first = RandomDescriptors(1500, 128, 255, 3);
  const ByteDescriptors second = RandomDescriptors(1333, 128, 255, 4);
  const std::vector<DescriptorMatch> matches = MatchBruteForce(first, second, 2);
  EXPECT_GT(matches.size(), 100U);
  EXPECT_EQ(matches, MatchWithOpenCv(first, second));
}

TEST(BruteForceMatcher, IsTheSameForAnyNumberOfThreads) {
  // More than one task, with ties across them.
  const ByteDescriptors first = RandomDescriptors(3000, 4, 7, 5);
  const ByteDescriptors second = RandomDescriptors(2500, 4, 7, 6);
  const std::vector<DescriptorMatch> matches = MatchBruteForce(first, second, 1);
  EXPECT_EQ(matches, MatchBruteForce(first, second, 2));
  EXPECT_EQ(matches, MatchBruteForce(first, second, 5));
  EXPECT_EQ(matches, MatchByDefinition(first, second));
}

TEST(BruteForceMatcher, ExtremeValuesDoNotOverflow) {
  const ByteDescriptors white(2048, 1, 1, 255);
  const ByteDescriptors black(2048, 1, 1, 0);
  EXPECT_EQ(MatchBruteForce(white, black, 1),
            (std::vector<DescriptorMatch>{{0, 0, 2048 * 255 * 255}}));
}

TEST(BruteForceMatcher, EmptySetsHaveNoMatches) {
  const ByteDescriptors none(128, 0, 1);
  const ByteDescriptors one(128, 1, 1);
  EXPECT_TRUE(MatchBruteForce(none, one, 1).empty());
  EXPECT_TRUE(MatchBruteForce(one, none, 1).empty());
}

}  // namespace
}  // namespace pfseq
