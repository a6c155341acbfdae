// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/drive.h"

#include "renderer/core/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

constexpr double kQuarterTurnRad = 0.5 * std::numbers::pi;

/// The unit vector of a heading in quarter turns, without rounding.
Vec2d DirectionOfQuarterTurns(int quarter_turns) {
  switch (((quarter_turns % 4) + 4) % 4) {
    case 0:
      return {1.0, 0.0};
    case 1:
      return {0.0, 1.0};
    case 2:
      return {-1.0, 0.0};
    default:
      return {0.0, -1.0};
  }
}

Vec2d LeftOf(const Vec2d& direction) { return {-direction.y(), direction.x()}; }

}  // namespace

DrivePath::DrivePath(const Shape& shape) {
  PFSEQ_CHECK(shape.corner_radius_m > 0.0 && shape.first_street_m >= 0.0 &&
                  shape.cross_street_m >= 0.0 && shape.last_street_m >= 0.0,
              "radius {}, streets {}, {}, {}",
              shape.corner_radius_m,
              shape.first_street_m,
              shape.cross_street_m,
              shape.last_street_m);
  const int turn = shape.turn == Turn::kLeft ? 1 : -1;
  const double arc_m = kQuarterTurnRad * shape.corner_radius_m;
  const std::array<double, 5> lengths_m = {
      shape.first_street_m, arc_m, shape.cross_street_m, arc_m, shape.last_street_m};
  Vec2d position_m = Vec2d::Zero();
  int quarter_turns = 0;
  for (size_t i = 0; i < segments_.size(); ++i) {
    const bool is_arc = i % 2 == 1;
    segments_[i] = {
        lengths_m[i], is_arc ? turn / shape.corner_radius_m : 0.0, position_m, quarter_turns};
    const Vec2d direction = DirectionOfQuarterTurns(quarter_turns);
    if (is_arc) {
      position_m += shape.corner_radius_m * (direction + turn * LeftOf(direction));
      quarter_turns += turn;
    } else {
      position_m += lengths_m[i] * direction;
    }
    length_m_ += lengths_m[i];
  }
}

RigidTransform DrivePath::WorldFromCar(double way_m) const {
  double rest_m = std::max(way_m, 0.0);
  size_t segment_idx = 0;
  while (segment_idx + 1 < segments_.size() && rest_m > segments_[segment_idx].length_m) {
    rest_m -= segments_[segment_idx].length_m;
    ++segment_idx;
  }
  const Segment& segment = segments_[segment_idx];
  rest_m = std::min(rest_m, segment.length_m);
  const Vec2d direction = DirectionOfQuarterTurns(segment.start_quarter_turns);
  const double turned_rad = segment.curvature_per_m * rest_m;
  Vec2d position_m = segment.start_m + rest_m * direction;
  if (segment.curvature_per_m != 0.0) {
    const double half_sine = std::sin(0.5 * turned_rad);
    position_m = segment.start_m + (std::sin(turned_rad) / segment.curvature_per_m) * direction +
                 (2.0 * half_sine * half_sine / segment.curvature_per_m) * LeftOf(direction);
  }
  return PoseFromYaw({position_m.x(), position_m.y(), 0.0},
                     segment.start_quarter_turns * kQuarterTurnRad + turned_rad);
}

