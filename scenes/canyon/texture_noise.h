// SPDX-License-Identifier: Apache-2.0
// Value noise that repeats without a seam.
#pragma once

#include <cstdint>

namespace pfseq {

/// Smoothly interpolated random values on a lattice of `cells` x `cells` over the unit square,
/// periodic; in [0, 1).
double TileNoise(uint64_t seed, int cells, double x, double y);

/// Sum of `octaves` noises, each twice as fine and half as strong as the one before (fractal
/// Brownian motion), scaled to [0, 1).
double TileFractal(uint64_t seed, int cells, int octaves, double x, double y);

}  // namespace pfseq
