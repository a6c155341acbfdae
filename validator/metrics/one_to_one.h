// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/vector.h"

#include <optional>
#include <vector>

namespace pfseq {

/// Two points that stand for the same place.
struct PointPair {
  int first_idx = 0;
  int second_idx = 0;
  double distance_m = 0.0;
};

/// Pairs points of the two sets that are closer than max_distance_m, each point in one pair at
/// most: of all pairs the closest is taken first, then the closest of those left; of equal
/// distances the one with smaller indices. Ascending in distance: what one would get for a smaller
/// limit is the beginning of it. Points without a position are in no pair.
std::vector<PointPair> OneToOneClosestFirst(const std::vector<std::optional<Vec3d>>& first_m,
                                            const std::vector<std::optional<Vec3d>>& second_m,
                                            double max_distance_m);

}  // namespace pfseq
