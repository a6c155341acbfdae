// SPDX-License-Identifier: Apache-2.0
// From the light on the sensor to a realistic picture's numbers: exposure, noise, colour filters,
// tone curve, encoding and quantisation.
#pragma once

#include "renderer/core/image.h"
#include "renderer/film/sensor.h"
#include "renderer/sequence/camera_spec.h"

#include <cstdint>

namespace pfseq {

/// Each photosite collects a Poisson number of electrons with the mean x W, x the exposed value and
/// W white_electrons, and reading adds a normal number of the deviation S, read_noise_electrons. In
/// units of x the photon transfer line is
///   variance = x / W + (S / W)^2.
/// Above 64 electrons the Poisson number is a rounded normal one. Behind a mosaic of colour filters
/// each pixel keeps one channel, and the others are interpolated bilinearly between the neighbours
/// that have them. Then come tone curve, encoding and rounding, where negative values become 0.
class Recording {
 public:
  explicit Recording(const SensorSpec& spec);

  /// Codes of 3 channels (1 when grey), up to 255 or 65535, from radiance of 3 channels. The noise
  /// of a pixel depends on `key` and its place alone.
  Image<uint16_t> Record(const Image<float>& radiance, uint64_t key, int num_threads) const;

 private:
  float Photosite(float exposed, uint64_t key) const;
  void AddNoise(Image<float>& exposed, uint64_t key, int num_threads) const;
  Image<float> Demosaiced(const Image<float>& exposed, int num_threads) const;
  /// The channel of a pixel behind the mosaic.
  int ChannelAt(int x, int y) const;

  SensorSpec spec_;
  Sensor sensor_;
};

}  // namespace pfseq
