// SPDX-License-Identifier: Apache-2.0
// Inside the program angles are radians; degrees appear in files and on the command line alone.
#pragma once

#include <numbers>

namespace pfseq {

constexpr double RadFromDeg(double angle_deg) { return angle_deg * (std::numbers::pi / 180.0); }
constexpr double DegFromRad(double angle_rad) { return angle_rad * (180.0 / std::numbers::pi); }

}  // namespace pfseq
