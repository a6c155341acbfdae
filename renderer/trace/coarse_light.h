// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/random.h"
#include "renderer/core/vector.h"
#include "renderer/trace/surface_table.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

/// Mean irradiance of patches of a scene's surfaces, each side for itself, estimated when first
/// asked for. A patch is the triangles that share a cell of a grid and a main direction of their
/// normals; large triangles are cut into patches. Parts of a patch that seem to lie within a
/// body, where faces run into each other, do not count if they are the lesser part. What a patch
/// holds depends on the scene and the patch alone, not on who asks first: any number of threads may
/// ask.
class CoarseLight {
 public:
  /// What a path finds out about a point.
  struct PointEstimate {
    Rgb irradiance;
    /// The first surface on the path was seen from behind: the point may lie within a body.
    bool is_from_behind = false;
  };
  using Estimate = std::function<PointEstimate(
      const Vec3f& position_m, const Vec3f& normal, RandomStream& random)>;

  CoarseLight(const SurfaceTable& surfaces, float cell_m, Estimate estimate);

  /// Without the sun's direct light.
  Rgb Irradiance(uint32_t triangle_idx, float u, float v, bool is_front) const;

  int64_t MemoryBytes() const;

  /// All that was estimated as bytes and back. Load takes them off the front; it gives false, and
  /// loads nothing, when they do not belong to patches of these triangles.
  std::string Serialize() const;
  bool Load(std::string_view& bytes);

 private:
  /// What one side of a patch gets; ready once state says so.
  struct Value {
    std::atomic<float> red{0.0F};
    std::atomic<float> green{0.0F};
    std::atomic<float> blue{0.0F};
    std::atomic<bool> is_ready{false};
  };
  /// A triangle, or, where it is cut into n x n barycentric cells, the cell.
  struct Part {
    uint32_t triangle_idx;
    uint16_t cell_u;
    uint16_t cell_v;
  };

  uint32_t PatchOf(uint32_t triangle_idx, float u, float v) const;
  Rgb Compute(uint32_t patch_idx, bool is_front) const;
  static void Publish(const Rgb& irradiance, Value& value);
  PointEstimate EstimateAt(const Part& part, bool is_front, RandomStream& random) const;

  const SurfaceTable& surfaces_;
  Estimate estimate_;
  /// First patch of each triangle and number of cells along its edges (1: it is part of a patch).
  std::vector<uint32_t> first_patch_;
  std::vector<uint16_t> num_cells_;
  /// Triangles of the shared patches and the running sum of their areas, patch by patch.
  std::vector<uint32_t> part_start_;
  std::vector<uint32_t> part_triangles_;
  std::vector<float> part_area_sums_;
  /// Triangle of each patch that is a cell of one, after the shared patches.
  std::vector<uint32_t> cell_triangles_;
  std::unique_ptr<Value[]> values_;
  size_t num_patches_ = 0;
};

}  // namespace pfseq
