// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/record_grid.h"

#include "renderer/trace/ray_lift.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

/// Rows of a grid at most; larger triangles have wider rows.
constexpr float kMaxRows = 8192.0F;

/// Records are never further off an edge than this share of the triangle's height.
constexpr float kMaxInsetShare = 0.2F;

/// Corners of a parallelogram may be off by this share of its longest side, and by so much off its
/// plane: records that lay behind the second triangle would see it from behind.
constexpr float kParallelogramTolerance = 1e-3F;
constexpr float kBendToleranceM = static_cast<float>(0.3 * kLeastLiftM);

/// The outermost records of a parallelogram are this far off its edges, in cells: in the corner of
/// a recess light falls off so fast that a record there would darken the whole cell.
constexpr float kRimInCells = 0.2F;

/// Faces no longer than this many spacings need one record.
constexpr float kSmallInSpacings = 0.5F;

/// Rows shorter than this many spacings need one record, for they are hardly a pixel wide. Longer
/// ones have two at least: a strip under a ledge may be bright at its foot and dark at its head.
constexpr float kThinInSpacings = 0.05F;

}  // namespace

std::optional<std::array<uint8_t, 2>> ParallelogramApexes(const Mesh& mesh,
                                                          const std::array<uint32_t, 3>& first,
                                                          const std::array<uint32_t, 3>& second) {
  const auto position = [&](const std::array<uint32_t, 3>& triangle, size_t i) -> const Vec3f& {
    return mesh.positions_m[triangle[i % 3]];
  };
  for (uint8_t a = 0; a < 3; ++a) {
    for (uint8_t b = 0; b < 3; ++b) {
      const Vec3f& apex = position(first, a);
      const Vec3f& next = position(first, a + 1U);
      const Vec3f& last = position(first, a + 2U);
      if (next != position(second, b + 2U) || last != position(second, b + 1U)) {
        continue;
      }
      const Vec3f off = position(second, b) - (next + last - apex);
      const float longest = std::max((next - apex).norm(), (last - apex).norm());
      const Vec3f normal = (next - apex).cross(last - apex).normalized();
      if (off.norm() <= kParallelogramTolerance * longest &&
          std::abs(off.dot(normal)) <= kBendToleranceM) {
        return std::array<uint8_t, 2>{a, b};
      }
    }
  }
  return std::nullopt;
}

RecordGrid::RecordGrid(const std::array<Vec3f, 3>& corners_m,
                       const std::optional<std::array<uint8_t, 2>>& apexes,
                       const SpacingM& spacing_at) {
  // Along: what the rows follow each other along; across: the longest row.
  float along_m = 0.0F;
  float across_m = 0.0F;
  Vec3f centre_m;
  if (apexes.has_value()) {
    is_quad_ = true;
    apex_ = (*apexes)[0];
    second_apex_ = (*apexes)[1];
    const Vec3f& next = corners_m[(apex_ + 1U) % 3];
    const Vec3f& last = corners_m[(apex_ + 2U) % 3];
    along_m = (next - corners_m[apex_]).norm();
    across_m = (last - corners_m[apex_]).norm();
    is_turned_ = across_m > along_m;
    if (is_turned_) {
      std::swap(along_m, across_m);
    }
    centre_m = 0.5F * (next + last);
  } else {
    // Lengths of the edges opposite to each corner.
    std::array<float, 3> opposite_m;
    for (size_t i = 0; i < 3; ++i) {
      opposite_m[i] = (corners_m[(i + 1) % 3] - corners_m[(i + 2) % 3]).norm();
    }
    apex_ = static_cast<uint8_t>(std::min_element(opposite_m.begin(), opposite_m.end()) -
                                 opposite_m.begin());
    along_m = *std::max_element(opposite_m.begin(), opposite_m.end());
    across_m = opposite_m[apex_];
    centre_m = (corners_m[0] + corners_m[1] + corners_m[2]) / 3.0F;
  }

  const float spacing_m = spacing_at(centre_m, along_m);
  if (along_m < kSmallInSpacings * spacing_m) {
    num_records_ = 1;
  } else {
    const float rows = std::clamp(std::ceil(along_m / spacing_m), 1.0F, kMaxRows);
    num_rows_ = static_cast<uint16_t>(rows);
    row_start_ = std::make_unique<uint32_t[]>(size_t{num_rows_} + 2);
    uint32_t count = 0;
    for (uint32_t row = 0; row <= num_rows_; ++row) {
      row_start_[row] = count;
      const float length_m = is_quad_ ? across_m : across_m * static_cast<float>(row) / rows;
      count +=
          1 + (length_m < kThinInSpacings * spacing_m
                   ? 0U
                   : static_cast<uint32_t>(std::min(kMaxRows, std::ceil(length_m / spacing_m))));
    }
    row_start_[size_t{num_rows_} + 1] = count;
    num_records_ = count;
  }
}

RecordGrid::FacePoint RecordGrid::FacePointAt(bool is_second, float u, float v) const {
  const size_t apex = is_second ? second_apex_ : apex_;
  const std::array<float, 3> weights = {1.0F - u - v, u, v};
  const float next = std::clamp(weights[(apex + 1) % 3], 0.0F, 1.0F);
  const float last = std::clamp(weights[(apex + 2) % 3], 0.0F, 1.0F);
  if (!is_quad_) {
    const float along = std::min(1.0F, next + last);
    return {along, along > 0.0F ? std::min(1.0F, last / (next + last)) : 0.0F};
  }
  // The second triangle goes round the other way: its next vertex is the first one's last.
  const float to_next = is_second ? 1.0F - next : next;
  const float to_last = is_second ? 1.0F - last : last;
  return is_turned_ ? FacePoint{to_last, to_next} : FacePoint{to_next, to_last};
}

