// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/sensor.h"

#include "renderer/core/check.h"
#include "renderer/core/error.h"
#include "renderer/trace/color.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

/// Where the shoulder starts.
constexpr float kKnee = 0.6F;

}  // namespace

Sensor::Sensor(const SensorSpec& spec)
    : exposure_(static_cast<float>(spec.exposure.value_or(0.0))),
      has_shoulder_(spec.tone_curve == "shoulder") {
  if (!has_shoulder_ && spec.tone_curve != "clip") {
    throw InputError("sensor.tone_curve: expected clip or shoulder, got '{}'", spec.tone_curve);
  }
  PFSEQ_CHECK(spec.exposure.has_value(), "the exposure must have been settled");
  if (!(*spec.exposure > 0.0)) {
    throw InputError("sensor.exposure: expected > 0, got {}", *spec.exposure);
  }
}

float Sensor::ToneMap(float exposed) const {
  if (has_shoulder_ && exposed > kKnee) {
    return 1.0F - (1.0F - kKnee) * std::exp(-(exposed - kKnee) / (1.0F - kKnee));
  }
  return std::min(exposed, 1.0F);
}

uint8_t Sensor::EncodeChannel(float radiance) const {
  if (!(radiance > 0.0F)) {
    return 0;
  }
  return static_cast<uint8_t>(std::lround(255.0F * SrgbFromLinear(ToneMap(radiance * exposure_))));
}

std::array<uint8_t, 3> Sensor::Encode(const Rgb& radiance) const {
  return {EncodeChannel(radiance[0]), EncodeChannel(radiance[1]), EncodeChannel(radiance[2])};
}

Image<uint8_t> Sensor::Encode(const Image<float>& radiance) const {
  PFSEQ_CHECK(radiance.NumChannels() == 3, "{} channels", radiance.NumChannels());
  Image<uint8_t> encoded(radiance.WidthPx(), radiance.HeightPx(), 3);
  std::transform(radiance.Values().begin(),
                 radiance.Values().end(),
                 encoded.Values().begin(),
                 [this](float value) { return EncodeChannel(value); });
  return encoded;
}

}  // namespace pfseq
