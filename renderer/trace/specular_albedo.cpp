// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/specular_albedo.h"

#include "renderer/trace/microfacet.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

constexpr int kNumCosines = 64;
constexpr int kNumRoughnesses = 32;
/// Points of the Fibonacci lattice over which a table entry is integrated, and the generator.
constexpr int kNumLatticePoints = 610;
constexpr int kLatticeGenerator = 377;

using Scales = SpecularAlbedo::Scales;

/// Mean of F G2 / G1 over visible normals, split into the parts of f0 and f90.
Scales Integrate(double cosine, const Ggx& ggx) {
  // The limit at exactly grazing view is taken a little before it.
  const double z = std::max(cosine, 1e-4);
  const Vec3d to_viewer(std::sqrt(1.0 - z * z), 0.0, z);
  const double viewer_lambda = ggx.Lambda(to_viewer);
  Scales sum;
  for (int i = 0; i < kNumLatticePoints; ++i) {
    const Vec2d sample(i + 0.5, i * kLatticeGenerator % kNumLatticePoints + 0.5);
    const Vec3d half = ggx.SampleVisibleNormal(to_viewer, sample / kNumLatticePoints);
    const double viewer_half = to_viewer.dot(half);
    const Vec3d to_light = 2.0 * viewer_half * half - to_viewer;
    if (to_light.z() <= 0.0) {
      continue;
    }
    const double shadowing = (1.0 + viewer_lambda) / (1.0 + viewer_lambda + ggx.Lambda(to_light));
    const double weight = SchlickWeight(viewer_half);
    sum.f0_scale += shadowing * (1.0 - weight);
    sum.f90_scale += shadowing * weight;
  }
  return {sum.f0_scale / kNumLatticePoints, sum.f90_scale / kNumLatticePoints};
}

Scales Mix(const Scales& first, const Scales& second, double second_weight) {
  return {first.f0_scale + (second.f0_scale - first.f0_scale) * second_weight,
          first.f90_scale + (second.f90_scale - first.f90_scale) * second_weight};
}

/// Cell and position within it of a value in [0, 1] on `num_nodes` equidistant nodes.
struct Cell {
  Cell(double value, int num_nodes) {
    const double position = std::clamp(value, 0.0, 1.0) * (num_nodes - 1);
    index = std::min(static_cast<int>(position), num_nodes - 2);
    weight = position - index;
  }
  int index;
  double weight;
};

}  // namespace

SpecularAlbedo::SpecularAlbedo()
    : directional_(kNumCosines * kNumRoughnesses), mean_(kNumRoughnesses) {
  for (int r = 0; r < kNumRoughnesses; ++r) {
    const double roughness = static_cast<double>(r) / (kNumRoughnesses - 1);
    const Ggx ggx(roughness * roughness);
    for (int c = 0; c < kNumCosines; ++c) {
      directional_[static_cast<size_t>(r * kNumCosines + c)] =
          Integrate(static_cast<double>(c) / (kNumCosines - 1), ggx);
    }
    // 2 * integral of albedo * cosine over the cosine: exact for the piecewise linear table.
    constexpr double kStep = 1.0 / (kNumCosines - 1);
    for (int c = 0; c + 1 < kNumCosines; ++c) {
      const Scales& low = directional_[static_cast<size_t>(r * kNumCosines + c)];
      const Scales& high = directional_[static_cast<size_t>(r * kNumCosines + c + 1)];
      const double start = c * kStep;
      const double low_weight = 2.0 * kStep * (start / 2.0 + kStep / 6.0);
      const double high_weight = 2.0 * kStep * (start / 2.0 + kStep / 3.0);
      mean_[static_cast<size_t>(r)].f0_scale +=
          low_weight * low.f0_scale + high_weight * high.f0_scale;
      mean_[static_cast<size_t>(r)].f90_scale +=
          low_weight * low.f90_scale + high_weight * high.f90_scale;
    }
  }
}

const SpecularAlbedo& SpecularAlbedo::Table() {
  static const SpecularAlbedo table;
  return table;
}

Scales SpecularAlbedo::Directional(double cosine, double roughness) const {
  const Cell c(cosine, kNumCosines);
  const Cell r(roughness, kNumRoughnesses);
  const Scales* row = directional_.data() + r.index * kNumCosines + c.index;
  return Mix(Mix(row[0], row[1], c.weight),
             Mix(row[kNumCosines], row[kNumCosines + 1], c.weight),
             r.weight);
}

Scales SpecularAlbedo::Mean(double roughness) const {
  const Cell r(roughness, kNumRoughnesses);
  return Mix(
      mean_[static_cast<size_t>(r.index)], mean_[static_cast<size_t>(r.index) + 1], r.weight);
}

}  // namespace pfseq