DriveTrajectory::DriveTrajectory(const DrivePath& path, const Speeds& speeds, double height_m)
    : path_(path), height_m_(height_m), phases_({Phase{}}) {
  PFSEQ_CHECK(speeds.cruise_mps > 0.0 && speeds.corner_mps > 0.0 &&
                  speeds.acceleration_mps2 > 0.0 && speeds.stop_s >= 0.0,
              "cruise {}, corner {}, acceleration {}, stop {}",
              speeds.cruise_mps,
              speeds.corner_mps,
              speeds.acceleration_mps2,
              speeds.stop_s);
  const auto& segments = path_.Segments();
  // The greatest speeds at the segments' borders that can be reached from rest (forward) and from
  // which the car can still brake for what follows (backward): v^2 = v0^2 + 2 a s.
  std::array<double, 6> border_mps = {
      0.0, speeds.corner_mps, speeds.corner_mps, speeds.corner_mps, speeds.corner_mps, 0.0};
  const auto reach_mps = [&](double from_mps, double length_m) {
    return std::sqrt(from_mps * from_mps + 2.0 * speeds.acceleration_mps2 * length_m);
  };
  const double corner_limit_mps = std::min(speeds.corner_mps, speeds.cruise_mps);
  for (size_t i = 0; i < segments.size(); ++i) {
    border_mps[i + 1] = std::min(
        {border_mps[i + 1], corner_limit_mps, reach_mps(border_mps[i], segments[i].length_m)});
  }
  for (size_t i = segments.size(); i-- > 0;) {
    border_mps[i] = std::min(border_mps[i], reach_mps(border_mps[i + 1], segments[i].length_m));
  }
  AppendPhase(0.0, speeds.stop_s, 0.0, 0.0);
  for (size_t i = 0; i < segments.size(); ++i) {
    AppendSegment(segments[i].length_m,
                  i % 2 == 1 ? corner_limit_mps : speeds.cruise_mps,
                  border_mps[i + 1],
                  speeds.acceleration_mps2);
  }
}

void DriveTrajectory::AppendSegment(double length_m,
                                    double limit_mps,
                                    double exit_mps,
                                    double acceleration_mps2) {
  const double start_m = phases_.back().way_m;
  const double entry_mps = phases_.back().speed_mps;
  // Speeding up to the peak and braking from it take, together, just the length, or less where the
  // limit cuts it off.
  const double peak_mps = std::clamp(
      std::sqrt(acceleration_mps2 * length_m + 0.5 * (entry_mps * entry_mps + exit_mps * exit_mps)),
      std::max(entry_mps, exit_mps),
      limit_mps);
  const double speeding_m =
      (peak_mps - entry_mps) * (peak_mps + entry_mps) / (2.0 * acceleration_mps2);
  const double braking_m =
      (peak_mps - exit_mps) * (peak_mps + exit_mps) / (2.0 * acceleration_mps2);
  const double steady_m = std::max(0.0, length_m - speeding_m - braking_m);
  AppendPhase(acceleration_mps2,
              (peak_mps - entry_mps) / acceleration_mps2,
              start_m + speeding_m,
              peak_mps);
  if (peak_mps > 0.0) {
    AppendPhase(0.0, steady_m / peak_mps, start_m + speeding_m + steady_m, peak_mps);
  }
  AppendPhase(
      -acceleration_mps2, (peak_mps - exit_mps) / acceleration_mps2, start_m + length_m, exit_mps);
}

void DriveTrajectory::AppendPhase(double acceleration_mps2,
                                  double duration_s,
                                  double end_way_m,
                                  double end_speed_mps) {
  phases_.back().acceleration_mps2 = acceleration_mps2;
  phases_.push_back(
      {phases_.back().start_s + std::max(duration_s, 0.0), end_way_m, end_speed_mps, 0.0});
}

const DriveTrajectory::Phase& DriveTrajectory::PhaseAt(double time_s) const {
  const auto after =
      std::upper_bound(phases_.begin(), phases_.end(), time_s, [](double t, const Phase& p) {
        return t < p.start_s;
      });
  return after == phases_.begin() ? phases_.front() : *(after - 1);
}

double DriveTrajectory::WayM(double time_s) const {
  const Phase& phase = PhaseAt(time_s);
  const double elapsed_s = std::max(0.0, time_s - phase.start_s);
  return phase.way_m + elapsed_s * (phase.speed_mps + 0.5 * phase.acceleration_mps2 * elapsed_s);
}

double DriveTrajectory::SpeedMps(double time_s) const {
  const Phase& phase = PhaseAt(time_s);
  return phase.speed_mps + phase.acceleration_mps2 * std::max(0.0, time_s - phase.start_s);
}

RigidTransform DriveTrajectory::WorldFromRig(double time_s) const {
  RigidTransform world_from_rig = path_.WorldFromCar(WayM(time_s));
  world_from_rig.translation_m.z() = height_m_;
  return world_from_rig;
}

}  // namespace pfseq
