// SPDX-License-Identifier: Apache-2.0
// What a grid's triplets would cost when each were run by itself with OpenCV: detect, describe and
// match one pair of views, three times over for nothing shared.
//
// Of each stratum (detector algorithm, polar or not, descriptor algorithm, matcher) one triplet is
// drawn and measured, and counts for all of its stratum. OpenCV's brute force takes time in
// proportion to its queries, so a share of them is measured (each way, for the cross-check).
// CenSurE and FREAK, which Debian's OpenCV lacks, are ours in both. Not counted: reading,
// rectification, judgement. Usage: naive_features DIR GRID LENS FRAME [SEED]
#include "renderer/core/error.h"
#include "renderer/core/parse_number.h"
#include "renderer/core/random.h"
#include "validator/benchmark/view_source.h"
#include "validator/features/describe.h"
#include "validator/features/detect.h"
#include "validator/features/work_image.h"
#include "validator/grid/grid.h"

#include <ctime>
#include <map>

#include <fmt/format.h>
#include <opencv2/features2d.hpp>

namespace {

using namespace pfseq;

constexpr int kMeasuredQueries = 400;

double CpuS() {
  timespec time = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Triplet {
  DetectorSetting detector;
  Setting descriptor;
  Setting matcher;
};

/// CPU seconds of all of first's rows as queries, from some of them.
double QueriesS(const cv::Mat& first, const cv::Mat& second, int norm, int neighbours) {
  if (first.empty() || second.rows < neighbours) {
    return 0.0;
  }
  const int measured = std::min(kMeasuredQueries, first.rows);
  std::vector<std::vector<cv::DMatch>> matches;
  const double start_s = CpuS();
  cv::BFMatcher(norm).knnMatch(first.rowRange(0, measured), second, matches, neighbours);
  return (CpuS() - start_s) * first.rows / measured;
}

double MatchS(const Descriptors& first, const Descriptors& second, const Setting& matcher) {
  cv::Mat a = first.rows, b = second.rows;
  int norm = first.norm == Norm::kHamming ? cv::NORM_HAMMING : cv::NORM_HAMMING2;
  if (first.norm == Norm::kL2) {
    norm = cv::NORM_L2;
    a.convertTo(a, CV_32F);
    b.convertTo(b, CV_32F);
  }
  if (matcher.Is("FLANN")) {
    std::vector<std::vector<cv::DMatch>> matches;
    const double start_s = CpuS();
    if (a.rows > 0 && b.rows > 1) {
      cv::FlannBasedMatcher().knnMatch(a, b, matches, 2);
    }
    return CpuS() - start_s;
  }
  return matcher.Is("RatioTest") ? QueriesS(a, b, norm, 2)
                                 : QueriesS(a, b, norm, 1) + QueriesS(b, a, norm, 1);
}

void Run(int argc, char** argv) {
  if (argc < 5) {
    throw InputError("usage: naive_features DIR GRID LENS FRAME [SEED]");
  }
  const auto source = OpenViews(argv[1]);
  const Grid grid = Grid::Read(argv[2]);
  const std::string lens = argv[3];
  const int frame = ParseNumber<int>(argv[4]).value_or(0);
  RandomStream random{ParseNumber<uint64_t>(argc > 5 ? argv[5] : "1").value_or(1)};
  const std::string variant = source->Variants().front();
  std::array<std::array<WorkImage, 2>, 2> images;  // [polar][view]
  for (size_t view = 0; view < 2; ++view) {
    const Image<uint8_t> image = source->ReadImage(lens, {source->Cameras()[view], frame}, variant);
    images[0][view] = WorkImage::Fisheye(image);
    images[1][view] = WorkImage::Polar(image, source->LensOf(lens));
  }
  std::map<std::string, std::vector<Triplet>> strata;
  for (const GridDetector& detector : grid.detectors) {
    for (const auto& descriptor : detector.descriptors) {
      for (const Setting& matcher : descriptor.matchers) {
        strata[fmt::format("{:<8}{:<6}{:<6}{}",
                           detector.detector.setting.Kind().name,
                           detector.detector.is_polar ? "pol" : "nopol",
                           descriptor.descriptor.Kind().name,
                           matcher.Kind().name)]
            .push_back({detector.detector, descriptor.descriptor, matcher});
      }
    }
  }
  cv::setNumThreads(1);
  fmt::print("{:<32}{:>6}{:>9}{:>9}{:>9}{:>9}{:>11}\n",
             "stratum",
             "size",
             "points",
             "detect",
             "describe",
             "match",
             "all of it");
  double total_s = 0.0;
  for (const auto& [name, triplets] : strata) {
    const Triplet& drawn =
        triplets[static_cast<size_t>(random.Integer(0, static_cast<int>(triplets.size()) - 1))];
    const auto& views = images[drawn.detector.is_polar ? 1 : 0];
    const double start_s = CpuS();
    std::array<KeyPoints, 2> points;
    for (size_t i = 0; i < 2; ++i) {
      points[i] = Detect(views[i].grey, drawn.detector.setting);
    }
    const double detected_s = CpuS();
    std::array<Descriptors, 2> descriptors;
    for (size_t i = 0; i < 2; ++i) {
      descriptors[i] = Describe(views[i].grey, points[i], drawn.detector.setting, drawn.descriptor);
    }
    const double described_s = CpuS();
    const double match_s = MatchS(descriptors[0], descriptors[1], drawn.matcher);
    const double all_s = described_s - start_s + match_s;
    total_s += all_s * static_cast<double>(triplets.size());
    fmt::print("{:<32}{:>6}{:>9}{:>9.2f}{:>9.2f}{:>9.2f}{:>11.0f}\n",
               name,
               triplets.size(),
               points[0].size(),
               detected_s - start_s,
               described_s - detected_s,
               match_s,
               all_s * static_cast<double>(triplets.size()));
  }
  fmt::print("all {} triplets on this pair: {:.2f} CPU hours; measuring took {:.0f} CPU s\n",
             grid.TripletNames().size(),
             total_s / 3600.0,
             CpuS());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "naive_features: {}\n", error.what());
    return 2;
  }
  return 0;
}
