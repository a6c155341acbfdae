// SPDX-License-Identifier: Apache-2.0
#include "validator/features/censure.h"

#include "tests/validator/features/test_images.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

const cv::KeyPoint* Nearest(const KeyPoints& points, float x, float y) {
  const auto nearest =
      std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
        return std::hypot(a.pt.x - x, a.pt.y - y) < std::hypot(b.pt.x - x, b.pt.y - y);
      });
  return nearest == points.end() ? nullptr : &*nearest;
}

/// A disc of a radius on plain grey.
cv::Mat Disc(int radius, int inside, int outside) {
  cv::Mat image(161, 181, CV_8U, cv::Scalar(outside));
  cv::circle(image, cv::Point(90, 80), radius, cv::Scalar(inside), cv::FILLED);
  return image;
}

CensureSetting Wide() {
  CensureSetting setting;
  setting.max_size = 64;
  return setting;
}

TEST(Censure, FindsTheCentreAndSizeOfADisc) {
  float previous_size = 0.0F;
  for (const int radius : {3, 6, 12}) {
    for (const auto& [inside, outside] : {std::pair(220, 40), std::pair(40, 220)}) {
      const KeyPoints points = DetectCensure(Disc(radius, inside, outside), Wide());
      const cv::KeyPoint* centre = Nearest(points, 90.0F, 80.0F);
      ASSERT_NE(centre, nullptr);
      EXPECT_NEAR(centre->pt.x, 90.0F, 1.0F) << radius;
      EXPECT_NEAR(centre->pt.y, 80.0F, 1.0F) << radius;
      // The inner star has about the disc's area.
      EXPECT_GT(centre->size, 1.2F * radius);
      EXPECT_LT(centre->size, 2.8F * radius);
      if (inside == 220) {
        EXPECT_GT(centre->size, previous_size);
        previous_size = centre->size;
      }
    }
  }
}

TEST(Censure, ResponseIsTheContrastOfAPerfectBlob) {
  // In a disc that fills the inner star, before a ring that is all outside, it nears the full step.
  const KeyPoints points = DetectCensure(Disc(6, 200, 100), Wide());
  const cv::KeyPoint* centre = Nearest(points, 90.0F, 80.0F);
  ASSERT_NE(centre, nullptr);
  EXPECT_GT(centre->response, 65.0F);
  EXPECT_LE(centre->response, 100.0F);
}

TEST(Censure, BlobsBeyondTheScalesOnEitherSideAreNotFound) {
  const auto has_centre = [](int radius, int max_size) {
    CensureSetting setting;
    setting.max_size = max_size;
    const KeyPoints points = DetectCensure(Disc(radius, 220, 40), setting);
    const cv::KeyPoint* nearest = Nearest(points, 90.0F, 80.0F);
    return nearest != nullptr && std::hypot(nearest->pt.x - 90.0F, nearest->pt.y - 80.0F) < 2.0F;
  };
  EXPECT_TRUE(has_centre(3, 8));
  EXPECT_FALSE(has_centre(6, 8));  // strongest at the largest star, as far as that can tell
  EXPECT_TRUE(has_centre(6, 32));
  EXPECT_FALSE(has_centre(0, 32));  // a single pixel
  EXPECT_FALSE(has_centre(3, 4));   // two scales, no inner one
}

TEST(Censure, PlainImagesRampsAndEdgesHaveNoPoints) {
  cv::Mat image(120, 120, CV_8U, cv::Scalar(255));
  EXPECT_TRUE(DetectCensure(image, Wide()).empty());
  for (int x = 0; x < 120; ++x) {
    image.col(x).setTo(2 * x);
  }
  EXPECT_TRUE(DetectCensure(image, Wide()).empty());
  // A bar is a line: its response is strong, but not well placed (but for where the stars end to
  // fit into the image).
  image.setTo(50);
  image.colRange(55, 63).setTo(220);
  for (const cv::KeyPoint& point : DetectCensure(image, CensureSetting())) {
    EXPECT_TRUE(point.pt.y < 50.0F || point.pt.y > 70.0F) << point.pt;
  }
}

TEST(Censure, LooserThresholdsOnlyAddPoints) {
  const cv::Mat image = BlobImage(320, 240);
  const auto detect = [&](int projected, int window, int response) {
    CensureSetting setting;
    setting.line_threshold_projected = projected;
    setting.line_threshold_binarized = projected - 2;
    setting.suppress_nonmax_size = window;
    setting.response_threshold = response;
    return DetectCensure(image, setting);
  };
  const KeyPoints loose = detect(20, 3, 20);
  for (const KeyPoints& strict : {detect(10, 3, 20), detect(20, 7, 20), detect(20, 3, 40)}) {
    EXPECT_LT(strict.size(), loose.size());
    EXPECT_GT(strict.size(), 10U);
    for (const cv::KeyPoint& point : strict) {
      EXPECT_TRUE(std::any_of(loose.begin(), loose.end(), [&](const cv::KeyPoint& other) {
        return other.pt == point.pt && other.size == point.size;
      }));
    }
  }
}

TEST(Censure, SettingsTogetherAreAsEachAlone) {
  const cv::Mat image = BlobImage(200, 180);
  std::vector<CensureSetting> settings(3);
  settings[0].max_size = 8;
  settings[1].max_size = 32;
  settings[2].suppress_nonmax_size = 7;
  const std::vector<KeyPoints> together = DetectCensure(image, settings);
  for (size_t i = 0; i < settings.size(); ++i) {
    const KeyPoints alone = DetectCensure(image, settings[i]);
    ASSERT_EQ(alone.size(), together[i].size());
    for (size_t k = 0; k < alone.size(); ++k) {
      EXPECT_EQ(alone[k].pt, together[i][k].pt);
      EXPECT_LT(alone[k].size, static_cast<float>(settings[i].max_size));
      EXPECT_GE(alone[k].size, 4.0F);
    }
  }
}

TEST(Censure, PointsRepeatUnderRotationScaleAndBlur) {
  const cv::Mat image = BlobImage(480, 480);
  CensureSetting setting;
  setting.max_size = 32;
  const KeyPoints first = DetectCensure(image, setting);
  ASSERT_GT(first.size(), 200U);
  const auto share = [&](double angle_deg, double scale, double distance_px) {
    const WarpedView view(image, angle_deg, scale);
    return RepeatedShare(first, DetectCensure(view.warped, setting), view, distance_px);
  };
  EXPECT_GT(share(0.0, 1.0, 0.5), 0.999);
  EXPECT_GT(share(90.0, 1.0, 1.1), 0.9);
  EXPECT_GT(share(30.0, 1.0, 2.5), 0.5);
  EXPECT_GT(share(0.0, 1.25, 2.5), 0.45);
  WarpedView blurred(image, 0.0, 1.0);
  cv::GaussianBlur(image, blurred.warped, cv::Size(9, 9), 1.5);
  EXPECT_GT(RepeatedShare(first, DetectCensure(blurred.warped, setting), blurred, 2.5), 0.5);
}

TEST(Censure, SmallImagesAreNoTrouble) {
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(5, 3), cv::Size(13, 200)}) {
    EXPECT_TRUE(DetectCensure(cv::Mat(size, CV_8U, cv::Scalar(7)), Wide()).empty());
  }
  EXPECT_TRUE(DetectCensure(cv::Mat(0, 0, CV_8U), Wide()).empty());
}

}  // namespace
}  // namespace pfseq
