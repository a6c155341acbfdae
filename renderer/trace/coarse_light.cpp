// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/coarse_light.h"

#include "renderer/core/bytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace pfseq {
namespace {

/// Paths for each side of a patch: errors of a patch average out over the many patches that a
/// point sees.
constexpr int kPathsPerPatch = 32;

/// Cells along the edges of one triangle at most.
constexpr int kMaxCells = 256;

/// One side of a patch in the serialised light.
struct StoredValue {
  /// Place in CoarseLight::values_.
  uint32_t value_idx = 0;
  std::array<float, 3> irradiance{};
};

/// 0 to 5: the axis that a normal is nearest to, and its sign.
int MainDirection(const Vec3f& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (normal[axis] < 0.0F ? 1 : 0);
}

}  // namespace

CoarseLight::CoarseLight(const SurfaceTable& surfaces, float cell_m, Estimate estimate)
    : surfaces_(surfaces),
      estimate_(std::move(estimate)),
      first_patch_(surfaces.NumTriangles()),
      num_cells_(surfaces.NumTriangles(), 1) {
  std::unordered_map<uint64_t, uint32_t> patches;
  patches.reserve(surfaces.NumTriangles() / 4);
  std::vector<float> areas(surfaces.NumTriangles());
  std::vector<uint32_t> cut_triangles;
  for (uint32_t triangle_idx = 0; triangle_idx < surfaces.NumTriangles(); ++triangle_idx) {
    const std::array<Vec3f, 3> corners = surfaces.CornersM(triangle_idx);
    const Vec3f edge1 = corners[1] - corners[0];
    const Vec3f edge2 = corners[2] - corners[0];
    const float longest = std::sqrt(
        std::max({edge1.squaredNorm(), edge2.squaredNorm(), (edge2 - edge1).squaredNorm()}));
    areas[triangle_idx] = 0.5F * edge1.cross(edge2).norm();
    if (longest > 2.0F * cell_m) {
      num_cells_[triangle_idx] = static_cast<uint16_t>(
          std::min(static_cast<float>(kMaxCells), std::ceil(longest / cell_m)));
      cut_triangles.push_back(triangle_idx);
      continue;
    }
    const Vec3f centroid = (corners[0] + corners[1] + corners[2]) / (3.0F * cell_m);
    const uint64_t key =
        HashKey({static_cast<uint64_t>(std::llround(std::floor(centroid.x()))),
                 static_cast<uint64_t>(std::llround(std::floor(centroid.y()))),
                 static_cast<uint64_t>(std::llround(std::floor(centroid.z()))),
                 static_cast<uint64_t>(MainDirection(surfaces.Normal(triangle_idx)))});
    first_patch_[triangle_idx] =
        patches.try_emplace(key, static_cast<uint32_t>(patches.size())).first->second;
  }

  // The shared patches' triangles, grouped by counting.
  part_start_.assign(patches.size() + 1, 0);
  const auto is_shared = [&](uint32_t triangle_idx) { return num_cells_[triangle_idx] == 1; };
  for (uint32_t i = 0; i < surfaces.NumTriangles(); ++i) {
    part_start_[is_shared(i) ? first_patch_[i] + 1 : 0] += is_shared(i) ? 1U : 0U;
  }
  std::partial_sum(part_start_.begin(), part_start_.end(), part_start_.begin());
  part_triangles_.resize(part_start_.back());
  part_area_sums_.resize(part_start_.back());
  std::vector<uint32_t> next(part_start_.begin(), part_start_.end() - 1);
  for (uint32_t i = 0; i < surfaces.NumTriangles(); ++i) {
    if (is_shared(i)) {
      part_triangles_[next[first_patch_[i]]++] = i;
    }
  }
  for (size_t patch = 0; patch + 1 < part_start_.size(); ++patch) {
    float sum = 0.0F;
    for (uint32_t k = part_start_[patch]; k < part_start_[patch + 1]; ++k) {
      sum += areas[part_triangles_[k]];
      part_area_sums_[k] = sum;
    }
  }

  num_patches_ = patches.size();
  for (const uint32_t triangle_idx : cut_triangles) {
    first_patch_[triangle_idx] = static_cast<uint32_t>(num_patches_);
    const size_t num_cells = size_t{num_cells_[triangle_idx]} * num_cells_[triangle_idx];
    cell_triangles_.insert(cell_triangles_.end(), num_cells, triangle_idx);
    num_patches_ += num_cells;
  }
  values_ = std::make_unique<Value[]>(2 * num_patches_);
}

uint32_t CoarseLight::PatchOf(uint32_t triangle_idx, float u, float v) const {
  const int n = num_cells_[triangle_idx];
  if (n == 1) {
    return first_patch_[triangle_idx];
  }
  const int cell_u = std::clamp(static_cast<int>(u * static_cast<float>(n)), 0, n - 1);
  const int cell_v = std::clamp(static_cast<int>(v * static_cast<float>(n)), 0, n - 1);
  return first_patch_[triangle_idx] + static_cast<uint32_t>(cell_v * n + cell_u);
}

Rgb CoarseLight::Irradiance(uint32_t triangle_idx, float u, float v, bool is_front) const {
  const uint32_t patch_idx = PatchOf(triangle_idx, u, v);
  Value& value = values_[2 * size_t{patch_idx} + (is_front ? 0 : 1)];
  if (value.is_ready.load(std::memory_order_acquire)) {
    return {value.red.load(std::memory_order_relaxed),
            value.green.load(std::memory_order_relaxed),
            value.blue.load(std::memory_order_relaxed)};
  }
  // Two threads may do this at once: both find the same.
  const Rgb irradiance = Compute(patch_idx, is_front);
  Publish(irradiance, value);
  return irradiance;
}

