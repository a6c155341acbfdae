// SPDX-License-Identifier: Apache-2.0
#include "validator/features/brief.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace pfseq {
namespace {

constexpr int kPatchPx = 33;
constexpr int kHalfPatchPx = kPatchPx / 2;
constexpr int kMaxBits = 512;
constexpr uint64_t kSeed = 2010;

struct Test {
  cv::Point first;
  cv::Point second;
};

/// A normal deviate (Box and Muller 1958) of the patch's deviation, rounded and kept in the patch.
int Draw(RandomStream& random) {
  const double u = 1.0 - random.Uniform();
  const double normal =
      std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * random.Uniform());
  return std::clamp(
      static_cast<int>(std::lround(normal * kPatchPx / 5.0)), -kHalfPatchPx, kHalfPatchPx);
}

const std::array<Test, kMaxBits>& Tests() {
  static const std::array<Test, kMaxBits> tests = [] {
    std::array<Test, kMaxBits> drawn;
    RandomStream random(kSeed);
    for (Test& test : drawn) {
      do {
        for (cv::Point* point : {&test.first, &test.second}) {
          point->x = Draw(random);
          point->y = Draw(random);
        }
      } while (test.first == test.second);
    }
    return drawn;
  }();
  return tests;
}

}  // namespace

Descriptors DescribeBrief(const cv::Mat& grey, const KeyPoints& points, int num_bytes) {
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, cv::Size(9, 9), 2.0, 2.0);
  Descriptors descriptors;
  descriptors.norm = Norm::kHamming;
  std::vector<cv::Point> places;
  for (size_t i = 0; i < points.size(); ++i) {
    const cv::Point place(cvRound(points[i].pt.x), cvRound(points[i].pt.y));
    if (place.x >= kHalfPatchPx && place.y >= kHalfPatchPx && place.x < grey.cols - kHalfPatchPx &&
        place.y < grey.rows - kHalfPatchPx) {
      descriptors.key_point_idx.push_back(static_cast<int>(i));
      places.push_back(place);
    }
  }
  descriptors.rows = cv::Mat::zeros(static_cast<int>(places.size()), num_bytes, CV_8U);
  for (size_t row = 0; row < places.size(); ++row) {
    uint8_t* bytes = descriptors.rows.ptr<uint8_t>(static_cast<int>(row));
    for (int i = 0; i < 8 * num_bytes; ++i) {
      const Test& test = Tests()[i];
      if (smooth.at<uint8_t>(places[row] + test.first) <
          smooth.at<uint8_t>(places[row] + test.second)) {
        bytes[i / 8] |= static_cast<uint8_t>(1U << (i % 8));
      }
    }
  }
  return descriptors;
}

}  // namespace pfseq
