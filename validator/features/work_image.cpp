// SPDX-License-Identifier: Apache-2.0
#include "validator/features/work_image.h"

#include "renderer/core/check.h"
#include "validator/features/pixel_convention.h"

#include <opencv2/imgproc.hpp>

namespace pfseq {

cv::Mat GreyOf(const Image<uint8_t>& image) {
  const int channels = image.NumChannels();
  PFSEQ_CHECK(channels == 1 || channels == 3 || channels == 4, "{} channels", channels);
  // OpenCV has no read-only view of pixels; nothing here writes to it.
  const cv::Mat view(image.HeightPx(),
                     image.WidthPx(),
                     CV_8UC(channels),
                     const_cast<uint8_t*>(image.Values().data()));
  if (channels == 1) {
    return view.clone();
  }
  cv::Mat grey;
  cv::cvtColor(view, grey, channels == 3 ? cv::COLOR_RGB2GRAY : cv::COLOR_RGBA2GRAY);
  return grey;
}

WorkImage WorkImage::Fisheye(const Image<uint8_t>& image) { return {GreyOf(image), std::nullopt}; }

WorkImage WorkImage::Polar(const Image<uint8_t>& image, const Lens& lens) {
  const PolarMap polar(lens);
  return {GreyOf(polar.Rectify(image)), polar};
}

bool WorkImage::Owns(const cv::KeyPoint& point) const {
  return !polar || polar->IsInCore(point.pt.x);
}

std::optional<Vec2d> WorkImage::FisheyePixel(const cv::KeyPoint& point) const {
  if (polar) {
    return polar->ToFisheye(point.pt.x, point.pt.y);
  }
  return PixelFromOpenCv(point.pt.x, point.pt.y);
}

}  // namespace pfseq
