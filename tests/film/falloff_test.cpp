// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/falloff.h"

#include "tests/film/small_lens.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(Falloff, PictureOfAnEvenLightShowsTheVignettingCurve) {
  OpticsSpec spec;
  spec.vignetting = {.natural = 0.4, .mechanical = 0.5, .mechanical_start = 0.6};
  const Lens lens = SmallLens();
  Image<float> picture(kSmallSizePx, kSmallSizePx, 3, 2.0F);
  Falloff(spec, lens).Apply(picture, 2);
  for (const int x : {150, 178, 206, 234, 262, 283}) {
    const double rho = std::hypot(x - 149.5, 0.5) / kSmallCircleRadiusPx;
    const double t = std::clamp((rho - 0.6) / 0.4, 0.0, 1.0);
    const double expected = (1.0 - 0.4 * rho * rho) * (1.0 - 0.5 * t * t * (3.0 - 2.0 * t));
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(picture.At(x, 150, channel) / 2.0, expected, 0.001) << x;
    }
  }
}

TEST(Falloff, RimIsSharpInsideAndBlueAtItsEnd) {
  OpticsSpec spec;
  spec.rim = {.width_px = 20.0, .reach = {0.4, 0.6, 1.0}};
  const Falloff falloff(spec, SmallLens());
  EXPECT_TRUE((falloff.At(119.9) == 1.0F).all());
  // Half of each colour in the middle of its own way.
  EXPECT_NEAR(falloff.At(124.0)[0], 0.5F, 1e-6F);
  EXPECT_NEAR(falloff.At(126.0)[1], 0.5F, 1e-6F);
  EXPECT_NEAR(falloff.At(130.0)[2], 0.5F, 1e-6F);
  EXPECT_EQ(falloff.At(132.1)[1], 0.0F);
  EXPECT_GT(falloff.At(135.0)[2], 0.1F);
  EXPECT_TRUE((falloff.At(140.1) == 0.0F).all());
}

TEST(Falloff, WithoutEffectsIsOne) {
  const Falloff falloff({}, SmallLens());
  EXPECT_TRUE((falloff.At(0.0) == 1.0F).all());
  EXPECT_TRUE((falloff.At(139.0) == 1.0F).all());
}

}  // namespace
}  // namespace pfseq
