// SPDX-License-Identifier: Apache-2.0
#include "validator/false_color.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace pfseq {
namespace {

constexpr uint8_t kSkyGrey = 225;
constexpr int kLegendHeightPx = 44;
constexpr int kBarHeightPx = 16;
constexpr int kMarginPx = 24;
constexpr double kTicksM[] = {2, 5, 10, 20, 50, 100, 200};

/// From 0 (near) to 1 (far).
double Place(double distance_m) {
  return std::clamp(
      std::log(distance_m / kNearestColorM) / std::log(kFurthestColorM / kNearestColorM), 0.0, 1.0);
}

/// The 256 colours as rows of blue, green, red.
cv::Mat Colors() {
  cv::Mat ramp(256, 1, CV_8UC1), colors;
  for (int i = 0; i < 256; ++i) {
    ramp.at<uint8_t>(i) = static_cast<uint8_t>(i);
  }
  cv::applyColorMap(ramp, colors, cv::COLORMAP_VIRIDIS);
  return colors;
}

void Paint(Image<uint8_t>& picture, int x, int y, const cv::Vec3b& bgr) {
  for (int channel = 0; channel < 3; ++channel) {
    picture.At(x, y, channel) = bgr[2 - channel];
  }
}

}  // namespace

Image<uint8_t> DistanceInColor(const Image<float>& distance_m) {
  const cv::Mat colors = Colors();
  Image<uint8_t> picture(distance_m.WidthPx(), distance_m.HeightPx(), 3);
  for (int y = 0; y < distance_m.HeightPx(); ++y) {
    for (int x = 0; x < distance_m.WidthPx(); ++x) {
      const float value_m = distance_m.At(x, y);
      if (std::isinf(value_m)) {
        Paint(picture, x, y, cv::Vec3b(kSkyGrey, kSkyGrey, kSkyGrey));
      } else if (value_m > 0.0F) {
        Paint(picture,
              x,
              y,
              colors.at<cv::Vec3b>(static_cast<int>(std::lround(255.0 * Place(value_m)))));
      }
    }
  }
  return picture;
}

Image<uint8_t> DistanceLegend(int width_px) {
  const cv::Mat colors = Colors();
  Image<uint8_t> picture(width_px, kLegendHeightPx, 3, 255);
  const int bar_px = std::max(1, width_px - 2 * kMarginPx);
  for (int x = 0; x < bar_px; ++x) {
    for (int y = 0; y < kBarHeightPx; ++y) {
      Paint(picture, kMarginPx + x, y, colors.at<cv::Vec3b>(255 * x / bar_px));
    }
  }
  cv::Mat canvas(picture.HeightPx(), picture.WidthPx(), CV_8UC3, picture.Values().data());
  for (const double tick_m : kTicksM) {
    const std::string text = fmt::format("{:g} m", tick_m);
    const int x = kMarginPx + static_cast<int>(Place(tick_m) * bar_px);
    const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, nullptr);
    cv::line(canvas, {x, kBarHeightPx}, {x, kBarHeightPx + 5}, cv::Scalar(40, 40, 40), 1);
    cv::putText(canvas,
                text,
                {std::min(x - size.width / 2, width_px - size.width), kBarHeightPx + 22},
                cv::FONT_HERSHEY_SIMPLEX,
                0.45,
                cv::Scalar(40, 40, 40),
                1,
                cv::LINE_AA);
  }
  return picture;
}

}  // namespace pfseq
