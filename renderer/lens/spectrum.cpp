// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/spectrum.h"

#include "renderer/core/check.h"

#include <cmath>

namespace pfseq {
namespace {

constexpr double kFirstNm = 400.0;
constexpr double kLastNm = 700.0;

/// A Gaussian with another width on each side.
double Lobe(double wavelength_nm, double mean_nm, double below_nm, double above_nm) {
  const double t = (wavelength_nm - mean_nm) / (wavelength_nm < mean_nm ? below_nm : above_nm);
  return std::exp(-0.5 * t * t);
}

Vec3d ColorMatching(double nm) {
  return {1.056 * Lobe(nm, 599.8, 37.9, 31.0) + 0.362 * Lobe(nm, 442.0, 16.0, 26.7) -
              0.065 * Lobe(nm, 501.1, 20.4, 26.2),
          0.821 * Lobe(nm, 568.8, 46.9, 40.5) + 0.286 * Lobe(nm, 530.9, 16.3, 31.1),
          1.217 * Lobe(nm, 437.0, 11.8, 36.0) + 0.681 * Lobe(nm, 459.0, 26.0, 13.8)};
}

/// ITU-R BT.709-6 primaries and white point.
Vec3d Rec709(const Vec3d& xyz) {
  Eigen::Matrix3d rgb_from_xyz;
  rgb_from_xyz << 3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108, 0.0415560, 0.0556434,
      -0.2040259, 1.0572252;
  return rgb_from_xyz * xyz;
}

}  // namespace

std::vector<SpectralSample> VisibleSpectrum(int num_samples) {
  PFSEQ_CHECK(num_samples >= 3, "{} samples", num_samples);
  std::vector<SpectralSample> samples;
  Vec3d sum = Vec3d::Zero();
  for (int i = 0; i < num_samples; ++i) {
    const double nm = kFirstNm + (i + 0.5) / num_samples * (kLastNm - kFirstNm);
    samples.push_back({nm, Rec709(ColorMatching(nm)).cwiseMax(0.0)});
    sum += samples.back().weights;
  }
  for (SpectralSample& sample : samples) {
    sample.weights = sample.weights.cwiseQuotient(sum);
  }
  return samples;
}

}  // namespace pfseq
