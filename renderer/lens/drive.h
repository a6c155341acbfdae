// SPDX-License-Identifier: Apache-2.0
// A drive around a U: up one street, a corner, across, a corner, back down another street. The path
// starts in the world's origin towards +X and consists of straights and quarter circles; along it
// the car accelerates, brakes and takes the corners with piecewise constant acceleration, so
// position and speed are exact at any time.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/lens/trajectory.h"

#include <array>
#include <vector>

namespace pfseq {

enum class Turn { kLeft, kRight };

/// The U on the ground.
class DrivePath {
 public:
  struct Shape {
    /// Lengths of the straights between the arcs, >= 0.
    double first_street_m = 0.0;
    double cross_street_m = 0.0;
    double last_street_m = 0.0;
    /// > 0.
    double corner_radius_m = 1.0;
    Turn turn = Turn::kLeft;
  };

  /// A stretch of constant curvature.
  struct Segment {
    double length_m = 0.0;
    /// Signed, 1 / radius: positive to the left, 0 for a straight.
    double curvature_per_m = 0.0;
    Vec2d start_m = Vec2d::Zero();
    /// Heading at the start, in quarter turns to the left from +X.
    int start_quarter_turns = 0;
  };

  explicit DrivePath(const Shape& shape);

  /// First street, corner, cross street, corner, last street.
  const std::array<Segment, 5>& Segments() const { return segments_; }

  double LengthM() const { return length_m_; }

  /// Position on the ground (z = 0) and heading after a way along the path, clamped to the path.
  RigidTransform WorldFromCar(double way_m) const;

 private:
  std::array<Segment, 5> segments_;
  double length_m_ = 0.0;
};

/// The path driven: at rest for a while, then up to cruising speed on straights, down to the corner
/// speed in corners, at rest again at the end. Where a straight is too short to reach its speed the
/// peak is lower; where even the corner speed has not been reached at an arc, the car goes on
/// accelerating in it. Speed never jumps.
class DriveTrajectory : public Trajectory {
 public:
  struct Speeds {
    /// All > 0.
    double cruise_mps = 1.0;
    double corner_mps = 1.0;
    /// Of speeding up and of braking.
    double acceleration_mps2 = 1.0;
    /// Time at rest before the start, >= 0.
    double stop_s = 0.0;
  };

  /// The rig rides at a height above the ground.
  DriveTrajectory(const DrivePath& path, const Speeds& speeds, double height_m);

  RigidTransform WorldFromRig(double time_s) const override;

  /// Way along the path and speed at a time.
  double WayM(double time_s) const;
  double SpeedMps(double time_s) const;

  /// When the car stands again.
  double EndTimeS() const { return phases_.back().start_s; }

  const DrivePath& Path() const { return path_; }

 private:
  /// A stretch of constant acceleration.
  struct Phase {
    double start_s = 0.0;
    double way_m = 0.0;
    double speed_mps = 0.0;
    double acceleration_mps2 = 0.0;
  };

  void AppendSegment(double length_m, double limit_mps, double exit_mps, double acceleration_mps2);
  void AppendPhase(double acceleration_mps2,
                   double duration_s,
                   double end_way_m,
                   double end_speed_mps);
  const Phase& PhaseAt(double time_s) const;

  DrivePath path_;
  double height_m_;
  /// By start time; the last one is the rest at the end.
  std::vector<Phase> phases_;
};

}  // namespace pfseq
