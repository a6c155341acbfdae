// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_pictures.h"

#include "renderer/core/error.h"
#include "validator/benchmark/view_source.h"
#include "validator/report/data_uri.h"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace pfseq {
namespace {

constexpr size_t kMaxViews = 3;
constexpr int kWholePx = 240;
/// A detail's side as a share of the image's width, and its least.
constexpr double kDetailShare = 0.2;
constexpr int kLeastDetailPx = 32;

cv::Mat MatOf(const Image<uint8_t>& image) {
  return {image.HeightPx(),
          image.WidthPx(),
          CV_8UC(image.NumChannels()),
          const_cast<uint8_t*>(image.Values().data())};
}

int DetailPx(const Image<uint8_t>& image) {
  const int side_px = std::min(image.WidthPx(), image.HeightPx());
  return std::min(side_px, std::max(kLeastDetailPx, cvRound(kDetailShare * image.WidthPx())));
}

/// The square with the strongest edges within the image circle.
cv::Rect DetailOf(const Image<uint8_t>& image, const Lens& lens) {
  cv::Mat grey = MatOf(image);
  if (image.NumChannels() >= 3) {
    cv::cvtColor(grey, grey, image.NumChannels() == 3 ? cv::COLOR_RGB2GRAY : cv::COLOR_RGBA2GRAY);
  }
  cv::Mat along_x, along_y, strength;
  cv::Sobel(grey, along_x, CV_32F, 1, 0);
  cv::Sobel(grey, along_y, CV_32F, 0, 1);
  cv::magnitude(along_x, along_y, strength);
  const int side_px = DetailPx(image);
  const Vec2d centre_px = lens.PrincipalPointPx();
  const double reach_px = 0.5 * lens.CirclePx();
  cv::Rect best(0, 0, side_px, side_px);
  double most = -1.0;
  const int step_px = std::max(1, side_px / 4);
  for (int y = 0; y + side_px <= image.HeightPx(); y += step_px) {
    for (int x = 0; x + side_px <= image.WidthPx(); x += step_px) {
      const cv::Rect place(x, y, side_px, side_px);
      const Vec2d middle_px(x + 0.5 * side_px, y + 0.5 * side_px);
      const bool is_inside = (middle_px - centre_px).norm() + 0.71 * side_px <= reach_px;
      const double sum = cv::sum(strength(place))[0];
      if (is_inside && sum > most) {
        most = sum;
        best = place;
      }
    }
  }
  return best;
}

Image<uint8_t> Cropped(const Image<uint8_t>& image, const cv::Rect& place) {
  Image<uint8_t> crop(place.width, place.height, image.NumChannels());
  MatOf(image)(place).copyTo(MatOf(crop));
  return crop;
}

Image<uint8_t> Reduced(const Image<uint8_t>& image) {
  const int width_px = std::min(kWholePx, image.WidthPx());
  Image<uint8_t> small(width_px,
                       std::max(1, cvRound(1.0 * width_px * image.HeightPx() / image.WidthPx())),
                       image.NumChannels());
  cv::Mat place = MatOf(small);
  cv::resize(MatOf(image), place, place.size(), 0.0, 0.0, cv::INTER_AREA);
  return small;
}

/// The variant at a level of a factor, all else at its base, in the first repetition.
std::optional<size_t> VariantAt(const StudySpec& study,
                                const std::vector<StudyVariant>& variants,
                                size_t factor_idx,
                                size_t level_idx) {
  for (size_t i = 0; i < variants.size(); ++i) {
    bool fits = variants[i].repetition_idx == 0;
    for (size_t f = 0; f < study.factors.size(); ++f) {
      fits &= variants[i].level_idx[f] == (f == factor_idx ? level_idx : study.factors[f].base_idx);
    }
    if (fits) {
      return i;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<StudyPicture> MakeStudyPictures(const StudySpec& study,
                                            const std::vector<StudyVariant>& variants,
                                            const ResultSet& results,
                                            std::vector<std::string>& remarks) {
  std::vector<StudyPicture> pictures;
  for (size_t f = 0; f < study.factors.size(); ++f) {
    std::vector<std::pair<std::string, cv::Rect>> details;
    const auto add_level = [&](size_t level) {
      const std::optional<size_t> variant = VariantAt(study, variants, f, level);
      if (!variant || results.sources[*variant].sequence_folder.empty()) {
        remarks.push_back(fmt::format("{} {}: its sequence is no longer there: no picture",
                                      study.factors[f].title,
                                      study.factors[f].levels[level].label));
        return;
      }
      const std::unique_ptr<ViewSource> views =
          OpenViews(results.sources[*variant].sequence_folder);
      std::set<std::string> shown;
      for (const ReportCase& one : results.cases) {
        const std::string name =
            fmt::format("{} {}, {}", one.first.camera, one.first.frame, one.lens);
        if (one.source_idx != *variant || shown.size() == kMaxViews || !shown.insert(name).second) {
          continue;
        }
        const Image<uint8_t> image = views->ReadImage(one.lens, one.first, study.images);
        auto known = std::find_if(details.begin(), details.end(), [&](const auto& detail) {
          return detail.first == name;
        });
        if (known == details.end()) {
          known = details.insert(details.end(), {name, DetailOf(image, views->LensOf(one.lens))});
        }
        // A factor may change the image's size.
        cv::Rect place = known->second;
        place.width = std::min(place.width, image.WidthPx());
        place.height = std::min(place.height, image.HeightPx());
        place.x = std::min(place.x, image.WidthPx() - place.width);
        place.y = std::min(place.y, image.HeightPx() - place.height);
        pictures.push_back(
            {f, level, name, JpegUri(Reduced(image)), PngUri(Cropped(image, place)), place.width});
      }
    };
    // The base first: it says where the details lie.
    add_level(study.factors[f].base_idx);
    for (size_t level = 0; level < study.factors[f].levels.size(); ++level) {
      if (level != study.factors[f].base_idx) {
        add_level(level);
      }
    }
  }
  return pictures;
}

}  // namespace pfseq
