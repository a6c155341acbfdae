// SPDX-License-Identifier: Apache-2.0
#include "validator/report/sequence_pictures.h"

#include "renderer/core/error.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/layout.h"
#include "renderer/sequence/sequence_reader.h"
#include "validator/benchmark/benchmark.h"
#include "validator/false_color.h"
#include "validator/match_picture.h"
#include "validator/report/data_uri.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace pfseq {
namespace {

constexpr int kViewPx = 700;
const cv::Scalar kPointColor(240, 228, 66);

cv::Mat MatOf(const Image<uint8_t>& image) {
  return {image.HeightPx(),
          image.WidthPx(),
          CV_8UC(image.NumChannels()),
          const_cast<uint8_t*>(image.Values().data())};
}

/// Images side by side as RGB, each at most kViewPx wide, a row for the legend below.
Image<uint8_t> SideBySide(const std::vector<Image<uint8_t>>& views, int extra_px) {
  const int width_px = std::min(kViewPx, views[0].WidthPx());
  const int height_px =
      std::max(1, cvRound(1.0 * width_px * views[0].HeightPx() / views[0].WidthPx()));
  Image<uint8_t> picture(width_px * static_cast<int>(views.size()), height_px + extra_px, 3, 255);
  cv::Mat canvas = MatOf(picture);
  for (size_t i = 0; i < views.size(); ++i) {
    cv::Mat rgb = MatOf(views[i]);
    if (views[i].NumChannels() != 3) {
      cv::cvtColor(rgb, rgb, views[i].NumChannels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_RGBA2RGB);
    }
    cv::Mat place = canvas(cv::Rect(static_cast<int>(i) * width_px, 0, width_px, height_px));
    cv::resize(rgb, place, place.size(), 0.0, 0.0, cv::INTER_AREA);
  }
  return picture;
}

Image<uint8_t> KeyPointPicture(const std::vector<Image<uint8_t>>& views,
                               const TripletMatches& matches) {
  Image<uint8_t> picture = SideBySide(views, 0);
  cv::Mat canvas = MatOf(picture);
  const int width_px = picture.WidthPx() / 2;
  const double scale = static_cast<double>(width_px) / views[0].WidthPx();
  for (size_t view = 0; view < 2; ++view) {
    for (const Vec2d& pixel_px : matches.detections_px[view]) {
      const cv::Point centre(
          cvRound((scale * pixel_px.x() + static_cast<double>(view) * width_px) * 16.0 - 8.0),
          cvRound(scale * pixel_px.y() * 16.0 - 8.0));
      cv::circle(canvas, centre, 20, kPointColor, cv::FILLED, cv::LINE_AA, 4);
    }
  }
  return picture;
}

Image<uint8_t> DistancePicture(const std::vector<Image<float>>& maps) {
  Image<uint8_t> picture = SideBySide({DistanceInColor(maps[0]), DistanceInColor(maps[1])}, 44);
  const Image<uint8_t> legend = DistanceLegend(picture.WidthPx());
  MatOf(legend).copyTo(
      MatOf(picture).rowRange(picture.HeightPx() - legend.HeightPx(), picture.HeightPx()));
  return picture;
}

/// Pictures of one benchmark's sequence.
class SourcePictures {
 public:
  SourcePictures(const ResultSet& results, size_t source_idx, SequencePictures& out)
      : results_(results),
        source_idx_(source_idx),
        out_(out),
        views_(OpenViews(results.sources[source_idx].sequence_folder)) {}

  void Make(const std::vector<size_t>& cases,
            const std::vector<std::string>& setups,
            int num_threads,
            bool quiet) {
    for (const size_t case_idx : cases) {
      MakeCase(case_idx, setups, num_threads, quiet);
    }
    Drive(cases);
  }

 private:
  const ResultsSource& Source() const { return results_.sources[source_idx_]; }

  void Add(size_t case_idx, std::string title, std::string caption, const Image<uint8_t>& picture) {
    out_.pictures.push_back({case_idx,
                             std::move(title),
                             std::move(caption),
                             JpegUri(picture),
                             picture.WidthPx(),
                             picture.HeightPx()});
  }

  /// The first view's blur map; nothing where the sequence has none or the images have no blur.
  std::optional<Image<float>> BlurOf(const ReportCase& one) const {
    const FrameFile file{one.lens, one.first.camera, Output::kBlur, one.first.frame};
    const std::filesystem::path path = Source().sequence_folder / file.RelativePath();
    if (Source().variant != "realistic" || !std::filesystem::exists(path)) {
      return std::nullopt;
    }
    Image<float> blur_px = ReadExr(path);
    if (blur_px.NumChannels() != 2) {
      throw InputError("{}: expected two channels, got {}", path.string(), blur_px.NumChannels());
    }
    return blur_px;
  }

