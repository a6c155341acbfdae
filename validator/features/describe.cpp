// SPDX-License-Identifier: Apache-2.0
#include "validator/features/describe.h"

#include "renderer/core/check.h"
#include "validator/features/brief.h"
#include "validator/features/detect.h"
#include "validator/features/freak.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <opencv2/features2d.hpp>
#include <opencv2/opencv_modules.hpp>
#ifdef HAVE_OPENCV_XFEATURES2D
#include <opencv2/xfeatures2d/nonfree.hpp>
#endif

namespace pfseq {
namespace {

constexpr double kSiftSigma = 1.6;
constexpr int kSiftLayers = 3;
/// OpenCV's SIFT writes beyond its buffers for smaller ones.
constexpr float kMinSiftSizePx = 2.0F;
constexpr float kOrbPatchPx = 31.0F;
constexpr double kOrbScaleFactor = 1.2;
constexpr int kOrbLevels = 8;

/// Octave and layer as OpenCV's SIFT packs them, for a point of sigma = size / 2.
int PackSiftOctave(float size_px, int most_octave) {
  const double scale = std::log2(0.5 * size_px / kSiftSigma);
  // sigma = 1.6 * 2^(octave + layer / 3), layer 1 to 3.
  int steps = static_cast<int>(std::lround(scale * kSiftLayers));
  steps = std::clamp(steps, 1 - kSiftLayers, (most_octave + 1) * kSiftLayers);
  const int octave = static_cast<int>(std::floor((steps - 1) / static_cast<double>(kSiftLayers)));
  const int layer = steps - octave * kSiftLayers;
  return (octave & 255) | (layer << 8);
}

void FitToSift(const cv::Mat& grey, KeyPoints& points) {
  // OpenCV's number of octaves is round(log2(min side) - 2), the first one at full size.
  const int most_octave =
      std::max(0, static_cast<int>(std::log2(std::min(grey.cols, grey.rows))) - 3);
  for (cv::KeyPoint& point : points) {
    point.size = std::max(point.size, kMinSiftSizePx);
    point.octave = PackSiftOctave(point.size, most_octave);
  }
}

void FitToOrb(KeyPoints& points) {
  for (cv::KeyPoint& point : points) {
    const double level =
        std::log(std::max(point.size, 1e-3F) / kOrbPatchPx) / std::log(kOrbScaleFactor);
    point.octave = std::clamp(static_cast<int>(std::lround(level)), 0, kOrbLevels - 1);
  }
}

cv::Ptr<cv::Feature2D> MakeOpenCv(const cv::Mat& grey,
                                  const Setting& detector,
                                  const Setting& descriptor) {
  if (descriptor.Is("SIFT")) {
    const bool is_own = detector.Is("SIFT");
    return cv::SIFT::create(0,
                            is_own ? detector.Integer("nOctaveLayers") : kSiftLayers,
                            0.04,
                            10.0,
                            is_own ? detector.Number("sigma") : kSiftSigma,
                            CV_8U);
  }
  if (descriptor.Is("ORB")) {
    const bool is_own = detector.Is("ORB");
    const int patch = is_own ? detector.Integer("patchSize") : 31;
    return cv::ORB::create(
        500,
        static_cast<float>(is_own ? detector.Value("scaleFactor").value_or(std::exp2(1.0 / 3.0))
                                  : kOrbScaleFactor),
        is_own ? static_cast<int>(detector.Value("nlevels").value_or(3 * AutoOctaves(grey)))
               : kOrbLevels,
        patch,
        0,
        descriptor.Integer("WTA_K"),
        cv::ORB::HARRIS_SCORE,
        patch);
  }
  if (descriptor.Is("BRISK")) {
    return cv::BRISK::create(30, 3, static_cast<float>(descriptor.Number("patternScale")));
  }
  if (descriptor.Is("AKAZE") || descriptor.Is("KAZE")) {
    const auto threshold = static_cast<float>(detector.Number("threshold"));
    const int octaves = detector.Integer("nOctaves");
    const int layers = detector.Integer("nOctaveLayers");
    if (descriptor.Is("KAZE")) {
      return cv::KAZE::create(false, false, threshold, octaves, layers);
    }
    return cv::AKAZE::create(cv::AKAZE::DESCRIPTOR_MLDB, 0, 3, threshold, octaves, layers);
  }
#ifdef OPENCV_ENABLE_NONFREE
  if (descriptor.Is("SURF")) {
    return cv::xfeatures2d::SURF::create(100.0, 4, 3, descriptor.Integer("extended") != 0);
  }
#endif
  PFSEQ_CHECK(false, "descriptor {}", descriptor.Kind().name);
}

/// OpenCV reorders and drops points: each carries its index.
Descriptors DescribeByOpenCv(const cv::Mat& grey,
                             KeyPoints points,
                             const Setting& detector,
                             const Setting& descriptor) {
  const bool needs_class = descriptor.Is("AKAZE") || descriptor.Is("KAZE");
  for (size_t i = 0; i < points.size() && !needs_class; ++i) {
    points[i].class_id = static_cast<int>(i);
  }
  const size_t num_points = points.size();
  cv::Mat rows;
  MakeOpenCv(grey, detector, descriptor)->compute(grey, points, rows);
  PFSEQ_CHECK(static_cast<size_t>(rows.rows) == points.size() || points.empty(),
              "{} rows of {} points",
              rows.rows,
              points.size());
  PFSEQ_CHECK(
      !needs_class || points.size() == num_points, "{} dropped points", descriptor.Kind().name);
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  if (!needs_class) {
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return points[a].class_id < points[b].class_id;
    });
  }
  const bool drops_zeros = descriptor.Is("ORB");
  Descriptors descriptors;
  descriptors.norm = NormOf(descriptor);
  std::vector<int> kept;
  for (const int i : order) {
    if (!drops_zeros || cv::countNonZero(rows.row(i)) > 0) {
      kept.push_back(i);
      descriptors.key_point_idx.push_back(needs_class ? i : points[i].class_id);
    }
  }
  descriptors.rows = cv::Mat(static_cast<int>(kept.size()), rows.cols, rows.type());
  for (size_t row = 0; row < kept.size(); ++row) {
    rows.row(kept[row]).copyTo(descriptors.rows.row(static_cast<int>(row)));
  }
  return descriptors;
}

}  // namespace