void CoarseLight::Publish(const Rgb& irradiance, Value& value) {
  value.red.store(irradiance[0], std::memory_order_relaxed);
  value.green.store(irradiance[1], std::memory_order_relaxed);
  value.blue.store(irradiance[2], std::memory_order_relaxed);
  value.is_ready.store(true, std::memory_order_release);
}

Rgb CoarseLight::Compute(uint32_t patch_idx, bool is_front) const {
  RandomStream random({0x636f61727365ULL, patch_idx, is_front ? 0ULL : 1ULL});
  // Of all paths, and of those that do not start within a body.
  Rgb sum = Rgb::Zero();
  Rgb sum_outside = Rgb::Zero();
  int num_outside = 0;
  const auto num_shared = static_cast<uint32_t>(part_start_.size() - 1);
  for (int i = 0; i < kPathsPerPatch; ++i) {
    Part part{};
    if (patch_idx < num_shared) {
      const auto begin = part_area_sums_.begin() + part_start_[patch_idx];
      const auto end = part_area_sums_.begin() + part_start_[patch_idx + 1];
      const auto area = static_cast<float>((i + random.Uniform()) / kPathsPerPatch) * *(end - 1);
      const auto found = std::min(std::upper_bound(begin, end, area), end - 1);
      part.triangle_idx = part_triangles_[static_cast<size_t>(found - part_area_sums_.begin())];
    } else {
      part.triangle_idx = cell_triangles_[patch_idx - num_shared];
      const uint32_t cell = patch_idx - first_patch_[part.triangle_idx];
      part.cell_u = static_cast<uint16_t>(cell % num_cells_[part.triangle_idx]);
      part.cell_v = static_cast<uint16_t>(cell / num_cells_[part.triangle_idx]);
    }
    const PointEstimate estimate = EstimateAt(part, is_front, random);
    sum += estimate.irradiance;
    if (!estimate.is_from_behind) {
      sum_outside += estimate.irradiance;
      ++num_outside;
    }
  }
  return 2 * num_outside >= kPathsPerPatch ? sum_outside / static_cast<float>(num_outside)
                                           : sum / static_cast<float>(kPathsPerPatch);
}

CoarseLight::PointEstimate CoarseLight::EstimateAt(const Part& part,
                                                   bool is_front,
                                                   RandomStream& random) const {
  const auto n = static_cast<float>(num_cells_[part.triangle_idx]);
  float u = (static_cast<float>(part.cell_u) + static_cast<float>(random.Uniform())) / n;
  float v = (static_cast<float>(part.cell_v) + static_cast<float>(random.Uniform())) / n;
  if (u + v > 1.0F) {
    // Of a cell across the long edge, the half inside; of a whole triangle, the mirrored half.
    const float mirrored_u = static_cast<float>(part.cell_u + part.cell_v + 1) / n - v;
    const float mirrored_v = static_cast<float>(part.cell_u + part.cell_v + 1) / n - u;
    u = mirrored_u;
    v = mirrored_v;
  }
  const std::array<Vec3f, 3> corners = surfaces_.CornersM(part.triangle_idx);
  ShadingPoint point;
  point.position_m = (1.0F - u - v) * corners[0] + u * corners[1] + v * corners[2];
  const Vec3f normal = surfaces_.Normal(part.triangle_idx);
  point.geometric_normal = is_front ? normal : Vec3f(-normal);
  return estimate_(point.RayOriginM(), point.geometric_normal, random);
}

std::string CoarseLight::Serialize() const {
  std::string values;
  uint64_t num_ready = 0;
  for (uint32_t i = 0; i < 2 * num_patches_; ++i) {
    const Value& value = values_[i];
    if (value.is_ready.load(std::memory_order_acquire)) {
      AppendBytes(StoredValue{i,
                              {value.red.load(std::memory_order_relaxed),
                               value.green.load(std::memory_order_relaxed),
                               value.blue.load(std::memory_order_relaxed)}},
                  values);
      ++num_ready;
    }
  }
  std::string bytes;
  AppendBytes(uint64_t{2 * num_patches_}, bytes);
  AppendBytes(num_ready, bytes);
  return bytes + values;
}

bool CoarseLight::Load(std::string_view& bytes) {
  ByteReader reader(bytes);
  uint64_t num_values = 0;
  uint64_t num_ready = 0;
  if (!reader.Take(num_values) || num_values != 2 * num_patches_ || !reader.Take(num_ready) ||
      num_ready > num_values) {
    return false;
  }
  std::vector<StoredValue> stored(num_ready);
  for (StoredValue& value : stored) {
    if (!reader.Take(value) || value.value_idx >= num_values) {
      return false;
    }
  }
  for (const StoredValue& value : stored) {
    const auto& [red, green, blue] = value.irradiance;
    Publish({red, green, blue}, values_[value.value_idx]);
  }
  bytes = reader.Rest();
  return true;
}

int64_t CoarseLight::MemoryBytes() const {
  return static_cast<int64_t>(first_patch_.size() * (sizeof(uint32_t) + sizeof(uint16_t)) +
                              part_triangles_.size() * (sizeof(uint32_t) + sizeof(float)) +
                              cell_triangles_.size() * sizeof(uint32_t) +
                              2 * num_patches_ * sizeof(Value));
}

}  // namespace pfseq
