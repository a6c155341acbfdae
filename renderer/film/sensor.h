// SPDX-License-Identifier: Apache-2.0
// From linear radiance to 8-bit pixels: exposure, tone curve, sRGB encoding, rounding.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"
#include "renderer/sequence/sequence_spec.h"

#include <array>
#include <cstdint>

namespace pfseq {

class Sensor {
 public:
  /// The exposure must be a number (AutoExposure has settled it). InputError when the tone curve's
  /// name is unknown or the exposure is not positive.
  explicit Sensor(const SensorSpec& spec);

  /// Multiplies radiance.
  float Exposure() const { return exposure_; }

  /// The tone curve, from exposed linear values to [0, 1]. clip: min(x, 1). shoulder: x up to the
  /// knee k = 0.6, above it 1 - (1 - k) exp(-(x - k) / (1 - k)), which goes on with the same slope
  /// and reaches 1 at infinity.
  float ToneMap(float exposed) const;

  /// What is not a number counts as black.
  std::array<uint8_t, 3> Encode(const Rgb& radiance) const;

  /// An image of three channels, each pixel encoded.
  Image<uint8_t> Encode(const Image<float>& radiance) const;

 private:
  uint8_t EncodeChannel(float radiance) const;

  float exposure_;
  bool has_shoulder_;
};

}  // namespace pfseq