  void MakeCase(size_t case_idx,
                const std::vector<std::string>& setups,
                int num_threads,
                bool quiet) {
    const ReportCase& one = results_.cases[case_idx];
    std::map<std::string, TripletMatches> shown;
    std::mutex mutex;
    if (!setups.empty()) {
      BenchmarkOptions options;
      options.pairs = fmt::format(
          "{}:{}-{}:{}", one.first.camera, one.first.frame, one.second.camera, one.second.frame);
      options.lenses = {one.lens};
      options.variant = Source().variant;
      options.judge = Source().judge == "map" ? Judge::kMap : Judge::kRay;
      options.num_threads = num_threads;
      options.quiet = quiet;
      options.observer = [&](const TripletMatches& matches) {
        const std::lock_guard lock(mutex);
        shown.emplace(matches.setup, matches);
      };
      RunBenchmark(*views_, Grid::FromNames(setups), options);
    }
    const std::vector<Image<uint8_t>> images = {
        views_->ReadImage(one.lens, one.first, Source().variant),
        views_->ReadImage(one.lens, one.second, Source().variant)};
    const std::optional<Image<float>> blur_px = BlurOf(one);
    bool has_points = false;
    for (const std::string& setup : setups) {
      const auto found = shown.find(setup);
      if (found == shown.end()) {
        continue;
      }
      const TripletMatches& matches = found->second;
      if (!has_points) {
        Add(case_idx,
            "Key points",
            fmt::format("{}: {} and {} key points ({})",
                        one.label,
                        matches.detections_px[0].size(),
                        matches.detections_px[1].size(),
                        setup),
            KeyPointPicture(images, matches));
        has_points = true;
      }
      Add(case_idx,
          "Matches",
          fmt::format("{}: {}; blue within {:g} cm in the world, orange not",
                      one.label,
                      setup,
                      100.0 * kPictureToleranceM),
          MatchPicture(images[0], images[1], matches.Judged(), setup));
      out_.failures.push_back(
          FailuresOf(case_idx, matches, views_->LensOf(one.lens), blur_px ? &*blur_px : nullptr));
    }
    if (!has_points) {
      Add(case_idx, "Views", one.label, SideBySide(images, 0));
    }
    try {
      Add(case_idx,
          "Distance and sky",
          fmt::format("{}: distance along the rays; light grey: sky or beyond {:g} m",
                      one.label,
                      views_->MaxDistanceM()),
          DistancePicture({views_->ReadDistance(one.lens, one.first),
                           views_->ReadDistance(one.lens, one.second)}));
    } catch (const InputError& error) {
      out_.remarks.push_back(fmt::format("{}: no distance map: {}", one.label, error.what()));
    }
  }

  void Drive(const std::vector<size_t>& cases) {
    DrivePath drive{source_idx_, {}, {}};
    if (std::filesystem::is_directory(Source().sequence_folder)) {
      const SequenceReader reader(Source().sequence_folder);
      for (size_t frame = 0; frame < reader.Poses().size(); ++frame) {
        const Vec3d& place_m = reader.Poses()[frame].world_from_rig.translation_m;
        drive.path.push_back({static_cast<int>(frame), place_m.x(), place_m.y()});
      }
    }
    std::set<std::string> known;
    for (const size_t case_idx : cases) {
      for (const ViewName& view :
           {results_.cases[case_idx].first, results_.cases[case_idx].second}) {
        const Vec3d place_m = views_->WorldFromCamera(view).translation_m;
        const std::string label = fmt::format("{} {}", view.camera, view.frame);
        if (known.insert(label).second) {
          drive.marks.push_back({label, place_m.x(), place_m.y()});
        }
      }
    }
    out_.drives.push_back(std::move(drive));
  }

  const ResultSet& results_;
  size_t source_idx_;
  SequencePictures& out_;
  std::unique_ptr<ViewSource> views_;
};

}  // namespace

SequencePictures MakeSequencePictures(const ResultSet& results,
                                      const std::vector<std::string>& setups,
                                      int num_threads,
                                      bool quiet) {
  SequencePictures out;
  for (size_t source_idx = 0; source_idx < results.sources.size(); ++source_idx) {
    const ResultsSource& source = results.sources[source_idx];
    if (source.sequence_folder.empty()) {
      out.remarks.push_back(
          fmt::format("{}: the folder of its sequence '{}' is not known; give it with --sequence",
                      source.name,
                      source.sequence));
      continue;
    }
    std::vector<size_t> cases;
    size_t num_cases = 0;
    for (size_t i = 0; i < results.cases.size(); ++i) {
      if (results.cases[i].source_idx == source_idx && ++num_cases <= kMaxPictureCases) {
        cases.push_back(i);
      }
    }
    if (num_cases > cases.size()) {
      out.remarks.push_back(fmt::format(
          "{}: pictures of its first {} pairs of {}", source.name, cases.size(), num_cases));
    }
    SourcePictures(results, source_idx, out).Make(cases, setups, num_threads, quiet);
  }
  return out;
}

}  // namespace pfseq
