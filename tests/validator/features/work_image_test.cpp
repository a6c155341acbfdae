// SPDX-License-Identifier: Apache-2.0
#include "validator/features/work_image.h"

#include "renderer/lens/lens.h"
#include "tests/validator/test_sequence.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// One pixel of these values.
int GreyOfPixel(const std::vector<uint8_t>& channels) {
  Image<uint8_t> image(1, 1, static_cast<int>(channels.size()));
  for (size_t i = 0; i < channels.size(); ++i) {
    image.At(0, 0, static_cast<int>(i)) = channels[i];
  }
  return GreyOf(image).at<uint8_t>(0, 0);
}

TEST(GreyOf, WeighsRedGreenAndBlueAsBt601) {
  EXPECT_NEAR(GreyOfPixel({200, 0, 0}), 0.299 * 200, 1.0);
  EXPECT_NEAR(GreyOfPixel({0, 200, 0}), 0.587 * 200, 1.0);
  EXPECT_NEAR(GreyOfPixel({0, 0, 200}), 0.114 * 200, 1.0);
  // Alpha has no say.
  EXPECT_EQ(GreyOfPixel({90, 90, 90, 0}), 90);
  EXPECT_EQ(GreyOfPixel({123}), 123);
}

TEST(GreyOf, IsACopy) {
  Image<uint8_t> image(2, 1, 1, 7);
  GreyOf(image).setTo(99);
  EXPECT_EQ(image.At(0, 0), 7);
}

TEST(GreyOf, KeepsColumnsAndRows) {
  Image<uint8_t> image(3, 2, 1);
  image.At(2, 1) = 50;
  const cv::Mat grey = GreyOf(image);
  EXPECT_EQ(grey.cols, 3);
  EXPECT_EQ(grey.rows, 2);
  EXPECT_EQ(grey.at<uint8_t>(1, 2), 50);
}

class WorkImageTest : public testing::Test {
 protected:
  static constexpr int kSizePx = 300;
  const TestSequence sequence_ = TestSequence::Yard(kSizePx);
  const Lens& lens_ = sequence_.rig.lenses[0].value;
  const Image<uint8_t> image_{kSizePx, kSizePx, 1, 128};
};

TEST_F(WorkImageTest, OfTheFisheyeImageAllPointsCountHalfAPixelOn) {
  const WorkImage work = WorkImage::Fisheye(image_);
  const cv::KeyPoint point(10.25F, 20.0F, 7.0F);
  EXPECT_TRUE(work.Owns(point));
  // OpenCV's origin is the first pixel's centre, ours its corner.
  EXPECT_EQ(work.FisheyePixel(point).value(), Vec2d(10.75, 20.5));
}

TEST_F(WorkImageTest, OfThePolarImageTheMarginsDoNotCount) {
  const WorkImage work = WorkImage::Polar(image_, lens_);
  ASSERT_TRUE(work.polar.has_value());
  EXPECT_EQ(work.grey.cols, work.polar->WidthPx());
  EXPECT_EQ(work.grey.rows, work.polar->HeightPx());
  int num_owned = 0;
  for (int x = 0; x < work.grey.cols; ++x) {
    num_owned += work.Owns({static_cast<float>(x), 20.0F, 7.0F}) ? 1 : 0;
  }
  EXPECT_EQ(num_owned, work.polar->CoreWidthPx());
  EXPECT_FALSE(work.Owns({3.0F, 20.0F, 7.0F}));
}

TEST_F(WorkImageTest, PointsOfThePolarImageLieWhereTheLensHasThem) {
  const WorkImage work = WorkImage::Polar(image_, lens_);
  for (const cv::KeyPoint& point : {cv::KeyPoint(200.0F, 30.0F, 7.0F), {400.5F, 90.25F, 7.0F}}) {
    const Vec2d pixel = work.FisheyePixel(point).value();
    const Vec3d seen = lens_.Unproject(pixel).value();
    EXPECT_LT((seen - work.polar->DirectionCamera(point.pt.x, point.pt.y)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace pfseq
