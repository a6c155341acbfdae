// SPDX-License-Identifier: Apache-2.0
// The exposure that a light asks for.
#pragma once

#include "renderer/trace/lighting.h"

namespace pfseq {

/// What `sensor.exposure: auto` stands for with `sensor.metering: light`, the same for all frames of a sequence: 0.06 for the
/// default light, which gives 79 klx on horizontal ground in the open, otherwise 0.06
/// (79 klx / E)^0.5, E the illuminance that sun and sky give there; to three digits. The power is
/// 1/2 and not 1 because walls and the sky itself, which fill most of a picture, grow darker toward
/// the evening much more slowly than the ground. Without any light, 0.06.
double AutoExposure(const Lighting& lighting);

/// What makes a mean luminance (in kcd/m^2) 0.18, to three digits; 0.06 for black.
double ExposureForMean(double mean_kcd_m2);

}  // namespace pfseq
