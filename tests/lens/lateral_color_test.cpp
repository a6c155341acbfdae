// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/lateral_color.h"

#include "renderer/lens/spectrum.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(LateralColor, SeparatesTheFraunhoferLinesByTheRimsShift) {
  const LateralColor color(3.0, 0.25, 500.0);
  const auto separation_px = [&](double height_px) {
    return color.HeightPx(656.3, height_px) - color.HeightPx(486.1, height_px);
  };
  EXPECT_NEAR(separation_px(500.0), 3.0, 1e-9);
  // 0.75 * 0.5 + 0.25 * 0.125 of it.
  EXPECT_NEAR(separation_px(250.0), 3.0 * 0.40625, 1e-9);
  EXPECT_DOUBLE_EQ(color.HeightPx(LateralColor::kReferenceNm, 321.0), 321.0);
  EXPECT_GT(color.HeightPx(700.0, 400.0), 400.0);
}

TEST(LateralColor, ReferenceHeightIsTheInverse) {
  const LateralColor color(-6.0, 0.7, 450.0);
  for (const double nm : {400.0, 470.0, 550.0, 700.0}) {
    for (const double height_px : {0.0, 1.0, 200.0, 449.0, 470.0}) {
      EXPECT_NEAR(color.ReferenceHeightPx(nm, color.HeightPx(nm, height_px)), height_px, 1e-9);
    }
  }
}

TEST(LateralColor, ChannelPolynomialsAreMeansOverTheSpectrum) {
  const LateralColor color(4.0, 0.5, 600.0);
  const auto polynomials = color.ChannelPolynomials();
  for (const double height_px : {120.0, 360.0, 600.0}) {
    Vec3d mean_px = Vec3d::Zero();
    for (const SpectralSample& sample : VisibleSpectrum(90)) {
      mean_px += sample.weights * color.HeightPx(sample.wavelength_nm, height_px);
    }
    for (int channel = 0; channel < 3; ++channel) {
      const auto& c = polynomials[static_cast<size_t>(channel)];
      EXPECT_NEAR(height_px + c[0] * height_px + c[1] * height_px * height_px * height_px,
                  mean_px[channel],
                  0.005);
    }
    EXPECT_GT(mean_px[0], mean_px[1]);
    EXPECT_GT(mean_px[1], mean_px[2]);
  }
}

}  // namespace
}  // namespace pfseq
