// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/one_to_one.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include <nanoflann.hpp>

namespace pfseq {
namespace {

/// The points that have a position, in nanoflann's form.
struct PointCloud {
  explicit PointCloud(const std::vector<std::optional<Vec3d>>& points_m) {
    for (size_t i = 0; i < points_m.size(); ++i) {
      if (points_m[i]) {
        positions_m.push_back(*points_m[i]);
        idx.push_back(static_cast<int>(i));
      }
    }
  }

  // Names that nanoflann asks for.
  size_t kdtree_get_point_count() const { return positions_m.size(); }
  double kdtree_get_pt(size_t i, size_t axis) const {
    return positions_m[i][static_cast<int>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  std::vector<Vec3d> positions_m;
  std::vector<int> idx;
};

using Tree = nanoflann::
    KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud>, PointCloud, 3>;

/// All pairs closer than the limit, closest first.
std::vector<PointPair> PairsWithin(const PointCloud& first,
                                   const PointCloud& second,
                                   double max_distance_m) {
  std::vector<PointPair> pairs;
  if (first.positions_m.empty() || second.positions_m.empty()) {
    return pairs;
  }
  const Tree tree(3, second);
  // The search takes the square of the radius; a little more than asked for, as the limit is tested
  // below.
  const double search_m2 = max_distance_m * max_distance_m * (1.0 + 1e-9);
  std::vector<std::pair<uint32_t, double>> found;
  nanoflann::SearchParams unsorted;
  unsorted.sorted = false;
  for (size_t i = 0; i < first.positions_m.size(); ++i) {
    tree.radiusSearch(first.positions_m[i].data(), search_m2, found, unsorted);
    for (const auto& [second_i, squared_m2] : found) {
      const double distance_m = (first.positions_m[i] - second.positions_m[second_i]).norm();
      if (distance_m < max_distance_m) {
        pairs.push_back({first.idx[i], second.idx[second_i], distance_m});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const PointPair& a, const PointPair& b) {
    return std::tie(a.distance_m, a.first_idx, a.second_idx) <
           std::tie(b.distance_m, b.first_idx, b.second_idx);
  });
  return pairs;
}

}  // namespace

std::vector<PointPair> OneToOneClosestFirst(const std::vector<std::optional<Vec3d>>& first_m,
                                            const std::vector<std::optional<Vec3d>>& second_m,
                                            double max_distance_m) {
  std::vector<bool> first_taken(first_m.size(), false);
  std::vector<bool> second_taken(second_m.size(), false);
  std::vector<PointPair> chosen;
  for (const PointPair& pair :
       PairsWithin(PointCloud(first_m), PointCloud(second_m), max_distance_m)) {
    if (!first_taken[pair.first_idx] && !second_taken[pair.second_idx]) {
      first_taken[pair.first_idx] = true;
      second_taken[pair.second_idx] = true;
      chosen.push_back(pair);
    }
  }
  return chosen;
}

}  // namespace pfseq
