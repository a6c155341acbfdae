// SPDX-License-Identifier: Apache-2.0
// Pictures with features, and views of them with known geometry.
#pragma once

#include "renderer/core/random.h"
#include "validator/features/features.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace pfseq {

/// Grey discs and boxes of many sizes on soft noise.
inline cv::Mat BlobImage(int width_px, int height_px, uint64_t seed = 1) {
  RandomStream random{seed};
  cv::Mat image(height_px, width_px, CV_8U, cv::Scalar(110));
  const int count = width_px * height_px / 400;
  for (int i = 0; i < count; ++i) {
    const cv::Point centre(random.Integer(0, width_px - 1), random.Integer(0, height_px - 1));
    const int radius = static_cast<int>(std::exp2(random.Uniform(1.0, 4.0)));
    const cv::Scalar grey(random.Integer(0, 255));
    if (random.Chance(0.5)) {
      cv::circle(image, centre, radius, grey, cv::FILLED, cv::LINE_AA);
    } else {
      cv::rectangle(image, centre, centre + cv::Point(radius, radius), grey, cv::FILLED);
    }
  }
  cv::GaussianBlur(image, image, cv::Size(5, 5), 0.8);
  return image;
}

inline cv::Mat NoiseImage(int width_px, int height_px) {
  RandomStream random{7};
  cv::Mat image(height_px, width_px, CV_8U);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      image.at<uint8_t>(y, x) = static_cast<uint8_t>(random.Integer(0, 255));
    }
  }
  return image;
}

/// The image turned about its centre (degrees, counter-clockwise as seen) and scaled.
struct WarpedView {
  WarpedView(const cv::Mat& image, double angle_deg, double scale) {
    map = cv::getRotationMatrix2D(cv::Point2f(0.5F * static_cast<float>(image.cols - 1),
                                              0.5F * static_cast<float>(image.rows - 1)),
                                  angle_deg,
                                  scale);
    cv::warpAffine(image, warped, map, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  }

  cv::Point2d ToView(const cv::Point2f& point) const {
    const auto at = [&](int row, int column) { return map.at<double>(row, column); };
    return {at(0, 0) * point.x + at(0, 1) * point.y + at(0, 2),
            at(1, 0) * point.x + at(1, 1) * point.y + at(1, 2)};
  }

  cv::Mat warped;
  cv::Mat map;
};

/// Share of the first image's points (those whose place lies well inside the view) that the view
/// has within a distance.
inline double RepeatedShare(const KeyPoints& first,
                            const KeyPoints& second,
                            const WarpedView& view,
                            double distance_px) {
  constexpr double kMarginPx = 40.0;
  int num_seen = 0;
  int num_repeated = 0;
  for (const cv::KeyPoint& point : first) {
    const cv::Point2d place = view.ToView(point.pt);
    if (place.x < kMarginPx || place.y < kMarginPx || place.x > view.warped.cols - kMarginPx ||
        place.y > view.warped.rows - kMarginPx) {
      continue;
    }
    ++num_seen;
    for (const cv::KeyPoint& other : second) {
      if (std::hypot(other.pt.x - place.x, other.pt.y - place.y) < distance_px) {
        ++num_repeated;
        break;
      }
    }
  }
  return num_seen > 0 ? static_cast<double>(num_repeated) / num_seen : 0.0;
}

}  // namespace pfseq
