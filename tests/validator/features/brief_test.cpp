// SPDX-License-Identifier: Apache-2.0
#include "validator/features/brief.h"

#include "tests/validator/features/test_images.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace pfseq {
namespace {

double Distance(const Descriptors& a, const Descriptors& b) {
  return cv::norm(a.rows, b.rows, cv::NORM_HAMMING);
}

TEST(Brief, PointsWhosePatchLeavesTheImageAreLeftOut) {
  const cv::Mat image = BlobImage(100, 80);
  // The patch reaches 16 px to each side.
  const KeyPoints points = {{15.0F, 40.0F, 7.0F},
                            {16.0F, 40.0F, 7.0F},
                            {83.0F, 40.0F, 7.0F},
                            {84.0F, 40.0F, 7.0F},
                            {50.0F, 15.0F, 7.0F},
                            {50.0F, 63.0F, 7.0F},
                            {50.0F, 64.0F, 7.0F}};
  const Descriptors descriptors = DescribeBrief(image, points, 32);
  EXPECT_EQ(descriptors.key_point_idx, (std::vector<int>{1, 2, 5}));
  EXPECT_EQ(descriptors.rows.rows, 3);
  EXPECT_EQ(descriptors.rows.cols, 32);
  EXPECT_EQ(descriptors.norm, Norm::kHamming);
}

TEST(Brief, ShorterDescriptorsAreTheFrontOfLongerOnes) {
  const cv::Mat image = BlobImage(100, 100);
  const KeyPoints points = {{40.0F, 50.0F, 7.0F}, {60.0F, 45.0F, 7.0F}};
  const Descriptors longest = DescribeBrief(image, points, 64);
  for (const int num_bytes : {16, 32}) {
    const Descriptors shorter = DescribeBrief(image, points, num_bytes);
    EXPECT_EQ(cv::norm(shorter.rows, longest.rows.colRange(0, num_bytes), cv::NORM_HAMMING), 0.0);
  }
}

TEST(Brief, BrighterLightChangesNothing) {
  const cv::Mat image = BlobImage(100, 100);
  const KeyPoints points = {{50.0F, 50.0F, 7.0F}};
  const Descriptors before = DescribeBrief(0.5 * image, points, 64);
  const Descriptors after = DescribeBrief(0.5 * image + 60, points, 64);
  EXPECT_EQ(Distance(before, after), 0.0);
}

TEST(Brief, TheNegativeTurnsTheBits) {
  // Noise is nowhere equal, so that of each pair one is brighter, nearly always.
  const cv::Mat image = NoiseImage(64, 64);
  const KeyPoints points = {{32.0F, 32.0F, 7.0F}};
  const Descriptors positive = DescribeBrief(image, points, 64);
  const Descriptors negative = DescribeBrief(255 - image, points, 64);
  EXPECT_GT(Distance(positive, negative), 0.9 * 512);
}

TEST(Brief, FollowsTheImageButNotItsTurn) {
  const cv::Mat image = BlobImage(160, 160);
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, 5, 0, 1, -7);
  cv::Mat moved;
  cv::warpAffine(image, moved, shift, image.size());
  const Descriptors before = DescribeBrief(image, {{80.0F, 80.0F, 7.0F}}, 64);
  EXPECT_EQ(Distance(before, DescribeBrief(moved, {{85.0F, 73.0F, 7.0F}}, 64)), 0.0);
  EXPECT_GT(Distance(before, DescribeBrief(moved, {{80.0F, 80.0F, 7.0F}}, 64)), 50.0);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_180);
  EXPECT_GT(Distance(before, DescribeBrief(turned, {{79.0F, 79.0F, 7.0F}}, 64)), 100.0);
}

TEST(Brief, AnEvenPatchHasNoBits) {
  const cv::Mat image(64, 64, CV_8U, cv::Scalar(90));
  const Descriptors descriptors = DescribeBrief(image, {{32.0F, 32.0F, 7.0F}}, 16);
  EXPECT_EQ(cv::countNonZero(descriptors.rows), 0);
}

}  // namespace
}  // namespace pfseq
