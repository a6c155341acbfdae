// SPDX-License-Identifier: Apache-2.0
#include "validator/match_picture.h"

#include "renderer/core/file.h"
#include "renderer/sequence/image_io.h"

#include <algorithm>
#include <cctype>
#include <span>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace pfseq {
namespace {

constexpr int kViewWidthPx = 800;
constexpr int kCaptionHeightPx = 34;
constexpr size_t kMaxLines = 200;
// Sub-pixel drawing of OpenCV: coordinates in 1/16 pixel.
constexpr int kShift = 4;

/// Okabe and Ito's sky blue and vermilion (2008): everybody can tell them apart.
cv::Scalar ColorOf(bool is_correct) {
  return is_correct ? cv::Scalar(86, 180, 233) : cv::Scalar(213, 94, 0);
}

bool IsCorrect(const JudgedMatch& match) { return match.distance_m < kPictureToleranceM; }

void PasteReduced(const Image<uint8_t>& view, cv::Mat place) {
  const cv::Mat full(view.HeightPx(),
                     view.WidthPx(),
                     CV_8UC(view.NumChannels()),
                     const_cast<uint8_t*>(view.Values().data()));
  cv::Mat rgb = full;
  if (view.NumChannels() != 3) {
    cv::cvtColor(full, rgb, view.NumChannels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_RGBA2RGB);
  }
  cv::resize(rgb, place, place.size(), 0.0, 0.0, cv::INTER_AREA);
}

/// In 1/16 pixel, OpenCV's convention.
cv::Point OnPicture(const Vec2d& pixel_px, double scale, int offset_px) {
  const Vec2d reduced_px = scale * pixel_px - Vec2d::Constant(0.5);
  return {cvRound((reduced_px.x() + offset_px) * (1 << kShift)),
          cvRound(reduced_px.y() * (1 << kShift))};
}

}  // namespace

Image<uint8_t> MatchPicture(const Image<uint8_t>& first_view,
                            const Image<uint8_t>& second_view,
                            const std::vector<JudgedMatch>& matches,
                            const std::string& title) {
  const int width_px = std::min(kViewWidthPx, first_view.WidthPx());
  const double scale = static_cast<double>(width_px) / first_view.WidthPx();
  const int height_px = std::max(1, cvRound(scale * first_view.HeightPx()));
  Image<uint8_t> picture(2 * width_px, height_px + kCaptionHeightPx, 3);
  cv::Mat canvas(picture.HeightPx(), picture.WidthPx(), CV_8UC3, picture.Values().data());
  PasteReduced(first_view, canvas(cv::Rect(0, 0, width_px, height_px)));
  PasteReduced(second_view, canvas(cv::Rect(width_px, 0, width_px, height_px)));

  const size_t num_correct = std::count_if(matches.begin(), matches.end(), IsCorrect);
  const size_t step = std::max<size_t>(1, (matches.size() + kMaxLines - 1) / kMaxLines);
  for (const bool correct : {false, true}) {  // Correct ones on top.
    const cv::Scalar color = ColorOf(correct);
    for (size_t i = 0; i < matches.size(); ++i) {
      if (IsCorrect(matches[i]) != correct) {
        continue;
      }
      const cv::Point first = OnPicture(matches[i].pixels_px[0], scale, 0);
      const cv::Point second = OnPicture(matches[i].pixels_px[1], scale, width_px);
      cv::circle(canvas, first, 1 << kShift, color, cv::FILLED, cv::LINE_AA, kShift);
      cv::circle(canvas, second, 1 << kShift, color, cv::FILLED, cv::LINE_AA, kShift);
      if (i % step == 0) {
        cv::line(canvas, first, second, color, 1, cv::LINE_AA, kShift);
      }
    }
  }
  const std::string caption =
      fmt::format("{}: {} of {} attempted matches within {:g} m (blue){}",
                  title,
                  num_correct,
                  matches.size(),
                  kPictureToleranceM,
                  step > 1 ? fmt::format(", every {}th as a line", step) : "");
  const double font_scale = width_px >= kViewWidthPx ? 0.6 : 0.4;
  canvas.rowRange(height_px, picture.HeightPx()).setTo(cv::Scalar(20, 20, 20));
  cv::putText(canvas,
              caption,
              cv::Point(8, height_px + 22),
              cv::FONT_HERSHEY_SIMPLEX,
              font_scale,
              cv::Scalar(240, 240, 240),
              1,
              cv::LINE_AA);
  return picture;
}

void WriteMatchPicture(const Image<uint8_t>& first,
                       const Image<uint8_t>& second,
                       const std::vector<JudgedMatch>& matches,
                       const std::string& title,
                       const std::filesystem::path& folder) {
  std::string name;
  for (const char c : title) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (is_plain || (!name.empty() && name.back() != '_')) {
      name += is_plain ? c : '_';
    }
  }
  const Bytes png = EncodePng(MatchPicture(first, second, matches, title));
  WriteFileAtomically(folder / (name + ".png"), std::span(png));
}

}  // namespace pfseq
