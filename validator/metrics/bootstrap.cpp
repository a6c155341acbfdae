// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/bootstrap.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pfseq {
namespace {

constexpr int kSide = 8;

}  // namespace

int BootstrapCell(const Vec2d& point_in_disc) {
  const int ring = std::min(static_cast<int>(point_in_disc.squaredNorm() * kSide), kSide - 1);
  double turn = std::atan2(point_in_disc.y(), point_in_disc.x()) / (2.0 * std::numbers::pi);
  turn -= std::floor(turn);
  return ring * kSide + std::min(static_cast<int>(turn * kSide), kSide - 1);
}

BootstrapDraws::BootstrapDraws(uint64_t seed) {
  for (int draw = 0; draw < kNumBootstrapDraws; ++draw) {
    RandomStream random({seed, static_cast<uint64_t>(draw)});
    std::array<uint8_t, kNumBootstrapCells>& times = draws_.emplace_back();
    times.fill(0);
    for (int i = 0; i < kNumBootstrapCells; ++i) {
      ++times[random.Integer(0, kNumBootstrapCells - 1)];
    }
  }
}

Interval BootstrapDraws::IntervalOf(const std::array<int, kNumBootstrapCells>& part,
                                    const std::array<int, kNumBootstrapCells>& whole) const {
  std::vector<double> shares;
  for (const std::array<uint8_t, kNumBootstrapCells>& times : draws_) {
    int part_sum = 0;
    int whole_sum = 0;
    for (int i = 0; i < kNumBootstrapCells; ++i) {
      part_sum += times[i] * part[i];
      whole_sum += times[i] * whole[i];
    }
    if (whole_sum > 0) {
      shares.push_back(static_cast<double>(part_sum) / whole_sum);
    }
  }
  if (shares.empty()) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  std::sort(shares.begin(), shares.end());
  const auto quantile = [&](double q) {
    return shares[static_cast<size_t>(std::lround(q * static_cast<double>(shares.size() - 1)))];
  };
  return {quantile(0.025), quantile(0.975)};
}

}  // namespace pfseq
