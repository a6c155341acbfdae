// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/texture_noise.h"

#include "renderer/core/random.h"

#include <cmath>

namespace pfseq {
namespace {

int Wrap(int index, int count) {
  const int rest = index % count;
  return rest < 0 ? rest + count : rest;
}

double LatticeValue(uint64_t seed, int cells, int x, int y) {
  const auto column = static_cast<uint64_t>(Wrap(x, cells));
  const auto row = static_cast<uint64_t>(Wrap(y, cells));
  return UniformFromHash(MixBits(MixBits(seed + (column << 32)) + row));
}

double Smooth(double t) { return t * t * (3.0 - 2.0 * t); }

}  // namespace

double TileNoise(uint64_t seed, int cells, double x, double y) {
  const double column = x * cells;
  const double row = y * cells;
  const int left = static_cast<int>(std::floor(column));
  const int top = static_cast<int>(std::floor(row));
  const double a = Smooth(column - left);
  const double b = Smooth(row - top);
  const double upper = (1.0 - a) * LatticeValue(seed, cells, left, top) +
                       a * LatticeValue(seed, cells, left + 1, top);
  const double lower = (1.0 - a) * LatticeValue(seed, cells, left, top + 1) +
                       a * LatticeValue(seed, cells, left + 1, top + 1);
  return (1.0 - b) * upper + b * lower;
}

double TileFractal(uint64_t seed, int cells, int octaves, double x, double y) {
  double sum = 0.0;
  double weight = 0.5;
  double total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * TileNoise(seed + static_cast<uint64_t>(i), cells << i, x, y);
    total += weight;
    weight *= 0.5;
  }
  return sum / total;
}

}  // namespace pfseq
