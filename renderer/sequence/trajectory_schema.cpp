// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/schema_parts.h"

#include <fmt/format.h>

namespace pfseq {
namespace {

void FinishDrive(const YamlMappingView& yaml, DriveSpec& drive) {
  if (drive.corner_speed_mps > drive.cruise_speed_mps) {
    yaml.Fail("corner_speed_mps",
              fmt::format("expected at most cruise_speed_mps ({}), got {}",
                          drive.cruise_speed_mps,
                          drive.corner_speed_mps));
  }
}

YamlTypePtr<DriveSpec> DriveSchema() {
  auto schema = NewMapping<DriveSpec>();
  schema
      ->Key("first_street_m",
            &DriveSpec::first_street_m,
            From(0.0, 10000.0),
            "Straight way before the first corner in metres; the drive starts at x = y = 0 towards "
            "+X.")
      .Key("cross_street_m",
           &DriveSpec::cross_street_m,
           From(0.0, 10000.0),
           "Straight way between the corners in metres.")
      .Key("last_street_m",
           &DriveSpec::last_street_m,
           From(0.0, 10000.0),
           "Straight way after the second corner in metres; the car stops at its end.")
      .Key("corner_radius_m",
           &DriveSpec::corner_radius_m,
           Above0(1000.0),
           "Radius of both corners in metres.")
      .Key("turn",
           &DriveSpec::turn,
           YamlChoice({"left", "right"}),
           "Side to which both corners turn.")
      .Key("cruise_speed_mps",
           &DriveSpec::cruise_speed_mps,
           Above0(100.0),
           "Speed on the straights in metres per second, where they are long enough to reach it.")
      .Key("corner_speed_mps",
           &DriveSpec::corner_speed_mps,
           Above0(100.0),
           "Speed in the corners in metres per second, at most cruise_speed_mps.")
      .Key("acceleration_mps2",
           &DriveSpec::acceleration_mps2,
           Above0(100.0),
           "Acceleration and braking in metres per second squared.")
      .Key("stop_s",
           &DriveSpec::stop_s,
           From(0.0, 3600.0),
           "Time at rest before the start in seconds.")
      .Finish(FinishDrive);
  return schema;
}

void FinishTrajectory(const YamlMappingView& yaml, TrajectorySpec& trajectory) {
  const bool has_file = !trajectory.tum.empty() || !trajectory.csv.empty();
  if (has_file && !yaml.Has("num_frames")) {
    trajectory.num_frames = 0;
  }
  if (!has_file && trajectory.num_frames == 0) {
    yaml.Fail("num_frames", "expected at least 1 without a trajectory file, got 0");
  }
}

}  // namespace

YamlTypePtr<TrajectorySpec> TrajectorySchema() {
  auto schema = NewMapping<TrajectorySpec>();
  schema->Key("drive", &TrajectorySpec::drive, DriveSchema(), "")
      .Key("tum",
           &TrajectorySpec::tum,
           YamlPath(),
           "A file of rig poses in TUM format (timestamp tx ty tz qx qy qz qw) to use instead of "
           "the drive.")
      .Key("csv",
           &TrajectorySpec::csv,
           YamlPath(),
           "A CSV file with the columns frame,x_m,y_m,yaw_deg to use instead of the drive.")
      .Key("num_frames",
           &TrajectorySpec::num_frames,
           YamlInteger<int>(0, 1000000),
           "Number of frames; 0, the default with a file: as many as it has poses.")
      .Key("frame_rate_hz",
           &TrajectorySpec::frame_rate_hz,
           Above0(1e6),
           "Frames per second of the drive and of csv; frame 0 is at 0 s.")
      .Key("height_m",
           &TrajectorySpec::height_m,
           From(0.0, 1000.0),
           "Height of the rig above the street in metres, for the drive and csv.")
      .Exclusive({"tum", "csv"})
      .Finish(FinishTrajectory);
  return schema;
}

}  // namespace pfseq
