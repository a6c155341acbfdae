// SPDX-License-Identifier: Apache-2.0
// Where in the world key points lie, and how far apart two of them are.
#pragma once

#include "renderer/core/vector.h"
#include "validator/metrics/tolerances.h"

#include <array>
#include <optional>
#include <vector>

namespace pfseq {

/// World points of a view's key points; nothing for those without a place (sky).
using ScenePoints = std::vector<std::optional<Vec3d>>;

/// Two key points that stand for the same place.
struct PointPair {
  int first_idx = 0;
  int second_idx = 0;
  /// Metres or radians.
  double separation = 0.0;
};

/// Two views with their points.
struct PointsOfPair {
  ScenePoints first_m;
  ScenePoints second_m;
  /// Camera centres.
  Vec3d first_centre_m = Vec3d::Zero();
  Vec3d second_centre_m = Vec3d::Zero();
};

/// The distance of two points in metres.
double DistanceM(const PointsOfPair& points, int first_idx, int second_idx);

/// The larger of the two angles under which the cameras see the way from one point to the other;
/// +inf when one has no place. So a tolerance grows with the distance to the cameras (the report's
/// first criterion).
double AngleRad(const PointsOfPair& points, int first_idx, int second_idx);

/// Pairs points that are closer than a limit, each point in one pair at most: of all pairs the
/// closest is taken first, then the closest of those left; of equal ones the one with smaller
/// indices. Ascending: what one would get for a smaller limit is the beginning of it. Points
/// without a place are in no pair.
std::vector<PointPair> OneToOneWithinDistance(const PointsOfPair& points, double max_distance_m);
std::vector<PointPair> OneToOneWithinAngle(const PointsOfPair& points, double max_angle_rad);

}  // namespace pfseq
