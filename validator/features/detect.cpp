// SPDX-License-Identifier: Apache-2.0
#include "validator/features/detect.h"

#include "renderer/core/check.h"
#include "renderer/core/error.h"
#include "validator/features/censure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/opencv_modules.hpp>
#include <unistd.h>
#ifdef HAVE_OPENCV_XFEATURES2D
#include <opencv2/xfeatures2d/nonfree.hpp>
#endif

namespace pfseq {
namespace {

constexpr int kSiftLayersOfReport = 3;
/// An octave of BRISK smaller than this has no room for its detector.
constexpr int kMinBriskLayerPx = 8;

CensureSetting CensureOf(const Setting& setting) {
  const int projected = setting.Integer("lineThresholdProjected");
  const std::optional<double> binarized = setting.Value("lineThresholdBinarized");
  return {setting.Integer("maxSize"),
          setting.Integer("responseThreshold"),
          projected,
          binarized ? static_cast<int>(*binarized) : std::max(1, projected - 2),
          setting.Integer("suppressNonmaxSize")};
}

/// Harris's corners (Harris, Stephens 1988): maxima over 3 x 3 pixels of det - 0.04 trace^2 above
/// qualityLevel times the greatest, strongest first.
KeyPoints DetectHarris(const cv::Mat& grey, const Setting& setting) {
  cv::Mat corner, largest;
  cv::cornerHarris(grey, corner, setting.Integer("blockSize"), 3, 0.04);
  cv::dilate(corner, largest, cv::Mat());
  double most = 0.0;
  cv::minMaxLoc(corner, nullptr, &most);
  const auto threshold = static_cast<float>(most * setting.Number("qualityLevel"));
  KeyPoints points;
  for (int y = 1; y + 1 < grey.rows; ++y) {
    for (int x = 1; x + 1 < grey.cols; ++x) {
      const float value = corner.at<float>(y, x);
      if (value > 0.0F && value > threshold && value == largest.at<float>(y, x)) {
        points.emplace_back(static_cast<float>(x),
                            static_cast<float>(y),
                            static_cast<float>(setting.Integer("blockSize")),
                            -1.0F,
                            value);
      }
    }
  }
  std::stable_sort(points.begin(), points.end(), [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    return a.response > b.response;
  });
  const auto most_points = static_cast<size_t>(setting.Integer("maxCorners"));
  if (most_points > 0 && points.size() > most_points) {
    points.resize(most_points);
  }
  return points;
}

/// OpenCV's SIFT holds all octaves of the doubled image at once, in float; two views may be worked
/// on at a time. InputError when this machine has not that much memory.
void CheckSiftMemory(const cv::Mat& grey, int layers) {
  constexpr double kGibi = 1024.0 * 1024.0 * 1024.0;
  const double images = 2.0 * layers + 5.0;
  const double needed =
      2.0 * 4.0 * static_cast<double>(grey.total()) * sizeof(float) * images * 4.0 / 3.0;
  const double there =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (needed > 0.9 * there) {
    throw InputError(
        "SIFT on an image of {} x {} px: needs about {:.0f} GiB of memory, this machine has {:.0f}",
        grey.cols,
        grey.rows,
        needed / kGibi,
        there / kGibi);
  }
}

cv::Ptr<cv::Feature2D> MakeOpenCv(const cv::Mat& grey, const Setting& setting) {
  const auto integer = [&](const char* name) { return setting.Integer(name); };
  const auto number = [&](const char* name) { return setting.Number(name); };
  const auto real = [&](const char* name) { return static_cast<float>(setting.Number(name)); };
  if (setting.Is("SIFT")) {
    const int all_points = 0;
    CheckSiftMemory(grey, integer("nOctaveLayers"));
    return cv::SIFT::create(all_points,
                            integer("nOctaveLayers"),
                            number("contrastThreshold"),
                            number("edgeThreshold"),
                            number("sigma"),
                            CV_8U);
  }
  if (setting.Is("ORB")) {
    const int levels = kSiftLayersOfReport * AutoOctaves(grey);
    return cv::ORB::create(
        integer("nfeatures"),
        static_cast<float>(
            setting.Value("scaleFactor").value_or(std::exp2(1.0 / kSiftLayersOfReport))),
        static_cast<int>(setting.Value("nlevels").value_or(levels)),
        integer("patchSize"),
        0,
        2,
        cv::ORB::HARRIS_SCORE,
        integer("patchSize"),
        integer("fastThreshold"));
  }
  if (setting.Is("BRISK")) {
    int most = 0;
    while ((std::min(grey.cols, grey.rows) >> (most + 1)) >= kMinBriskLayerPx) {
      ++most;
    }
    const int octaves = static_cast<int>(setting.Value("octaves").value_or(AutoOctaves(grey)));
    return cv::BRISK::create(integer("thresh"), std::min(octaves, most), real("patternScale"));
  }
  if (setting.Is("ShiTomasi") || setting.Is("ShiTomasiHarris")) {
    return cv::GFTTDetector::create(integer("maxCorners"),
                                    number("qualityLevel"),
                                    number("minDistance"),
                                    integer("blockSize"),
                                    setting.Is("ShiTomasiHarris"));
  }
  if (setting.Is("FAST")) {
    return cv::FastFeatureDetector::create(
        integer("threshold"),
        true,
        static_cast<cv::FastFeatureDetector::DetectorType>(integer("type")));
  }
  if (setting.Is("AGAST")) {
    return cv::AgastFeatureDetector::create(
        integer("threshold"),
        true,
        static_cast<cv::AgastFeatureDetector::DetectorType>(integer("type")));
  }
  if (setting.Is("MSER")) {
    return cv::MSER::create(integer("delta"), integer("minArea"), integer("maxArea"));
  }
  if (setting.Is("AKAZE")) {
    return cv::AKAZE::create(cv::AKAZE::DESCRIPTOR_MLDB,
                             0,
                             3,
                             real("threshold"),
                             integer("nOctaves"),
                             integer("nOctaveLayers"));
  }
  if (setting.Is("KAZE")) {
    return cv::KAZE::create(
        false, false, real("threshold"), integer("nOctaves"), integer("nOctaveLayers"));
  }
#ifdef OPENCV_ENABLE_NONFREE
  if (setting.Is("SURF")) {
    return cv::xfeatures2d::SURF::create(
        number("hessianThreshold"), integer("nOctaves"), integer("nOctaveLayers"));
  }
#endif
  PFSEQ_CHECK(false, "detector {}", setting.Kind().name);
}

void RankWithoutResponse(KeyPoints& points) {
  const bool has_response = std::any_of(
      points.begin(), points.end(), [](const cv::KeyPoint& p) { return p.response != 0.0F; });
  for (size_t i = 0; i < points.size() && !has_response; ++i) {
    points[i].response = 1.0F - static_cast<float>(i) / static_cast<float>(points.size());
  }
}

/// What tells key points apart, in OpenCV's order of SIFT points.
auto Identity(const cv::KeyPoint& p) {
  return std::tuple(p.pt.x, p.pt.y, -p.size, p.angle, -p.response, p.octave);
}

/// SIFT's contrast threshold only filters: OpenCV keeps a point where response * nOctaveLayers is
/// not below it. The edge threshold does too, but its measure is not told.
std::vector<KeyPoints> DetectSiftMembers(const cv::Mat& grey, const std::vector<Setting>& members) {
  std::map<double, double> loosest;  // Contrast threshold by edge threshold.
  for (const Setting& member : members) {
    const double contrast = member.Number("contrastThreshold");
    const auto [found, is_new] = loosest.emplace(member.Number("edgeThreshold"), contrast);
    found->second = std::min(found->second, contrast);
  }
  std::map<double, KeyPoints> by_edge;
  for (const auto& [edge, contrast] : loosest) {
    Setting setting = members.front();
    setting.Set("contrastThreshold", contrast);
    setting.Set("edgeThreshold", edge);
    by_edge[edge] = Detect(grey, setting);
  }
  std::vector<KeyPoints> points;
  for (const Setting& member : members) {
    const auto contrast = static_cast<float>(member.Number("contrastThreshold"));
    const auto layers = static_cast<float>(member.Integer("nOctaveLayers"));
    KeyPoints& of_member = points.emplace_back();
    for (const cv::KeyPoint& point : by_edge[member.Number("edgeThreshold")]) {
      if (!(point.response * layers < contrast)) {
        of_member.push_back(point);
      }
    }
  }
  return points;
}

}  // namespace

int AutoOctaves(const cv::Mat& grey) {
  return std::max(1, static_cast<int>(std::floor(std::log2(std::min(grey.cols, grey.rows)))));
}

KeyPoints Detect(const cv::Mat& grey, const Setting& detector) {
  KeyPoints points;
  if (std::min(grey.cols, grey.rows) < kMinImagePx) {
    return points;
  }
  if (detector.Is("CenSurE")) {
    return DetectCensure(grey, CensureOf(detector));
  }
  if (detector.Is("Harris")) {
    return DetectHarris(grey, detector);
  }
  MakeOpenCv(grey, detector)->detect(grey, points);
  RankWithoutResponse(points);
  return points;
}

bool SameFamily(const Setting& a, const Setting& b) {
  if (a.Is("SIFT") && b.Is("SIFT")) {
    return a.Number("sigma") == b.Number("sigma") &&
           a.Number("nOctaveLayers") == b.Number("nOctaveLayers");
  }
  return (a.Is("CenSurE") && b.Is("CenSurE")) || a == b;
}

FamilyKeyPoints DetectFamily(const cv::Mat& grey, const std::vector<Setting>& members) {
  PFSEQ_CHECK(members.size() <= 64, "{} members", members.size());
  if (members.size() == 1) {
    KeyPoints points = Detect(grey, members.front());
    const size_t size = points.size();
    return {std::move(points), std::vector<uint64_t>(size, 1)};
  }
  std::vector<KeyPoints> of_members(members.size());
  if (std::min(grey.cols, grey.rows) >= kMinImagePx) {
    if (members.front().Is("SIFT")) {
      of_members = DetectSiftMembers(grey, members);
    } else {
      std::vector<CensureSetting> settings;
      for (const Setting& member : members) {
        settings.push_back(CensureOf(member));
      }
      of_members = DetectCensure(grey, settings);
    }
  }
  // Each member's points are in ascending order of identity (SIFT), or of rows, then columns
  // (CenSurE): a merge by that order keeps it.
  const bool by_rows = !members.front().Is("SIFT");
  const auto key = [by_rows](const cv::KeyPoint& p) {
    return std::pair(by_rows ? p.pt.y : 0.0F, Identity(p));
  };
  std::map<decltype(key(cv::KeyPoint())), std::pair<cv::KeyPoint, uint64_t>> all;
  for (size_t m = 0; m < members.size(); ++m) {
    for (const cv::KeyPoint& point : of_members[m]) {
      auto& [known, mask] = all.try_emplace(key(point), point, uint64_t{0}).first->second;
      mask |= uint64_t{1} << m;
    }
  }
  FamilyKeyPoints family;
  for (const auto& [identity, entry] : all) {
    family.points.push_back(entry.first);
    family.members.push_back(entry.second);
  }
  return family;
}

}  // namespace pfseq
