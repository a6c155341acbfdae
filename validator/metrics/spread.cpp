// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

constexpr int kNumRings = 8;
constexpr int kNumSectors = 16;
constexpr int kNumCells = kNumRings * kNumSectors;
constexpr int kEnough = 2;
constexpr int kLiCellPx = 80;

/// In [0, 1): share of the disc's area within the point's radius, and of a turn.
Vec2d EqualAreaPlace(const Vec2d& point) {
  constexpr double kBelowOne = 1.0 - 1e-12;
  double turn = std::atan2(point.y(), point.x()) / (2.0 * std::numbers::pi);
  turn -= std::floor(turn);
  return {std::min(point.squaredNorm(), kBelowOne), std::min(turn, kBelowOne)};
}

/// Distances between the centres of cells.
const std::vector<double>& CellDistances() {
  static const std::vector<double> distances = [] {
    std::vector<Vec2d> centres;
    for (int i = 0; i < kNumCells; ++i) {
      const double radius = std::sqrt((i / kNumSectors + 0.5) / kNumRings);
      const double angle_rad = 2.0 * std::numbers::pi * (i % kNumSectors + 0.5) / kNumSectors;
      centres.emplace_back(radius * std::cos(angle_rad), radius * std::sin(angle_rad));
    }
    std::vector<double> result;
    for (const Vec2d& a : centres) {
      for (const Vec2d& b : centres) {
        result.push_back((a - b).norm());
      }
    }
    return result;
  }();
  return distances;
}

}  // namespace

SpreadCounter::SpreadCounter() : counts_(kNumCells, 0) {
  for (size_t level = 0; level < occupied_.size(); ++level) {
    occupied_[level].assign(size_t{1} << (2 * (level + 1)), false);
  }
}

void SpreadCounter::Add(const Vec2d& point_in_disc) {
  ++num_points_;
  sum_ += point_in_disc;
  sum_of_squares_ += point_in_disc.squaredNorm();
  const Vec2d place = EqualAreaPlace(point_in_disc);
  ++counts_[static_cast<int>(place.x() * kNumRings) * kNumSectors +
            static_cast<int>(place.y() * kNumSectors)];
  for (size_t level = 0; level < occupied_.size(); ++level) {
    const int side = 2 << level;
    const size_t cell =
        static_cast<size_t>(place.x() * side) * side + static_cast<size_t>(place.y() * side);
    if (!occupied_[level][cell]) {
      occupied_[level][cell] = true;
      ++num_occupied_[level];
    }
  }
}

SpreadScores SpreadCounter::Scores() const {
  SpreadScores scores;
  if (num_points_ == 0) {
    return scores;
  }
  const double n = num_points_;
  scores.cells = static_cast<double>(std::count_if(
                     counts_.begin(), counts_.end(), [](int count) { return count >= kEnough; })) /
                 kNumCells;
  const double variance = std::max(0.0, sum_of_squares_ / n - (sum_ / n).squaredNorm());
  scores.deviation = std::sqrt(2.0 * variance);
  if (num_points_ > 1) {
    const std::vector<double>& distances = CellDistances();
    double sum = 0.0;
    for (int a = 0; a < kNumCells; ++a) {
      for (int b = 0; b < a && counts_[a] > 0; ++b) {
        sum += static_cast<double>(counts_[a]) * counts_[b] * distances[a * kNumCells + b];
      }
    }
    scores.distance = sum / (0.5 * n * (n - 1.0)) * (45.0 * std::numbers::pi / 128.0);
  }
  for (size_t level = 0; level < occupied_.size(); ++level) {
    scores.coverage += static_cast<double>(num_occupied_[level]) /
                       static_cast<double>(occupied_[level].size() * occupied_.size());
  }
  return scores;
}

double Uniformity(const std::vector<Vec2d>& pixels_px, int width_px, int height_px) {
  const int columns = (width_px + kLiCellPx - 1) / kLiCellPx;
  const int rows = (height_px + kLiCellPx - 1) / kLiCellPx;
  std::vector<int> counts(static_cast<size_t>(columns) * rows, 0);
  for (const Vec2d& pixel_px : pixels_px) {
    const int x = std::clamp(static_cast<int>(pixel_px.x()) / kLiCellPx, 0, columns - 1);
    const int y = std::clamp(static_cast<int>(pixel_px.y()) / kLiCellPx, 0, rows - 1);
    ++counts[static_cast<size_t>(y) * columns + x];
  }
  return static_cast<double>(std::count_if(
             counts.begin(), counts.end(), [](int count) { return count >= kEnough; })) /
         static_cast<double>(counts.size());
}

}  // namespace pfseq
