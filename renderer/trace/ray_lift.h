// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pfseq {

/// Rays that leave a surface start this far off its triangle, plus this share of the largest
/// coordinate: about 0.1 mm at the world's origin and 1 mm a kilometre away, well above the
/// rounding of positions to float.
inline constexpr double kLeastLiftM = 1e-4;
inline constexpr double kRelativeLift = 1e-6;

}  // namespace pfseq
