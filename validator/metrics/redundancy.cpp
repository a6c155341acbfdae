// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/redundancy.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

/// Side of the raster's cells in pixels; a Gaussian is never narrower.
constexpr double kCellPx = 2.0;

/// Samples of a one-dimensional Gaussian that sum to one, over the cells around a place.
std::vector<double> Profile(double place, double sigma, double reach, int begin, int end) {
  std::vector<double> values;
  double sum = 0.0;
  for (int i = static_cast<int>(std::floor(place - reach)); i <= static_cast<int>(place + reach);
       ++i) {
    const double offset = (i + 0.5 - place) / sigma;
    const double value = std::exp(-0.5 * offset * offset);
    sum += value;
    if (i >= begin && i < end) {
      values.push_back(value);
    }
  }
  for (double& value : values) {
    value /= sum;
  }
  return values;
}

}  // namespace

NonRedundantCount::NonRedundantCount(int width_px, int height_px)
    : width_(static_cast<int>(std::ceil(width_px / kCellPx))),
      height_(static_cast<int>(std::ceil(height_px / kCellPx))),
      highest_(static_cast<size_t>(width_) * height_, 0.0F) {}

void NonRedundantCount::Add(const Support& support) {
  const double sigma = std::max(1.0, 0.25 * support.size_px / kCellPx);
  const double reach = 2.0 * sigma;
  const Vec2d place = support.pixel_px / kCellPx;
  const std::vector<double> across = Profile(place.x(), sigma, reach, 0, width_);
  const std::vector<double> down = Profile(place.y(), sigma, reach, 0, height_);
  const int first_x = std::max(0, static_cast<int>(std::floor(place.x() - reach)));
  const int first_y = std::max(0, static_cast<int>(std::floor(place.y() - reach)));
  double added = 0.0;
  for (size_t j = 0; j < down.size(); ++j) {
    float* row = highest_.data() + (first_y + j) * width_ + first_x;
    for (size_t i = 0; i < across.size(); ++i) {
      const auto value = static_cast<float>(down[j] * across[i]);
      added += std::max(0.0F, value - row[i]);
      row[i] = std::max(row[i], value);
    }
  }
  volume_ += added;
}

}  // namespace pfseq
