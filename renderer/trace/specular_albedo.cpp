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

struct LobeIntegrals {
  Scales albedo;
  Scales forward;
};

/// Means of F G2 / G1 over visible normals, split into the parts of f0 and f90.
LobeIntegrals Integrate(double cosine, const Ggx& ggx) {
  // The limit at exactly grazing view is taken a little before it.
  const double z = std::max(cosine, 1e-4);
  const Vec3d to_viewer(std::sqrt(1.0 - z * z), 0.0, z);
  const double viewer_lambda = ggx.Lambda(to_viewer);
  LobeIntegrals sum;
  for (int i = 0; i < kNumLatticePoints; ++i) {
    const Vec2d sample(i + 0.5, i * kLatticeGenerator % kNumLatticePoints + 0.5);
    const Vec3d half = ggx.SampleVisibleNormal(to_viewer, sample / kNumLatticePoints);
    const double viewer_half = to_viewer.dot(half);
    const Vec3d to_light = 2.0 * viewer_half * half - to_viewer;
    if (to_light.z() <= 0.0) {
      continue;
    }
    const double shadowing =
        (1.0 + viewer_lambda) / (1.0 + viewer_lambda + ggx.Lambda(to_light)) / kNumLatticePoints;
    const double weight = SchlickWeight(viewer_half);
    sum.albedo.f0_scale += shadowing * (1.0 - weight);
    sum.albedo.f90_scale += shadowing * weight;
    sum.forward.f0_scale -= shadowing * (1.0 - weight) * to_light.x();
    sum.forward.f90_scale -= shadowing * weight * to_light.x();
  }
  return sum;
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

/// The same for eight values.
struct Cell8 {
  Cell8(Float8 value, int num_nodes) {
    const auto num_cells = static_cast<float>(num_nodes - 1);
    const Float8 position = Max(Min(value, 1.0F), 0.0F) * num_cells;
    index = _mm256_cvttps_epi32(Min(position, num_cells - 1.0F).Register());
    weight = position - Float8(_mm256_cvtepi32_ps(index));
  }
  __m256i index;
  Float8 weight;
};

std::vector<float> InTurn(const std::vector<Scales>& entries) {
  std::vector<float> values;
  for (const Scales& entry : entries) {
    values.push_back(static_cast<float>(entry.f0_scale));
    values.push_back(static_cast<float>(entry.f90_scale));
  }
  return values;
}

SpecularAlbedo::Scales8 Entries(const float* values, __m256i index) {
  constexpr int kBytesAnEntry = 2 * sizeof(float);
  return {Float8(_mm256_i32gather_ps(values, index, kBytesAnEntry)),
          Float8(_mm256_i32gather_ps(values + 1, index, kBytesAnEntry))};
}

SpecularAlbedo::Scales8 Mix(const SpecularAlbedo::Scales8& first,
                            const SpecularAlbedo::Scales8& second,
                            Float8 second_weight) {
  return {first.f0_scale + (second.f0_scale - first.f0_scale) * second_weight,
          first.f90_scale + (second.f90_scale - first.f90_scale) * second_weight};
}

/// Of a table of directions for each roughness in turn.
SpecularAlbedo::Scales8 Interpolated(const float* values, Float8 cosine, Float8 roughness) {
  const Cell8 c(cosine, kNumCosines);
  const Cell8 r(roughness, kNumRoughnesses);
  const __m256i index =
      _mm256_add_epi32(_mm256_mullo_epi32(r.index, _mm256_set1_epi32(kNumCosines)), c.index);
  const float* next_row = values + ptrdiff_t{2} * kNumCosines;
  return Mix(Mix(Entries(values, index), Entries(values + 2, index), c.weight),
             Mix(Entries(next_row, index), Entries(next_row + 2, index), c.weight),
             r.weight);
}

}  // namespace

SpecularAlbedo::SpecularAlbedo()
    : directional_(kNumCosines * kNumRoughnesses), mean_(kNumRoughnesses) {
  std::vector<Scales> forward(directional_.size());
  for (int r = 0; r < kNumRoughnesses; ++r) {
    const double roughness = static_cast<double>(r) / (kNumRoughnesses - 1);
    const Ggx ggx(roughness * roughness);
    for (int c = 0; c < kNumCosines; ++c) {
      const LobeIntegrals integrals = Integrate(static_cast<double>(c) / (kNumCosines - 1), ggx);
      directional_[static_cast<size_t>(r * kNumCosines + c)] = integrals.albedo;
      forward[static_cast<size_t>(r * kNumCosines + c)] = integrals.forward;
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
  directional_f_ = InTurn(directional_);
  forward_f_ = InTurn(forward);
  mean_f_ = InTurn(mean_);
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

SpecularAlbedo::Scales8 SpecularAlbedo::Directional(Float8 cosine, Float8 roughness) const {
  return Interpolated(directional_f_.data(), cosine, roughness);
}

SpecularAlbedo::Scales8 SpecularAlbedo::Forward(Float8 cosine, Float8 roughness) const {
  return Interpolated(forward_f_.data(), cosine, roughness);
}

SpecularAlbedo::Scales8 SpecularAlbedo::Mean(Float8 roughness) const {
  const Cell8 r(roughness, kNumRoughnesses);
  return Mix(Entries(mean_f_.data(), r.index), Entries(mean_f_.data() + 2, r.index), r.weight);
}

}  // namespace pfseq
