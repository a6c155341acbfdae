// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/sensor.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

Sensor MakeSensor(const std::string& tone_curve, double exposure = 1.0) {
  return Sensor({.exposure = exposure, .tone_curve = tone_curve});
}

uint8_t EncodeGray(const Sensor& sensor, float value) {
  return sensor.Encode(Rgb(Rgb::Constant(value)))[1];
}

TEST(Sensor, ClipIsLinearUpToWhite) {
  const Sensor sensor = MakeSensor("clip");
  EXPECT_EQ(sensor.ToneMap(0.3F), 0.3F);
  EXPECT_EQ(sensor.ToneMap(0.99F), 0.99F);
  EXPECT_EQ(sensor.ToneMap(7.0F), 1.0F);
}

TEST(Sensor, ShoulderIsLinearToTheKneeAndSmoothThere) {
  const Sensor sensor = MakeSensor("shoulder");
  EXPECT_EQ(sensor.ToneMap(0.3F), 0.3F);
  EXPECT_EQ(sensor.ToneMap(0.6F), 0.6F);
  constexpr float kStep = 1e-3F;
  EXPECT_NEAR((sensor.ToneMap(0.6F + kStep) - sensor.ToneMap(0.6F)) / kStep, 1.0F, 0.01F);
  // 1 - 0.4 exp(-1)
  EXPECT_NEAR(sensor.ToneMap(1.0F), 0.852848F, 1e-5F);
  EXPECT_LE(sensor.ToneMap(1e9F), 1.0F);
  float previous = 0.0F;
  for (float value = 0.01F; value < 3.0F; value += 0.01F) {
    EXPECT_GT(sensor.ToneMap(value), previous);
    previous = sensor.ToneMap(value);
  }
}

TEST(Sensor, EncodesMiddleGreyAsSrgbDoes) {
  const Sensor sensor = MakeSensor("shoulder");
  EXPECT_EQ(EncodeGray(sensor, 0.0F), 0);
  EXPECT_EQ(EncodeGray(sensor, 0.21408F), 128);
  EXPECT_EQ(EncodeGray(sensor, 0.21400F), 127);  // 0.21404 is 127.5 of 255
  EXPECT_EQ(EncodeGray(sensor, 0.18F), 118);
  EXPECT_EQ(EncodeGray(MakeSensor("clip"), 1.0F), 255);
}

TEST(Sensor, RoundsToTheNearestByte) {
  const Sensor sensor = MakeSensor("clip");
  // In the linear part of the encoding: byte = 255 * 12.92 * value.
  EXPECT_EQ(EncodeGray(sensor, 1.49F / (255.0F * 12.92F)), 1);
  EXPECT_EQ(EncodeGray(sensor, 1.51F / (255.0F * 12.92F)), 2);
}

TEST(Sensor, ExposureMultipliesRadiance) {
  EXPECT_EQ(EncodeGray(MakeSensor("clip", 0.04), 5.0F), EncodeGray(MakeSensor("clip"), 0.2F));
}

TEST(Sensor, KeepsChannelsApart) {
  const std::array<uint8_t, 3> encoded = MakeSensor("clip").Encode(Rgb(1.0F, 0.0F, 0.18F));
  EXPECT_EQ(encoded, (std::array<uint8_t, 3>{255, 0, 118}));
}

TEST(Sensor, EncodesAllThatIsNoOrdinaryNumber) {
  const Sensor sensor = MakeSensor("shoulder");
  EXPECT_EQ(EncodeGray(sensor, std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(EncodeGray(sensor, -1.0F), 0);
  EXPECT_EQ(EncodeGray(sensor, std::numeric_limits<float>::infinity()), 255);
}

TEST(Sensor, EncodesAnImagePixelByPixel) {
  Image<float> radiance(3, 2, 3);
  float value = 0.0F;
  for (float& channel : radiance.Values()) {
    channel = value += 0.05F;
  }
  const Sensor sensor = MakeSensor("shoulder", 1.3);
  const Image<uint8_t> encoded = sensor.Encode(radiance);
  ASSERT_EQ(encoded.WidthPx(), 3);
  ASSERT_EQ(encoded.HeightPx(), 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      const Rgb pixel(radiance.At(x, y, 0), radiance.At(x, y, 1), radiance.At(x, y, 2));
      const std::array<uint8_t, 3> expected = sensor.Encode(pixel);
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_EQ(encoded.At(x, y, channel), expected[static_cast<size_t>(channel)]);
      }
    }
  }
}

TEST(Sensor, RefusesUnknownCurvesAndExposures) {
  EXPECT_THAT(MessageOf<InputError>([] { MakeSensor("filmic"); }),
              HasSubstr("sensor.tone_curve: expected clip or shoulder, got 'filmic'"));
  EXPECT_THAT(MessageOf<InputError>([] { MakeSensor("clip", 0.0); }),
              HasSubstr("sensor.exposure: expected > 0, got 0"));
}

}  // namespace
}  // namespace pfseq
