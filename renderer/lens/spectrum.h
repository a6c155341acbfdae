// SPDX-License-Identifier: Apache-2.0
// The visible spectrum as a camera's three channels collect it.
#pragma once

#include "renderer/core/vector.h"

#include <vector>

namespace pfseq {

struct SpectralSample {
  double wavelength_nm = 0.0;
  /// Share of what red, green and blue collect of white light.
  Vec3d weights = Vec3d::Zero();
};

/// Samples at the middles of equal intervals from 400 to 700 nm. Over all of them each channel's
/// weights add up to 1, so white stays white. The weights are the CIE 1931 colour matching
/// functions (Wyman, Sloan, Shirley 2013, "Simple analytic approximations to the CIE XYZ color
/// matching functions", JCGT 2(2), table 1) in linear Rec. 709, without their negative parts, which
/// a camera's filters cannot have.
std::vector<SpectralSample> VisibleSpectrum(int num_samples);

}  // namespace pfseq
