// SPDX-License-Identifier: Apache-2.0
#include "tests/sequence/schema_fixture.h"

namespace pfseq {
namespace {

class TrajectorySchema : public SchemaTest {};

/// kSmall with a mapping `trajectory`.
std::string WithTrajectory(const std::string& trajectory) {
  return std::string(kSmall) + "trajectory: {" + trajectory + "}\n";
}

TEST_F(TrajectorySchema, ReadsEveryKeyIntoItsMember) {
  const SequenceSpec spec = Read(WithTrajectory(
      "drive: {first_street_m: 1, cross_street_m: 2, last_street_m: 3, corner_radius_m: 4, turn: "
      "right, cruise_speed_mps: 6, corner_speed_mps: 5, acceleration_mps2: 7, stop_s: 8}, "
      "num_frames: 9, frame_rate_hz: 10, height_m: 11"));
  TrajectorySpec expected;
  expected.drive = {.first_street_m = 1.0,
                    .cross_street_m = 2.0,
                    .last_street_m = 3.0,
                    .corner_radius_m = 4.0,
                    .turn = "right",
                    .cruise_speed_mps = 6.0,
                    .corner_speed_mps = 5.0,
                    .acceleration_mps2 = 7.0,
                    .stop_s = 8.0};
  expected.num_frames = 9;
  expected.frame_rate_hz = 10.0;
  expected.height_m = 11.0;
  EXPECT_EQ(spec.trajectory, expected);
  EXPECT_EQ(Read(CanonicalYaml(spec)), spec);
  EXPECT_EQ(CanonicalYaml(Read(CanonicalYaml(spec))), CanonicalYaml(spec));
}

TEST_F(TrajectorySchema, KeysThatAreNotThereKeepTheirDefaults) {
  TrajectorySpec expected;
  EXPECT_EQ(Read(kSmall).trajectory, expected);
  expected.drive.stop_s = 2.0;
  EXPECT_EQ(Read(WithTrajectory("drive: {stop_s: 2}")).trajectory, expected);
}

TEST_F(TrajectorySchema, FilesGiveTheirOwnNumberOfFrames) {
  for (const std::string file : {"tum: p.txt", "csv: p.csv"}) {
    const SequenceSpec spec = Read(WithTrajectory(file));
    EXPECT_EQ(spec.trajectory.num_frames, 0) << file;
    EXPECT_EQ(Read(CanonicalYaml(spec)), spec) << file;
    const SequenceSpec five = Read(WithTrajectory(file + ", num_frames: 5"));
    EXPECT_EQ(five.trajectory.num_frames, 5) << file;
    EXPECT_EQ(Read(CanonicalYaml(five)), five) << file;
  }
  EXPECT_EQ(Read(WithTrajectory("tum: sub/../p.txt")).trajectory.tum,
            (folder_.Path() / "p.txt").string());
  EXPECT_EQ(Read(WithTrajectory("csv: sub/p.csv")).trajectory.csv,
            (folder_.Path() / "sub/p.csv").string());
}

TEST_F(TrajectorySchema, ADriveHasFrames) {
  EXPECT_EQ(
      ErrorOf(std::string(kSmall) + "trajectory:\n  num_frames: 0\n"),
      "demo.yaml:7: trajectory.num_frames: expected at least 1 without a trajectory file, got 0");
  EXPECT_EQ(Read(WithTrajectory("num_frames: 1")).trajectory.num_frames, 1);
  EXPECT_EQ(Read(WithTrajectory("num_frames: 1000000")).trajectory.num_frames, 1000000);
  for (const std::string num : {"-1", "1000001", "2.5"}) {
    EXPECT_EQ(
        ErrorOf(WithTrajectory("num_frames: " + num)),
        "demo.yaml:6: trajectory.num_frames: expected a whole number from 0 to 1000000, got " +
            num);
  }
}

TEST_F(TrajectorySchema, IsOneFileAtMost) {
  EXPECT_EQ(ErrorOf(WithTrajectory("tum: a.txt, csv: b.csv")),
            "demo.yaml:6: trajectory.csv: expected either this or tum, got both");
  // An override takes the place of the other in the file.
  const TrajectorySpec trajectory =
      Read(WithTrajectory("tum: a.txt"), {"trajectory.csv=/b.csv"}).trajectory;
  EXPECT_EQ(trajectory.tum, "");
  EXPECT_EQ(trajectory.csv, "/b.csv");
  // Scenes are built along the drive in any case.
  EXPECT_EQ(Read(WithTrajectory("tum: a.txt, drive: {turn: right}")).trajectory.drive.turn,
            "right");
}

TEST_F(TrajectorySchema, TheCanonicalFormNamesNoFileOfADrive) {
  const std::string text = CanonicalYaml(Read(kSmall));
  EXPECT_NE(text.find("\ntrajectory:\n  drive:\n    first_street_m: 46\n"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("tum:"), std::string::npos) << text;
  EXPECT_EQ(text.find("csv:"), std::string::npos) << text;
}

TEST_F(TrajectorySchema, TakesNumbersUpToTheEndsOfTheirRange) {
  ExpectRange("trajectory.drive.first_street_m", 0.0, 10000.0);
  ExpectRange("trajectory.drive.cross_street_m", 0.0, 10000.0);
  ExpectRange("trajectory.drive.last_street_m", 0.0, 10000.0);
  ExpectAbove0("trajectory.drive.corner_radius_m", 1000.0);
  ExpectAbove0(
      "trajectory.drive.cruise_speed_mps", 100.0, {"trajectory.drive.corner_speed_mps=1e-7"});
  ExpectAbove0(
      "trajectory.drive.corner_speed_mps", 100.0, {"trajectory.drive.cruise_speed_mps=100"});
  ExpectAbove0("trajectory.drive.acceleration_mps2", 100.0);
  ExpectRange("trajectory.drive.stop_s", 0.0, 3600.0);
  ExpectAbove0("trajectory.frame_rate_hz", 1e6);
  ExpectRange("trajectory.height_m", 0.0, 1000.0);
}

TEST_F(TrajectorySchema, CornersAreNotTakenFasterThanStreets) {
  EXPECT_EQ(
      ErrorOf(std::string(kSmall) + "trajectory:\n  drive:\n    corner_speed_mps: 10\n"),
      "demo.yaml:8: trajectory.drive.corner_speed_mps: expected at most cruise_speed_mps (9), got "
      "10");
  // The default for corners is 5.
  EXPECT_EQ(ErrorOf(WithTrajectory("drive: {cruise_speed_mps: 4}")),
            "demo.yaml:6: trajectory.drive.corner_speed_mps: expected at most cruise_speed_mps "
            "(4), got 5");
  EXPECT_EQ(Read(WithTrajectory("drive: {corner_speed_mps: 9}")).trajectory.drive.corner_speed_mps,
            9.0);
}

TEST_F(TrajectorySchema, RefusesUnknownKeysAndSides) {
  EXPECT_EQ(ErrorOf(WithTrajectory("drive: {turn: up}")),
            "demo.yaml:6: trajectory.drive.turn: expected one of left, right, got up");
  EXPECT_EQ(ErrorOf(WithTrajectory("frame_rate: 3")),
            "demo.yaml:6: trajectory.frame_rate: unknown key; did you mean frame_rate_hz?");
  EXPECT_EQ(ErrorOf(WithTrajectory("drive: {stops_s: 3}")),
            "demo.yaml:6: trajectory.drive.stops_s: unknown key; did you mean stop_s?");
}

}  // namespace
}  // namespace pfseq
