// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/scene_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

#include <nanoflann.hpp>

namespace pfseq {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Points in nanoflann's form.
struct PointCloud {
  // Names that nanoflann asks for.
  size_t kdtree_get_point_count() const { return positions.size(); }
  double kdtree_get_pt(size_t i, size_t axis) const { return positions[i][static_cast<int>(axis)]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  std::vector<Vec3d> positions;
  std::vector<int> idx;
};

/// What `place` makes of the points that have one.
template <typename Place>
PointCloud CloudOf(const ScenePoints& points_m, const Place& place) {
  PointCloud cloud;
  for (size_t i = 0; i < points_m.size(); ++i) {
    if (points_m[i]) {
      cloud.positions.push_back(place(*points_m[i]));
      cloud.idx.push_back(static_cast<int>(i));
    }
  }
  return cloud;
}

using Tree = nanoflann::
    KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud>, PointCloud, 3>;

/// All pairs with separation(first, second) < limit, closest first; they are closer than `radius`
/// in the clouds.
template <typename Separation>
std::vector<PointPair> PairsWithin(const PointCloud& first,
                                   const PointCloud& second,
                                   double radius,
                                   double limit,
                                   const Separation& separation) {
  std::vector<PointPair> pairs;
  if (first.positions.empty() || second.positions.empty()) {
    return pairs;
  }
  const Tree tree(3, second);
  // The search takes the square of the radius; a little more than asked for, as the limit is tested
  // below.
  const double search = radius * radius * (1.0 + 1e-9);
  std::vector<std::pair<uint32_t, double>> found;
  nanoflann::SearchParams unsorted;
  unsorted.sorted = false;
  for (size_t i = 0; i < first.positions.size(); ++i) {
    tree.radiusSearch(first.positions[i].data(), search, found, unsorted);
    for (const auto& entry : found) {
      const int second_idx = second.idx[entry.first];
      const double value = separation(first.idx[i], second_idx);
      if (value < limit) {
        pairs.push_back({first.idx[i], second_idx, value});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const PointPair& a, const PointPair& b) {
    return std::tie(a.separation, a.first_idx, a.second_idx) <
           std::tie(b.separation, b.first_idx, b.second_idx);
  });
  return pairs;
}

std::vector<PointPair> ClosestFirst(const std::vector<PointPair>& pairs,
                                    const PointsOfPair& points) {
  std::vector<bool> first_taken(points.first_m.size(), false);
  std::vector<bool> second_taken(points.second_m.size(), false);
  std::vector<PointPair> chosen;
  for (const PointPair& pair : pairs) {
    if (!first_taken[pair.first_idx] && !second_taken[pair.second_idx]) {
      first_taken[pair.first_idx] = true;
      second_taken[pair.second_idx] = true;
      chosen.push_back(pair);
    }
  }
  return chosen;
}

double AngleBetweenRad(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

double DistanceM(const PointsOfPair& points, int first_idx, int second_idx) {
  const std::optional<Vec3d>& first = points.first_m[first_idx];
  const std::optional<Vec3d>& second = points.second_m[second_idx];
  return first && second ? (*first - *second).norm() : kInfinity;
}

double AngleRad(const PointsOfPair& points, int first_idx, int second_idx) {
  const std::optional<Vec3d>& first = points.first_m[first_idx];
  const std::optional<Vec3d>& second = points.second_m[second_idx];
  if (!first || !second) {
    return kInfinity;
  }
  return std::max(
      AngleBetweenRad(*first - points.first_centre_m, *second - points.first_centre_m),
      AngleBetweenRad(*first - points.second_centre_m, *second - points.second_centre_m));
}

std::vector<PointPair> OneToOneWithinDistance(const PointsOfPair& points, double max_distance_m) {
  const auto same = [](const Vec3d& point_m) { return point_m; };
  return ClosestFirst(
      PairsWithin(CloudOf(points.first_m, same),
                  CloudOf(points.second_m, same),
                  max_distance_m,
                  max_distance_m,
                  [&](int first, int second) { return DistanceM(points, first, second); }),
      points);
}

std::vector<PointPair> OneToOneWithinAngle(const PointsOfPair& points, double max_angle_rad) {
  // Directions from the second camera; the chord of the angle bounds the search.
  const auto direction = [&](const Vec3d& point_m) {
    return Vec3d((point_m - points.second_centre_m).normalized());
  };
  return ClosestFirst(
      PairsWithin(CloudOf(points.first_m, direction),
                  CloudOf(points.second_m, direction),
                  2.0 * std::sin(0.5 * std::min(max_angle_rad, 3.0)),
                  max_angle_rad,
                  [&](int first, int second) { return AngleRad(points, first, second); }),
      points);
}

}  // namespace pfseq
