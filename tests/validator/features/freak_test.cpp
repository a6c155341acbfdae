// SPDX-License-Identifier: Apache-2.0
#include "validator/features/freak.h"

#include "tests/validator/features/test_images.h"
#include "validator/features/describe.h"
#include "validator/features/detect.h"
#include "validator/matching/match.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(Freak, FieldsSeeTheirPlaces) {
  // Dark left of the centre, bright right of it: field 0 lies at 0 degrees, 3 opposite.
  cv::Mat image(121, 121, CV_8U, cv::Scalar(20));
  image.colRange(61, 121).setTo(200);
  FreakSetting setting;
  setting.orientation_normalized = false;
  const FreakSampler sampler(image, setting);
  const FreakSampler::Sample sample = sampler.At(cv::KeyPoint(60.0F, 60.0F, 7.0F));
  EXPECT_GT(sample.fields[0], 195.0F);
  EXPECT_LT(sample.fields[3], 25.0F);
  EXPECT_NEAR(sample.fields[42], 110.0F, 90.0F);
}

TEST(Freak, OrientationFollowsTheImage) {
  for (int angle_deg = 0; angle_deg < 360; angle_deg += 45) {
    // Grey grows along a direction, clockwise from x as seen.
    cv::Mat image(101, 101, CV_8U);
    const double angle_rad = angle_deg * CV_PI / 180.0;
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x) {
        image.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(
            128.0 + 1.5 * ((x - 50) * std::cos(angle_rad) + (y - 50) * std::sin(angle_rad)));
      }
    }
    const FreakSampler sampler(image, {});
    const double found_deg = sampler.At(cv::KeyPoint(50.0F, 50.0F, 7.0F)).angle_deg;
    EXPECT_NEAR(std::remainder(found_deg - angle_deg, 360.0), 0.0, 3.0) << angle_deg;
  }
}

TEST(Freak, ThePatternGrowsWithTheSize) {
  const cv::Mat image = BlobImage(400, 400);
  const FreakSampler sampler(image, {});
  const auto fits = [&](float x, float size) { return sampler.Fits({x, 200.0F, size}); };
  // Reach of the unit pattern: 2/3 + 1/3 of 22 pixels, and 1.
  EXPECT_TRUE(fits(24.0F, 7.0F));
  EXPECT_FALSE(fits(22.5F, 7.0F));
  EXPECT_TRUE(fits(46.0F, 14.0F));
  EXPECT_FALSE(fits(44.0F, 14.0F));
  FreakSetting fixed;
  fixed.scale_normalized = false;
  EXPECT_FALSE(FreakSampler(image, fixed).Fits({60.0F, 200.0F, 7.0F}));
  EXPECT_TRUE(FreakSampler(image, fixed).Fits({70.0F, 200.0F, 7.0F}));
}

/// Share of key points whose nearest neighbour in the turned and scaled view is their own place.
double MatchedShare(const Setting& descriptor, double angle_deg, double scale) {
  const cv::Mat image = BlobImage(640, 640);
  const WarpedView view(image, angle_deg, scale);
  const Setting detector = ParseName("SIFT nopol 0.04 10.0 1.6").detector.setting;
  KeyPoints points;
  for (cv::KeyPoint point : Detect(image, detector)) {
    const cv::Point2d from_centre(point.pt.x - 319.5, point.pt.y - 319.5);
    if (cv::norm(from_centre) < 180.0 && point.size < 12.0F) {
      points.push_back(point);
    }
  }
  KeyPoints moved = points;
  for (cv::KeyPoint& point : moved) {
    point.pt = view.ToView(point.pt);
    point.size *= static_cast<float>(scale);
    // The view is turned counter-clockwise, angles count clockwise.
    point.angle = static_cast<float>(std::fmod(point.angle - angle_deg + 720.0, 360.0));
  }
  const Descriptors first = Describe(image, points, detector, descriptor);
  const Descriptors second = Describe(view.warped, moved, detector, descriptor);
  const NearestTables tables =
      FindNearest(ClassedDescriptors::Whole(first), ClassedDescriptors::Whole(second), 1);
  int num_right = 0;
  for (size_t i = 0; i < first.key_point_idx.size(); ++i) {
    const int nearest = tables.of_first[0][i].idx;
    // SIFT has points at one place with several angles.
    num_right +=
        nearest >= 0 && moved[second.key_point_idx[nearest]].pt == moved[first.key_point_idx[i]].pt
            ? 1
            : 0;
  }
  EXPECT_GT(first.key_point_idx.size(), 100U);
  return static_cast<double>(num_right) / static_cast<double>(first.key_point_idx.size());
}

TEST(Freak, MatchesTurnedAndScaledViewsLikeBrisk) {
  const Setting freak = *ParseName("FAST nopol 20 FREAK 22.0 BruteForce").descriptor;
  const Setting brisk = *ParseName("FAST nopol 20 BRISK 1.0 BruteForce").descriptor;
  for (const auto& [angle_deg, scale] :
       {std::pair(0.0, 1.0), std::pair(35.0, 1.0), std::pair(170.0, 1.2)}) {
    const double share = MatchedShare(freak, angle_deg, scale);
    EXPECT_GT(share, 0.75) << angle_deg << " " << scale;
    EXPECT_GT(share, MatchedShare(brisk, angle_deg, scale) - 0.1) << angle_deg << " " << scale;
  }
}

TEST(Freak, WithoutNormalisationATurnIsLost) {
  Setting upright = *ParseName("FAST nopol 20 FREAK 22.0 BruteForce").descriptor;
  upright.Set("orientationNormalized", 0.0);
  EXPECT_GT(MatchedShare(upright, 0.0, 1.0), 0.9);
  EXPECT_LT(MatchedShare(upright, 60.0, 1.0), 0.3);
}

}  // namespace
}  // namespace pfseq