Descriptors Describe(const cv::Mat& grey,
                     const KeyPoints& points,
                     const Setting& detector,
                     const Setting& descriptor) {
  Descriptors none;
  none.norm = NormOf(descriptor);
  if (points.empty()) {
    return none;
  }
  KeyPoints fitting = points;
  const bool has_size_scale =
      std::any_of(descriptor.Kind().parameters.begin(),
                  descriptor.Kind().parameters.end(),
                  [](const Parameter& parameter) { return parameter.name == "sizeScale"; });
  const auto size_scale =
      has_size_scale ? static_cast<float>(descriptor.Number("sizeScale")) : 1.0F;
  for (cv::KeyPoint& point : fitting) {
    point.angle = point.angle < 0.0F ? 0.0F : point.angle;
    point.size *= size_scale;
  }
  if (descriptor.Is("FREAK")) {
    return DescribeFreak(
        grey,
        fitting,
        {descriptor.Integer("orientationNormalized") != 0,
         descriptor.Integer("scaleNormalized") != 0,
         descriptor.Number("patternScale"),
         static_cast<int>(descriptor.Value("nOctaves").value_or(AutoOctaves(grey)))});
  }
  if (descriptor.Is("BRIEF")) {
    return DescribeBrief(grey, fitting, descriptor.Integer("bytes"));
  }
  if (descriptor.Is("SIFT") && !detector.Is("SIFT")) {
    FitToSift(grey, fitting);
  }
  if (descriptor.Is("ORB") && !detector.Is("ORB")) {
    FitToOrb(fitting);
  }
  return DescribeByOpenCv(grey, std::move(fitting), detector, descriptor);
}

}  // namespace pfseq
