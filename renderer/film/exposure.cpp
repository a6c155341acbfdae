// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/exposure.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

constexpr double kDefaultExposure = 0.06;
constexpr double kDefaultIlluminanceKlx = 79.0;

double RoundedToThreeDigits(double value) {
  const double scale = std::pow(10.0, 2.0 - std::floor(std::log10(value)));
  return std::round(value * scale) / scale;
}

}  // namespace

double AutoExposure(const Lighting& lighting) {
  double illuminance_klx = Luminance(lighting.sky.HorizontalIrradiance());
  if (lighting.sun.has_value()) {
    illuminance_klx +=
        Luminance(lighting.sun->Irradiance()) * std::max(0.0, lighting.sun->DirectionToSun().z());
  }
  if (!(illuminance_klx > 0.0)) {
    return kDefaultExposure;
  }
  return RoundedToThreeDigits(kDefaultExposure *
                              std::sqrt(kDefaultIlluminanceKlx / illuminance_klx));
}

double ExposureForMean(double mean_kcd_m2) {
  constexpr double kMiddleGrey = 0.18;
  return mean_kcd_m2 > 0.0 ? RoundedToThreeDigits(kMiddleGrey / mean_kcd_m2) : kDefaultExposure;
}

}  // namespace pfseq
