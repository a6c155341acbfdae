// SPDX-License-Identifier: Apache-2.0
#include "validator/features/freak.h"

#include "renderer/core/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace pfseq {
namespace {

constexpr int kNumRings = 7;
constexpr int kPerRing = 6;
constexpr int kNumOrientationRings = 5;
constexpr int kNumScales = 64;
constexpr int kNumOrientations = 256;
constexpr double kSmallestSizePx = 7.0;
constexpr double kFixedSizePx = 21.0;

/// Of ring 0 (outermost) to 6.
double RingRadius(int ring) {
  constexpr double kOuter = 2.0 / 3.0;
  constexpr double kInner = 1.0 / 12.0;
  constexpr int kPartsFromOuter[kNumRings] = {0, 6, 11, 15, 18, 20, 21};
  return kOuter - (kOuter - kInner) * kPartsFromOuter[ring] / 21.0;
}

double FieldRadius(int field) {
  return 0.5 * RingRadius(std::min(field / kPerRing, kNumRings - 1));
}

cv::Point2d FieldCentre(int field) {
  const int ring = field / kPerRing;
  if (ring == kNumRings) {
    return {0.0, 0.0};
  }
  const double angle_rad =
      std::numbers::pi / 3.0 * (field % kPerRing) + std::numbers::pi / 6.0 * (ring % 2);
  return RingRadius(ring) * cv::Point2d(std::cos(angle_rad), std::sin(angle_rad));
}

/// Pixels a unit of the pattern.
double UnitPx(const FreakSetting& setting, int scale) {
  return setting.pattern_scale *
         std::exp2(static_cast<double>(scale) * setting.num_octaves / kNumScales);
}

/// The 45 pairs of the orientation: in each of the five outer rings the three opposite pairs, and
/// the six pairs that leave one field out.
const std::vector<FreakPair>& OrientationPairs() {
  static const std::vector<FreakPair> pairs = [] {
    std::vector<FreakPair> result;
    for (int ring = 0; ring < kNumOrientationRings; ++ring) {
      const auto add = [&](int a, int b) {
        result.push_back({static_cast<uint8_t>(ring * kPerRing + a),
                          static_cast<uint8_t>(ring * kPerRing + b % kPerRing)});
      };
      for (int i = 0; i < kPerRing / 2; ++i) {
        add(i, i + 3);
      }
      for (int i = 0; i < kPerRing; ++i) {
        add(i, i + 2);
      }
    }
    return result;
  }();
  return pairs;
}

}  // namespace

FreakSampler::FreakSampler(const cv::Mat& grey, const FreakSetting& setting)
    : grey_(grey), setting_(setting), turned_(kNumOrientations) {
  PFSEQ_CHECK(grey.type() == CV_8UC1, "type {}", grey.type());
  cv::integral(grey, sums_, CV_32S);
  for (int orientation = 0; orientation < kNumOrientations; ++orientation) {
    const double angle_rad = 2.0 * std::numbers::pi * orientation / kNumOrientations;
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    for (int field = 0; field < kNumFreakFields; ++field) {
      const cv::Point2d centre = FieldCentre(field);
      turned_[orientation][field] = {c * centre.x - s * centre.y, s * centre.x + c * centre.y};
    }
  }
}

int FreakSampler::ScaleOf(const cv::KeyPoint& point) const {
  const double size_px = setting_.scale_normalized ? point.size : kFixedSizePx;
  if (!(size_px > kSmallestSizePx)) {
    return 0;
  }
  const double scale = std::log2(size_px / kSmallestSizePx) * kNumScales / setting_.num_octaves;
  return static_cast<int>(std::min(scale + 0.5, kNumScales - 1.0));
}

bool FreakSampler::Fits(const cv::KeyPoint& point) const {
  const double reach_px =
      std::ceil((RingRadius(0) + FieldRadius(0)) * UnitPx(setting_, ScaleOf(point))) + 1.0;
  return point.pt.x > reach_px && point.pt.y > reach_px && point.pt.x < grey_.cols - reach_px &&
         point.pt.y < grey_.rows - reach_px;
}

