// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/recording.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kSizePx = 128;

SensorSpec LinearSensor() {
  SensorSpec spec;
  spec.exposure = 0.5;
  spec.tone_curve = "clip";
  spec.encoding = "linear";
  spec.bits = 16;
  return spec;
}

/// Mean and variance of a channel, in units of the exposed value.
std::pair<double, double> MeanAndVariance(const Image<uint16_t>& codes, int channel) {
  double sum = 0.0;
  double squares = 0.0;
  for (int y = 0; y < codes.HeightPx(); ++y) {
    for (int x = 0; x < codes.WidthPx(); ++x) {
      const double value = codes.At(x, y, channel) / 65535.0;
      sum += value;
      squares += value * value;
    }
  }
  const auto count = static_cast<double>(codes.NumPixels());
  return {sum / count, squares / count - sum * sum / (count * count)};
}

TEST(Recording, WithoutNoiseEncodesAsTheSensorDoes) {
  SensorSpec spec;
  spec.exposure = 0.3;
  Image<float> ramp(64, 1, 3);
  for (int x = 0; x < 64; ++x) {
    for (int channel = 0; channel < 3; ++channel) {
      ramp.At(x, 0, channel) = 0.1F * static_cast<float>(x) + 0.05F * static_cast<float>(channel);
    }
  }
  const Image<uint16_t> codes = Recording(spec).Record(ramp, 1, 1);
  const Image<uint8_t> clean = Sensor(spec).Encode(ramp);
  for (size_t i = 0; i < clean.Values().size(); ++i) {
    ASSERT_EQ(codes.Values()[i], clean.Values()[i]);
  }
}

TEST(Recording, NoiseLiesOnThePhotonTransferLine) {
  SensorSpec spec = LinearSensor();
  spec.white_electrons = 2000.0;
  spec.read_noise_electrons = 6.0;
  // From few electrons (Poisson by inversion) to many (normal).
  for (const double exposed : {0.02, 0.03, 0.1, 0.5, 0.8}) {
    const Image<float> even(kSizePx, kSizePx, 3, static_cast<float>(exposed / 0.5));
    const auto [mean, variance] = MeanAndVariance(Recording(spec).Record(even, 7, 2), 1);
    const double expected = exposed / 2000.0 + 9e-6;
    EXPECT_NEAR(mean, exposed, 4.0 * std::sqrt(expected) / kSizePx);
    // The variance of 16384 numbers scatters by 1.1 %.
    EXPECT_NEAR(variance / expected, 1.0, 0.045) << exposed;
  }
}

TEST(Recording, NoiseDependsOnKeyAndPlaceAlone) {
  SensorSpec spec = LinearSensor();
  spec.white_electrons = 500.0;
  const Image<float> even(32, 32, 3, 1.0F);
  const Recording recording(spec);
  const Image<uint16_t> first = recording.Record(even, 7, 1);
  EXPECT_EQ(recording.Record(even, 7, 3), first);
  EXPECT_NE(recording.Record(even, 8, 1), first);
  EXPECT_NE(first.At(3, 4, 0), first.At(4, 3, 0));
  EXPECT_NE(first.At(3, 4, 0), first.At(3, 5, 0));
  EXPECT_NE(first.At(3, 4, 0), first.At(3, 4, 1));
}

TEST(Recording, MosaicKeepsEvenColorsAndMeasuredPixels) {
  SensorSpec spec = LinearSensor();
  const auto record = [&](const std::string& mosaic, const Image<float>& light) {
    spec.mosaic = mosaic;
    return Recording(spec).Record(light, 0, 2);
  };
  Image<float> even(16, 16, 3);
  Image<float> ramp(16, 16, 3);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        even.At(x, y, channel) = 0.3F + 0.4F * static_cast<float>(channel);
        ramp.At(x, y, channel) = 0.1F * static_cast<float>(x) + 0.05F * static_cast<float>(channel);
      }
    }
  }
  for (const char* mosaic : {"rggb", "grbg", "gbrg", "bggr"}) {
    EXPECT_EQ(record(mosaic, even), record("none", even)) << mosaic;
    // Linear interpolation gives a linear ramp back, but at the edges.
    const Image<uint16_t> seen = record(mosaic, ramp);
    const Image<uint16_t> exact = record("none", ramp);
    for (int channel = 0; channel < 3; ++channel) {
      for (int x = 1; x < 15; ++x) {
        EXPECT_NEAR(seen.At(x, 7, channel), exact.At(x, 7, channel), 1.0) << mosaic;
      }
    }
  }
  // A single lit photosite: only its own colour is seen.
  Image<float> dot(16, 16, 3);
  for (int channel = 0; channel < 3; ++channel) {
    dot.At(6, 6, channel) = 1.0F;
  }
  const Image<uint16_t> red = record("rggb", dot);
  EXPECT_EQ(red.At(6, 6, 0), 32768);
  EXPECT_EQ(red.At(6, 6, 1), 0);
  EXPECT_EQ(red.At(7, 6, 0), 16384);
  EXPECT_EQ(record("bggr", dot).At(6, 6, 2), 32768);
  // Of grbg the second pixel of a row is red.
  dot.At(6, 6, 0) = 0.0F;
  dot.At(7, 6, 0) = 1.0F;
  EXPECT_EQ(record("grbg", dot).At(7, 6, 0), 32768);
  EXPECT_EQ(record("gbrg", dot).At(7, 6, 0), 0);
}

TEST(Recording, GreyIsTheLuminanceInOneChannel) {
  SensorSpec spec = LinearSensor();
  spec.color = "grey";
  Image<float> green(4, 4, 3);
  green.At(1, 1, 1) = 1.0F;
  const Image<uint16_t> codes = Recording(spec).Record(green, 0, 1);
  ASSERT_EQ(codes.NumChannels(), 1);
  EXPECT_NEAR(codes.At(1, 1), 0.5 * 0.7152 * 65535.0, 10.0);
}

TEST(Recording, HasAsManyCodesAsItsBits) {
  SensorSpec spec = LinearSensor();
  const Image<float> bright(2, 2, 3, 100.0F);
  EXPECT_EQ(Recording(spec).Record(bright, 0, 1).At(0, 0), 65535);
  spec.bits = 8;
  EXPECT_EQ(Recording(spec).Record(bright, 0, 1).At(0, 0), 255);
}

}  // namespace
}  // namespace pfseq
