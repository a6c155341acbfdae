// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace pfseq {

/// Positions of the vertices of two triangles, in their order, that are not on the edge which they
/// share, if together they are a parallelogram whose sides go round the same way.
std::optional<std::array<uint8_t, 2>> ParallelogramApexes(const Mesh& mesh,
                                                          const std::array<uint32_t, 3>& first,
                                                          const std::array<uint32_t, 3>& second);

/// Where the records of a face lie, a triangle or a parallelogram of two: rows from the vertex
/// opposite the shortest edge to that edge, each row with as many cells as it is long; those of a
/// parallelogram are of the same length.
class RecordGrid {
 public:
  /// The distance of the records for a face of this middle and size.
  using SpacingM = std::function<float(const Vec3f& middle_m, float size_m)>;

  /// One record for the whole of any face.
  RecordGrid() = default;
  /// `apexes` are those of the parallelogram that the triangle is the first half of, if it is.
  RecordGrid(const std::array<Vec3f, 3>& corners_m,
             const std::optional<std::array<uint8_t, 2>>& apexes,
             const SpacingM& spacing_at);

  uint32_t NumRecords() const { return num_records_; }

  /// The records around a point and their weights, which add up to 1; none is 0.
  struct Stencil {
    std::array<uint32_t, 4> records{};
    std::array<float, 4> weights{};
    int count = 0;
  };
  /// `u` and `v` are the barycentric weights of the second and third vertex of the triangle, which
  /// is the first or the second of the face.
  Stencil StencilAt(bool is_second, float u, float v) const;

  /// A record's place, moved by `offset_cells` along the rows and across them: a little off the
  /// face's edges, so that it does not sit in a corner where rounding decides what it sees. Where
  /// one record stands for the whole way, the way is one cell, with the record in its middle.
  Vec3f PositionM(const std::array<Vec3f, 3>& corners_m,
                  uint32_t record_idx,
                  float inset_m,
                  const Vec2f& offset_cells = Vec2f::Zero()) const;

  int64_t MemoryBytes() const {
    return static_cast<int64_t>(sizeof(*this) + (size_t{num_rows_} + 2) * sizeof(uint32_t));
  }

 private:
  /// A place on the face: share of the way along the rows, and across them.
  struct FacePoint {
    float along;
    float across;
  };
  FacePoint FacePointAt(bool is_second, float u, float v) const;
  /// Where a share of the way lies among the records of a row, or among the rows, 0 to num_cells.
  float GridPosition(float share, uint32_t num_cells) const;

  bool is_quad_ = false;
  /// The vertex that the rows start from; of a parallelogram, the first triangle's vertex that is
  /// not on the diagonal, and the second's.
  uint8_t apex_ = 0;
  uint8_t second_apex_ = 0;
  /// Of a parallelogram: whether its rows follow each other along the edge from the apex to the
  /// last vertex of the first triangle, not to the next.
  bool is_turned_ = false;
  /// 0: one record stands for the whole face.
  uint16_t num_rows_ = 0;
  uint32_t num_records_ = 1;
  /// First record of each row, and the end.
  std::unique_ptr<uint32_t[]> row_start_;
};

}  // namespace pfseq
