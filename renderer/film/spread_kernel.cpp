// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/spread_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

constexpr int kCells = CellFilm::kCells;
/// Outer cells that together have less than this share of every channel's light are left out.
constexpr float kNegligibleShare = 2e-3F;

/// The integral of the normal distribution function, u Phi(u) + phi(u), from a table: linear
/// between its points it is off by 1e-6 at most.
class SecondIntegral {
 public:
  SecondIntegral() {
    for (size_t i = 0; i < values_.size(); ++i) {
      const double u = (static_cast<double>(i) - kMiddle) / kPointsPerUnit;
      values_[i] = u * 0.5 * std::erfc(-u / std::numbers::sqrt2) +
                   std::exp(-0.5 * u * u) / std::sqrt(2.0 * std::numbers::pi);
    }
  }
  double operator()(double u) const {
    const double place = u * kPointsPerUnit + kMiddle;
    if (!(place > 0.0)) {
      return 0.0;
    }
    if (place >= 2.0 * kMiddle) {
      return u;
    }
    const auto i = static_cast<size_t>(place);
    return values_[i] + (place - static_cast<double>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr double kPointsPerUnit = 256.0;
  static constexpr double kMiddle = 6.0 * kPointsPerUnit;
  std::array<double, static_cast<size_t>(2.0 * kMiddle) + 2> values_{};
};

/// The same of a distribution with the standard deviation sigma.
double ScaledIntegral(double x, double sigma) {
  static const SecondIntegral kIntegral;
  return sigma > 0.0 ? sigma * kIntegral(x / sigma) : std::max(x, 0.0);
}

/// Shares of a Gaussian about `middle`, spread over a pixel, that fall into cells from the first
/// one on; cell 0 starts at `start`.
struct CellShares {
  CellShares(double start, int num_cells, double middle, double sigma) {
    const double reach = SpreadKernel::kCutoffSigmas * sigma + 0.5;
    first =
        std::clamp(static_cast<int>(std::floor((middle - reach - start) * kCells)), 0, num_cells);
    const int end = std::clamp(
        static_cast<int>(std::ceil((middle + reach - start) * kCells)), first, num_cells);
    count = end - first;
    shares.resize(static_cast<size_t>(count));
    double below = Below(start + static_cast<double>(first) / kCells - middle, sigma);
    for (int i = 0; i < count; ++i) {
      const double next =
          Below(start + static_cast<double>(first + i + 1) / kCells - middle, sigma);
      shares[static_cast<size_t>(i)] = static_cast<float>(next - below);
      below = next;
    }
  }

  int first = 0;
  int count = 0;
  std::vector<float> shares;

 private:
  static double Below(double x, double sigma) {
    return ScaledIntegral(x + 0.5, sigma) - ScaledIntegral(x - 0.5, sigma);
  }
};

}  // namespace

SpreadKernel::SpreadKernel(int reach_px) : reach_px_(reach_px), side_((2 * reach_px + 1) * kCells) {
  for (std::vector<float>& plane : weights_) {
    plane.assign(static_cast<size_t>(side_) * static_cast<size_t>(side_), 0.0F);
  }
}

void SpreadKernel::AddGaussian(const Vec2d& offset_px, double sigma_px, const Vec3d& weights) {
  const double start_px = -reach_px_ - 0.5;
  const CellShares along_x(start_px, side_, offset_px.x(), sigma_px);
  const CellShares along_y(start_px, side_, offset_px.y(), sigma_px);
  for (size_t channel = 0; channel < 3; ++channel) {
    const auto weight = static_cast<float>(weights[static_cast<int>(channel)]);
    for (int j = 0; j < along_y.count; ++j) {
      const float row_weight = weight * along_y.shares[static_cast<size_t>(j)];
      float* row = &At(channel, along_x.first, along_y.first + j);
      for (int i = 0; i < along_x.count; ++i) {
        row[i] += row_weight * along_x.shares[static_cast<size_t>(i)];
      }
    }
  }
}

SpreadKernel SpreadKernel::Trimmed() const {
  std::vector<std::array<float, 3>> rings(static_cast<size_t>(reach_px_) + 1);
  std::array<float, 3> sums{};
  for (size_t channel = 0; channel < 3; ++channel) {
    for (int y = 0; y < side_; ++y) {
      for (int x = 0; x < side_; ++x) {
        const int ring =
            std::max(std::abs(x / kCells - reach_px_), std::abs(y / kCells - reach_px_));
        rings[static_cast<size_t>(ring)][channel] += At(channel, x, y);
      }
    }
    for (const std::array<float, 3>& ring : rings) {
      sums[channel] += ring[channel];
    }
  }
  int kept = reach_px_;
  std::array<float, 3> left = sums;
  while (kept > 0) {
    bool is_negligible = true;
    std::array<float, 3> without = left;
    for (size_t channel = 0; channel < 3; ++channel) {
      without[channel] -= rings[static_cast<size_t>(kept)][channel];
      is_negligible =
          is_negligible && sums[channel] - without[channel] < kNegligibleShare * sums[channel];
    }
    if (!is_negligible) {
      break;
    }
    left = without;
    --kept;
  }
  SpreadKernel trimmed(kept);
  const int skipped = (reach_px_ - kept) * kCells;
  for (size_t channel = 0; channel < 3; ++channel) {
    for (int y = 0; y < trimmed.side_; ++y) {
      for (int x = 0; x < trimmed.side_; ++x) {
        trimmed.At(channel, x, y) = At(channel, x + skipped, y + skipped) / left[channel];
      }
    }
  }
  return trimmed;
}

}  // namespace pfseq
