// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/spectrum.h"

#include <array>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Vec3d MeanNm(int num_samples) {
  Vec3d mean_nm = Vec3d::Zero();
  for (const SpectralSample& sample : VisibleSpectrum(num_samples)) {
    mean_nm += sample.wavelength_nm * sample.weights;
  }
  return mean_nm;
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

TEST(VisibleSpectrum, SamplesAreTheMiddlesOfEqualIntervals) {
  const std::vector<SpectralSample> three = VisibleSpectrum(3);
  ASSERT_EQ(three.size(), 3U);
  EXPECT_DOUBLE_EQ(three[0].wavelength_nm, 450.0);
  EXPECT_DOUBLE_EQ(three[1].wavelength_nm, 550.0);
  EXPECT_DOUBLE_EQ(three[2].wavelength_nm, 650.0);
  const std::vector<SpectralSample> many = VisibleSpectrum(60);
  ASSERT_EQ(many.size(), 60U);
  for (size_t i = 0; i < many.size(); ++i) {
    EXPECT_NEAR(many[i].wavelength_nm, 402.5 + 5.0 * static_cast<double>(i), 1e-9);
  }
}

TEST(VisibleSpectrum, HasRedLongGreenInTheMiddleAndBlueShort) {
  const Vec3d mean_nm = MeanNm(300);
  double violet_in_red = 0.0;
  for (const SpectralSample& sample : VisibleSpectrum(300)) {
    violet_in_red += sample.wavelength_nm < 470.0 ? sample.weights[0] : 0.0;
  }
  // The dominant wavelengths of the primaries are 612, 549 and 464 nm; red has some violet.
  EXPECT_NEAR(mean_nm[1], 545.0, 10.0);
  EXPECT_NEAR(mean_nm[2], 455.0, 10.0);
  EXPECT_GT(mean_nm[0], 585.0);
  EXPECT_GT(violet_in_red, 0.01);
  EXPECT_LT(violet_in_red, 0.1);
}

TEST(VisibleSpectrum, HasTheWeightsOfTheTabulatedObserver) {
  // The CIE 1931 standard observer from 410 nm in steps of 20 nm: the middles of 15 intervals.
  const std::array<Vec3d, 15> observer = {{{0.04351, 0.00121, 0.20740},
                                           {0.28390, 0.01160, 1.38560},
                                           {0.33620, 0.03800, 1.77211},
                                           {0.19536, 0.09098, 1.28764},
                                           {0.03201, 0.20802, 0.46518},
                                           {0.00930, 0.50300, 0.15820},
                                           {0.16550, 0.86200, 0.04216},
                                           {0.43345, 0.99495, 0.00875},
                                           {0.76210, 0.95200, 0.00210},
                                           {1.02630, 0.75700, 0.00110},
                                           {1.00260, 0.50300, 0.00034},
                                           {0.64240, 0.26500, 0.00005},
                                           {0.28350, 0.10700, 0.00000},
                                           {0.08740, 0.03200, 0.00000},
                                           {0.02270, 0.00821, 0.00000}}};
  // IEC 61966-2-1.
  Eigen::Matrix3d rgb_from_xyz;
  rgb_from_xyz << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& xyz : observer) {
    sum += (rgb_from_xyz * xyz).cwiseMax(0.0);
  }
  const std::vector<SpectralSample> samples = VisibleSpectrum(15);
  for (size_t i = 0; i < samples.size(); ++i) {
    const Vec3d expected = (rgb_from_xyz * observer[i]).cwiseMax(0.0).cwiseQuotient(sum);
    // The greatest weights are about 0.25.
    EXPECT_LT((samples[i].weights - expected).cwiseAbs().maxCoeff(), 0.012)
        << samples[i].wavelength_nm << " nm: " << samples[i].weights.transpose() << ", expected "
        << expected.transpose();
  }
}

TEST(VisibleSpectrum, MoreSamplesComeCloserToTheWholeSpectrum) {
  const Vec3d limit_nm = MeanNm(30000);
  const auto error_nm = [&](int num_samples) {
    return (MeanNm(num_samples) - limit_nm).cwiseAbs().maxCoeff();
  };
  EXPECT_GT(error_nm(3), 2.0);
  EXPECT_LT(error_nm(12), 1.0);
  EXPECT_LT(error_nm(100), 0.05);
  EXPECT_LT(error_nm(1000), 0.001);
}

TEST(VisibleSpectrum, NeedsASampleForEachChannel) { EXPECT_DEATH(VisibleSpectrum(2), "2 samples"); }

}  // namespace
}  // namespace pfseq
