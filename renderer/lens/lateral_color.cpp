// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/lateral_color.h"

#include "renderer/core/check.h"
#include "renderer/lens/spectrum.h"

#include <cmath>

namespace pfseq {
namespace {

/// Fraunhofer lines.
constexpr double kRedNm = 656.3;
constexpr double kBlueNm = 486.1;
/// Enough for integrals over the spectrum.
constexpr int kNumIntegrationSamples = 300;

double InverseSquare(double value) { return 1.0 / (value * value); }

}  // namespace

LateralColor::LateralColor(double rim_px, double cubic, double circle_radius_px)
    : linear_((1.0 - cubic) * rim_px / circle_radius_px),
      cubic_per_px2_(cubic * rim_px / std::pow(circle_radius_px, 3)) {
  PFSEQ_CHECK(circle_radius_px > 0.0, "{}", circle_radius_px);
}

double LateralColor::Dispersion(double wavelength_nm) {
  return (InverseSquare(kReferenceNm) - InverseSquare(wavelength_nm)) /
         (InverseSquare(kBlueNm) - InverseSquare(kRedNm));
}

double LateralColor::ReferenceHeightPx(double wavelength_nm, double height_px) const {
  const double dispersion = Dispersion(wavelength_nm);
  double reference_px = height_px;
  // Newton's method; the shift is small against the height.
  constexpr int kNumSteps = 6;
  for (int i = 0; i < kNumSteps; ++i) {
    const double slope =
        1.0 + dispersion * (linear_ + 3.0 * cubic_per_px2_ * reference_px * reference_px);
    reference_px -= (reference_px + dispersion * Shift(reference_px) - height_px) / slope;
  }
  return reference_px;
}

std::array<std::array<double, 2>, 3> LateralColor::ChannelPolynomials() const {
  std::array<std::array<double, 2>, 3> polynomials{};
  for (const SpectralSample& sample : VisibleSpectrum(kNumIntegrationSamples)) {
    for (int channel = 0; channel < 3; ++channel) {
      const double share = sample.weights[channel] * Dispersion(sample.wavelength_nm);
      polynomials[static_cast<size_t>(channel)][0] += share * linear_;
      polynomials[static_cast<size_t>(channel)][1] += share * cubic_per_px2_;
    }
  }
  return polynomials;
}

}  // namespace pfseq
