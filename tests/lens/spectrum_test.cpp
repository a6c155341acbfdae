// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/spectrum.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(VisibleSpectrum, SamplesAreTheMiddlesOfEqualIntervals) {
  const std::vector<SpectralSample> samples = VisibleSpectrum(6);
  ASSERT_EQ(samples.size(), 6U);
  for (size_t i = 0; i < samples.size(); ++i) {
    EXPECT_DOUBLE_EQ(samples[i].wavelength_nm, 425.0 + 50.0 * static_cast<double>(i));
  }
}

TEST(VisibleSpectrum, KeepsWhiteWhite) {
  for (const int num_samples : {3, 12, 40}) {
    Vec3d sum = Vec3d::Zero();
    for (const SpectralSample& sample : VisibleSpectrum(num_samples)) {
      EXPECT_GE(sample.weights.minCoeff(), 0.0);
      sum += sample.weights;
    }
    EXPECT_LT((sum - Vec3d::Ones()).norm(), 1e-12);
  }
}

TEST(VisibleSpectrum, HasRedLongGreenInTheMiddleAndBlueShort) {
  Vec3d mean_nm = Vec3d::Zero();
  double violet_in_red = 0.0;
  for (const SpectralSample& sample : VisibleSpectrum(300)) {
    mean_nm += sample.wavelength_nm * sample.weights;
    violet_in_red += sample.wavelength_nm < 470.0 ? sample.weights[0] : 0.0;
  }
  // The dominant wavelengths of the primaries are 612, 549 and 464 nm; red has some violet.
  EXPECT_NEAR(mean_nm[1], 545.0, 10.0);
  EXPECT_NEAR(mean_nm[2], 455.0, 10.0);
  EXPECT_GT(mean_nm[0], 585.0);
  EXPECT_GT(violet_in_red, 0.01);
  EXPECT_LT(violet_in_red, 0.1);
}

TEST(VisibleSpectrum, FewerThanThreeSamplesAreAFailedCheck) {
  EXPECT_DEATH(VisibleSpectrum(2), "2 samples");
}

}  // namespace
}  // namespace pfseq
