// SPDX-License-Identifier: Apache-2.0
// How points are made to fit; agreement with OpenCV's own calls is tested in detect_test.cpp.
#include "validator/features/describe.h"

#include "tests/validator/features/test_images.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Setting DescriptorOf(const char* name) {
  return Setting(FindAlgorithm(KnownDescriptors(), name, "descriptor"));
}

class DescribeTest : public testing::Test {
 protected:
  Descriptors ByFast(const KeyPoints& points, const Setting& descriptor) const {
    return Describe(image_, points, fast_, descriptor);
  }

  const cv::Mat image_ = BlobImage(240, 240);
  const Setting fast_{FindAlgorithm(KnownDetectors(), "FAST", "detector")};
};

TEST_F(DescribeTest, TheSizeScaleStandsForTheSize) {
  for (const char* name : {"SIFT", "ORB", "BRISK", "FREAK"}) {
    Setting half = DescriptorOf(name);
    half.Set("sizeScale", 0.5);
    const Descriptors scaled = ByFast({{120.0F, 120.0F, 24.0F, 30.0F}}, half);
    const Descriptors plain = ByFast({{120.0F, 120.0F, 12.0F, 30.0F}}, DescriptorOf(name));
    ASSERT_EQ(scaled.rows.rows, 1) << name;
    EXPECT_EQ(cv::norm(scaled.rows, plain.rows, cv::NORM_L1), 0.0) << name;
    const Descriptors other = ByFast({{120.0F, 120.0F, 24.0F, 30.0F}}, DescriptorOf(name));
    ASSERT_EQ(other.rows.rows, 1) << name;
    // FREAK's and BRISK's patterns and SIFT's windows grow; ORB's small sizes share a level.
    if (std::string(name) != "ORB") {
      EXPECT_GT(cv::norm(scaled.rows, other.rows, cv::NORM_L1), 0.0) << name;
    }
  }
}

TEST_F(DescribeTest, NoAngleIsAnAngleOfZero) {
  for (const char* name : {"SIFT", "ORB"}) {
    const Descriptors without = ByFast({{120.0F, 120.0F, 12.0F, -1.0F}}, DescriptorOf(name));
    const Descriptors zero = ByFast({{120.0F, 120.0F, 12.0F, 0.0F}}, DescriptorOf(name));
    const Descriptors turned = ByFast({{120.0F, 120.0F, 12.0F, 90.0F}}, DescriptorOf(name));
    ASSERT_EQ(without.rows.rows, 1) << name;
    EXPECT_EQ(cv::norm(without.rows, zero.rows, cv::NORM_L1), 0.0) << name;
    if (std::string(name) == "SIFT") {
      EXPECT_GT(cv::norm(without.rows, turned.rows, cv::NORM_L1), 0.0);
    }
  }
}

TEST_F(DescribeTest, TinyPointsOfOthersAreNoTroubleToSift) {
  const KeyPoints points = {
      {120.0F, 120.0F, 0.001F}, {100.0F, 90.0F, 1.0F}, {60.0F, 60.0F, 500.0F}};
  const Descriptors descriptors = ByFast(points, DescriptorOf("SIFT"));
  EXPECT_EQ(descriptors.key_point_idx, (std::vector<int>{0, 1, 2}));
  // Below 2 px all count as 2.
  const Descriptors smallest = ByFast({{120.0F, 120.0F, 2.0F}}, DescriptorOf("SIFT"));
  EXPECT_EQ(cv::norm(descriptors.rows.row(0), smallest.rows, cv::NORM_L1), 0.0);
}

TEST_F(DescribeTest, RowsAreInThePointsOrder) {
  const KeyPoints points = {{150.0F, 90.0F, 9.0F}, {90.0F, 150.0F, 8.0F}, {120.0F, 120.0F, 12.0F}};
  for (const char* name : {"SIFT", "ORB", "BRISK", "FREAK", "BRIEF"}) {
    const Descriptors together = ByFast(points, DescriptorOf(name));
    for (size_t row = 0; row < together.key_point_idx.size(); ++row) {
      const int i = together.key_point_idx[row];
      EXPECT_TRUE(row == 0 || i > together.key_point_idx[row - 1]) << name;
      const Descriptors alone = ByFast({points[static_cast<size_t>(i)]}, DescriptorOf(name));
      EXPECT_EQ(cv::norm(together.rows.row(static_cast<int>(row)), alone.rows, cv::NORM_L1), 0.0)
          << name;
    }
    EXPECT_GE(together.key_point_idx.size(), 2U) << name;
  }
}

TEST_F(DescribeTest, WithoutPointsThereAreNoRows) {
  const Descriptors none = ByFast({}, DescriptorOf("ORB"));
  EXPECT_EQ(none.rows.rows, 0);
  EXPECT_TRUE(none.key_point_idx.empty());
  EXPECT_EQ(none.norm, Norm::kHamming);
}

TEST_F(DescribeTest, OrbDropsWhatHasNoTexture) {
  const cv::Mat flat(240, 240, CV_8U, cv::Scalar(90));
  EXPECT_EQ(Describe(flat, {{120.0F, 120.0F, 31.0F}}, fast_, DescriptorOf("ORB")).rows.rows, 0);
  EXPECT_EQ(Describe(flat, {{120.0F, 120.0F, 31.0F}}, fast_, DescriptorOf("BRIEF")).rows.rows, 1);
}

}  // namespace
}  // namespace pfseq