float FreakSampler::Field(double x, double y, double radius) const {
  if (radius < 0.5) {
    // Less than a pixel: interpolated.
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const double fx = x - x0, fy = y - y0;
    return static_cast<float>(
        (1.0 - fy) * ((1.0 - fx) * grey_.at<uint8_t>(y0, x0) + fx * grey_.at<uint8_t>(y0, x0 + 1)) +
        fy * ((1.0 - fx) * grey_.at<uint8_t>(y0 + 1, x0) + fx * grey_.at<uint8_t>(y0 + 1, x0 + 1)));
  }
  const int left = static_cast<int>(x - radius + 0.5), top = static_cast<int>(y - radius + 0.5);
  const int right = static_cast<int>(x + radius + 1.5), bottom = static_cast<int>(y + radius + 1.5);
  const int32_t sum = sums_.at<int32_t>(bottom, right) - sums_.at<int32_t>(bottom, left) -
                      sums_.at<int32_t>(top, right) + sums_.at<int32_t>(top, left);
  return static_cast<float>(sum) / static_cast<float>((right - left) * (bottom - top));
}

void FreakSampler::ReadFields(const cv::KeyPoint& point, int orientation, Sample& sample) const {
  const double unit_px = UnitPx(setting_, ScaleOf(point));
  for (int field = 0; field < kNumFreakFields; ++field) {
    const cv::Point2d& centre = turned_[orientation][field];
    sample.fields[field] = Field(point.pt.x + unit_px * centre.x,
                                 point.pt.y + unit_px * centre.y,
                                 unit_px * FieldRadius(field));
  }
}

FreakSampler::Sample FreakSampler::At(const cv::KeyPoint& point) const {
  Sample sample;
  ReadFields(point, 0, sample);
  if (!setting_.orientation_normalized) {
    return sample;
  }
  double x = 0.0;
  double y = 0.0;
  for (const FreakPair& pair : OrientationPairs()) {
    const cv::Point2d between = turned_[0][pair.first] - turned_[0][pair.second];
    const double weight =
        (sample.fields[pair.first] - sample.fields[pair.second]) / cv::norm(between);
    x += weight * between.x;
    y += weight * between.y;
  }
  double turns = std::atan2(y, x) / (2.0 * std::numbers::pi);
  turns -= std::floor(turns);
  const int orientation = static_cast<int>(turns * kNumOrientations + 0.5) % kNumOrientations;
  sample.angle_deg = static_cast<float>(360.0 * orientation / kNumOrientations);
  ReadFields(point, orientation, sample);
  return sample;
}

Descriptors DescribeFreak(const cv::Mat& grey,
                          const KeyPoints& points,
                          const FreakSetting& setting) {
  Descriptors descriptors;
  descriptors.norm = Norm::kHamming;
  const FreakSampler sampler(grey, setting);
  for (size_t i = 0; i < points.size(); ++i) {
    if (sampler.Fits(points[i])) {
      descriptors.key_point_idx.push_back(static_cast<int>(i));
    }
  }
  descriptors.rows =
      cv::Mat::zeros(static_cast<int>(descriptors.key_point_idx.size()), kNumFreakPairs / 8, CV_8U);
  for (int row = 0; row < descriptors.rows.rows; ++row) {
    const FreakSampler::Sample sample = sampler.At(points[descriptors.key_point_idx[row]]);
    uint8_t* bytes = descriptors.rows.ptr<uint8_t>(row);
    for (int i = 0; i < kNumFreakPairs; ++i) {
      const FreakPair& pair = kFreakPairs[i];
      if (sample.fields[pair.first] > sample.fields[pair.second]) {
        bytes[i / 8] |= static_cast<uint8_t>(1U << (i % 8));
      }
    }
  }
  return descriptors;
}

}  // namespace pfseq
