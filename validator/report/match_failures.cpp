// SPDX-License-Identifier: Apache-2.0
#include "validator/report/match_failures.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr size_t kNumRadiusBins = 10;
constexpr double kDistanceBinsM[] = {5.0, 10.0, 20.0, 40.0, 80.0};
constexpr double kBlurBinsPx[] = {0.5, 1.0, 2.0, 4.0, 8.0, 16.0};

/// "under 5 m", "5 to 10 m", ..., "over 80 m".
std::vector<FailureBin> BinsBetween(std::span<const double> limits, const std::string& unit) {
  std::vector<FailureBin> bins = {{fmt::format("under {:g} {}", limits.front(), unit), 0, 0}};
  for (size_t i = 1; i < limits.size(); ++i) {
    bins.push_back({fmt::format("{:g} to {:g} {}", limits[i - 1], limits[i], unit), 0, 0});
  }
  bins.push_back({fmt::format("over {:g} {}", limits.back(), unit), 0, 0});
  return bins;
}

size_t BinOf(std::span<const double> limits, double value) {
  return static_cast<size_t>(std::upper_bound(limits.begin(), limits.end(), value) -
                             limits.begin());
}

double BlurPx(const Image<float>& blur_px, const Vec2d& pixel_px) {
  const int x = std::clamp(static_cast<int>(pixel_px.x()), 0, blur_px.WidthPx() - 1);
  const int y = std::clamp(static_cast<int>(pixel_px.y()), 0, blur_px.HeightPx() - 1);
  return std::hypot(blur_px.At(x, y, 0), blur_px.At(x, y, 1));
}

}  // namespace

FailureTable FailuresOf(size_t case_idx,
                        const TripletMatches& matches,
                        const Lens& lens,
                        const Image<float>* blur_px) {
  FailureTable table{case_idx, matches.setup, {}, BinsBetween(kDistanceBinsM, "m"), {}};
  table.by_distance.push_back({"sky", 0, 0});
  for (size_t i = 0; i < kNumRadiusBins; ++i) {
    table.by_radius.push_back({fmt::format("{:.1f} to {:.1f}", i / 10.0, (i + 1) / 10.0), 0, 0});
  }
  if (blur_px != nullptr) {
    table.by_blur = BinsBetween(kBlurBinsPx, "px");
  }
  const std::vector<JudgedMatch> judged = matches.Judged();
  for (size_t i = 0; i < judged.size(); ++i) {
    const Vec2d& pixel_px = judged[i].pixels_px[0];
    const auto count = [&](FailureBin& bin) {
      ++bin.attempted;
      bin.correct += judged[i].distance_m < kPictureToleranceM ? 1 : 0;
    };
    const double radius = (pixel_px - lens.PrincipalPointPx()).norm() / (0.5 * lens.CirclePx());
    count(table.by_radius[std::min(kNumRadiusBins - 1,
                                   static_cast<size_t>(radius * kNumRadiusBins))]);
    const auto& place = matches.points.first_m[matches.attempted[i].first];
    count(place ? table.by_distance[BinOf(kDistanceBinsM,
                                          (*place - matches.points.first_centre_m).norm())]
                : table.by_distance.back());
    if (blur_px != nullptr) {
      count(table.by_blur[BinOf(kBlurBinsPx, BlurPx(*blur_px, pixel_px))]);
    }
  }
  return table;
}

}  // namespace pfseq