float RecordGrid::GridPosition(float share, uint32_t num_cells) const {
  const auto cells = static_cast<float>(num_cells);
  const float position = share * cells;
  if (!is_quad_) {
    return position;
  }
  // The outermost records lie inside the face: nothing is interpolated beyond them.
  const float from_end = std::min(position, cells - position);
  if (from_end >= 1.0F || num_cells == 0) {
    return position;
  }
  if (num_cells == 1) {
    return std::clamp((position - kRimInCells) / (1.0F - 2.0F * kRimInCells), 0.0F, 1.0F);
  }
  const float in_cell = std::max(0.0F, (from_end - kRimInCells) / (1.0F - kRimInCells));
  return position < 1.0F ? in_cell : cells - in_cell;
}

RecordGrid::Stencil RecordGrid::StencilAt(bool is_second, float u, float v) const {
  Stencil stencil;
  if (num_rows_ == 0) {
    stencil.weights[0] = 1.0F;
    stencil.count = 1;
    return stencil;
  }
  const FacePoint place = FacePointAt(is_second, u, v);
  const float row_position = GridPosition(place.along, num_rows_);
  const auto row =
      std::min(static_cast<uint32_t>(row_position), static_cast<uint32_t>(num_rows_) - 1);
  const float row_weight = row_position - static_cast<float>(row);
  for (uint32_t k = 0; k < 2; ++k) {
    const float weight = k == 0 ? 1.0F - row_weight : row_weight;
    const uint32_t start = row_start_[row + k];
    const uint32_t num_cells = row_start_[row + k + 1] - start - 1;
    const float position = GridPosition(place.across, num_cells);
    const uint32_t cell =
        num_cells == 0 ? 0 : std::min(static_cast<uint32_t>(position), num_cells - 1);
    const float cell_weight = position - static_cast<float>(cell);
    const auto add = [&](uint32_t record_idx, float share) {
      if (share > 0.0F) {
        stencil.records[static_cast<size_t>(stencil.count)] = record_idx;
        stencil.weights[static_cast<size_t>(stencil.count)] = share;
        ++stencil.count;
      }
    };
    add(start + cell, weight * (1.0F - cell_weight));
    add(start + cell + 1, weight * cell_weight);
  }
  return stencil;
}

Vec3f RecordGrid::PositionM(const std::array<Vec3f, 3>& corners_m,
                            uint32_t record_idx,
                            float inset_m,
                            const Vec2f& offset_cells) const {
  const Vec3f& apex = corners_m[apex_];
  const Vec3f& next = corners_m[(apex_ + 1U) % 3];
  const Vec3f& last = corners_m[(apex_ + 2U) % 3];
  FacePoint place{is_quad_ ? 0.5F : 2.0F / 3.0F, 0.5F};
  Vec2f cell = Vec2f::Ones();
  if (num_rows_ > 0) {
    const uint32_t* row_end =
        std::upper_bound(row_start_.get(), row_start_.get() + num_rows_ + 1, record_idx);
    const auto row = static_cast<uint32_t>(row_end - row_start_.get() - 1);
    const uint32_t num_cells = row_start_[row + 1] - row_start_[row] - 1;
    place.along = static_cast<float>(row) / static_cast<float>(num_rows_);
    place.across = num_cells == 0 ? 0.5F
                                  : static_cast<float>(record_idx - row_start_[row]) /
                                        static_cast<float>(num_cells);
    cell = {1.0F / static_cast<float>(num_rows_),
            1.0F / static_cast<float>(std::max(num_cells, 1U))};
  }
  if (is_quad_) {
    const Vec2f rim = kRimInCells * cell;
    place.along = std::clamp(place.along, rim.x(), 1.0F - rim.x());
    place.across = std::clamp(place.across, rim.y(), 1.0F - rim.y());
  }
  place.along = std::clamp(place.along + offset_cells.x() * cell.x(), 0.0F, 1.0F);
  place.across = std::clamp(place.across + offset_cells.y() * cell.y(), 0.0F, 1.0F);
  const float double_area = (next - apex).cross(last - apex).norm();
  // Share of the height over an edge of this length that the inset is.
  const auto inset_share = [&](float edge_m) {
    return double_area > 0.0F ? std::min(kMaxInsetShare, inset_m * edge_m / double_area) : 0.0F;
  };
  if (is_quad_) {
    const float to_next = is_turned_ ? place.across : place.along;
    const float to_last = is_turned_ ? place.along : place.across;
    const float least_next = inset_share((last - apex).norm());
    const float least_last = inset_share((next - apex).norm());
    return apex + std::clamp(to_next, least_next, 1.0F - least_next) * (next - apex) +
           std::clamp(to_last, least_last, 1.0F - least_last) * (last - apex);
  }
  const std::array<float, 3> weights = {
      1.0F - place.along, place.along * (1.0F - place.across), place.along * place.across};
  const std::array<float, 3> least = {inset_share((last - next).norm()),
                                      inset_share((last - apex).norm()),
                                      inset_share((next - apex).norm())};
  const float rest = 1.0F - least[0] - least[1] - least[2];
  return (least[0] + rest * weights[0]) * apex + (least[1] + rest * weights[1]) * next +
         (least[2] + rest * weights[2]) * last;
}

}  // namespace pfseq
