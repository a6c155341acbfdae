// SPDX-License-Identifier: Apache-2.0
#include "validator/features/sift.h"

#include "renderer/core/check.h"
#include "validator/features/pixel_convention.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace pfseq {

std::string SiftSetting::Name() const {
  return fmt::format(
      "SIFT nopol {:.2f} {:.1f} {:.1f}", contrast_threshold, edge_threshold, sigma_px);
}

Features DetectSift(const Image<uint8_t>& rgb, const SiftSetting& setting) {
  PFSEQ_CHECK(rgb.NumChannels() == 3 && !rgb.Empty(), "{} channels", rgb.NumChannels());
  // OpenCV has no read-only view of pixels; cvtColor does not write to its source.
  const cv::Mat color(
      rgb.HeightPx(), rgb.WidthPx(), CV_8UC3, const_cast<uint8_t*>(rgb.Values().data()));
  cv::Mat grey;
  cv::cvtColor(color, grey, cv::COLOR_RGB2GRAY);

  const int all_points = 0;
  const cv::Ptr<cv::SIFT> sift = cv::SIFT::create(all_points,
                                                  setting.octave_layers,
                                                  setting.contrast_threshold,
                                                  setting.edge_threshold,
                                                  setting.sigma_px,
                                                  CV_8U);
  std::vector<cv::KeyPoint> key_points;
  cv::Mat descriptors;
  sift->detectAndCompute(grey, cv::noArray(), key_points, descriptors);

  Features features;
  for (const cv::KeyPoint& key_point : key_points) {
    features.pixels_px.push_back(PixelFromOpenCv(key_point.pt.x, key_point.pt.y));
  }
  features.descriptors =
      ByteDescriptors(sift->descriptorSize(), static_cast<int>(key_points.size()), 1);
  for (int row = 0; row < descriptors.rows; ++row) {
    std::copy_n(descriptors.ptr<uint8_t>(row), descriptors.cols, &features.descriptors.At(0, row));
  }
  return features;
}

}  // namespace pfseq
