// SPDX-License-Identifier: Apache-2.0
// The description of a sequence as plain values, in the order of the YAML file. Keys of the file
// are the names of the members; sequence_schema.cpp lists each with its range and meaning, and is
// the one place that reads and writes them.
#pragma once

#include "renderer/sequence/camera_spec.h"
#include "renderer/sequence/named.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pfseq {

/// image: the frames' raster.
struct ImageSpec {
  /// Width and height; a single number in the file stands for both.
  std::array<int, 2> size_px = {1200, 1200};

  bool operator==(const ImageSpec&) const = default;
};

/// A lens: its model and either field of view and circle diameter, or a focal length in pixels.
struct LensSpec {
  /// equidistant, equisolid, stereographic, orthographic, perspective or kannala_brandt.
  std::string model = "equidistant";
  /// Full field of view; rays further from the axis than half of it do not reach the image.
  double fov_deg = 181.8;
  /// Diameter of the image circle (of the field of view above); 0 when focal_px is given instead.
  double circle_px = 0.0;
  /// Focal length in pixels along x and y; one number in the file stands for both. 0: from
  /// circle_px.
  std::array<double, 2> focal_px = {0.0, 0.0};
  /// Principal point, origin at the image's outer upper-left corner; absent: the image's centre.
  std::optional<std::array<double, 2>> principal_point_px;
  /// Image width that the pixel figures of this lens are meant for; 0: the sequence's own. At
  /// another width they scale.
  int image_width_px = 0;
  /// k1 to k4 of kannala_brandt: r = f (t + k1 t^3 + k2 t^5 + k3 t^7 + k4 t^9), t the incidence
  /// angle.
  std::array<double, 4> coefficients = {0.0, 0.0, 0.0, 0.0};

  bool operator==(const LensSpec&) const = default;
};

/// rig.cameras.NAME: where a camera sits on the rig. rig_from_camera rotation = Ry * Rz * Rx.
struct CameraSpec {
  std::array<double, 3> position_m = {0.0, 0.0, 0.0};
  /// Angles about X, Y and Z ("gimbal Euler XZY": X is applied first, then Z, then Y).
  std::array<double, 3> rotation_xzy_deg = {0.0, 0.0, 0.0};

  bool operator==(const CameraSpec&) const = default;
};

/// trajectory.drive: a U: up one street, a corner, across, a corner, back.
struct DriveSpec {
  /// Straight lengths between the arcs.
  double first_street_m = 46.0;
  double cross_street_m = 60.0;
  double last_street_m = 90.0;
  double corner_radius_m = 8.0;
  /// left or right.
  std::string turn = "left";
  double cruise_speed_mps = 9.0;
  double corner_speed_mps = 5.0;
  double acceleration_mps2 = 2.0;
  /// Time at rest before the car starts.
  double stop_s = 0.5;

  bool operator==(const DriveSpec&) const = default;
};

struct TrajectorySpec {
  /// Used when neither file is given; the canyon is built along it in any case.
  DriveSpec drive;
  /// Path of a TUM text file (poses of the rig in the world), or empty.
  std::string tum;
  /// Path of a CSV file with the columns frame,x_m,y_m,yaw_deg, or empty.
  std::string csv;
  /// 0, only with a file and its default there: as many as it has poses.
  int num_frames = 64;
  double frame_rate_hz = 2.5;
  /// Height of the rig above the street for drive and csv.
  double height_m = 1.6;

  bool operator==(const TrajectorySpec&) const = default;
};

/// scene.canyon: the procedural city around the U.
struct CanyonSpec {
  uint64_t seed = 1;
  /// Widths between opposite facades, least and greatest.
  std::array<double, 2> street_width_m = {12.0, 18.0};
  /// Heights of buildings (eaves or parapet), least and greatest.
  std::array<double, 2> building_height_m = {10.0, 35.0};
  /// Density of detail: 0 bare walls with windows, 1 the default, 2 the most.
  double detail = 1.0;
  /// How far windows lie behind the walls and sills, mouldings and balconies stand out, against
  /// ordinary stone houses; the less, the fewer balconies.
  double relief = 1.0;
  /// Share of buildings whose windows have glazing bars about small panes.
  double small_panes = 0.0;
  /// Share of buildings with walls of rubble: field stones, one in ten black or pale.
  double rubble = 0.0;
  /// What stands and hangs in the streets: 0 nothing, 1 the default, 2 crowded.
  double street_life = 1.0;
  /// Size of the texels of fronts beside the drive at street level.
  double texel_m = 0.012;
  /// Share of buildings with a pitched roof.
  double pitched_roof_share = 0.5;
  /// Rows of blocks around the U in each direction.
  int surrounding_blocks = 2;
  /// Path of a description of facade photographs that fronts are taken from, or empty.
  std::string facades;

  bool operator==(const CanyonSpec&) const = default;
};

/// scene: either a canyon or a glTF file.
struct SceneSpec {
  CanyonSpec canyon;
  /// Path of a .glb or .gltf file; empty: the canyon.
  std::string gltf;

  bool operator==(const SceneSpec&) const = default;
};

/// light.sun. For a glTF scene with a sun of its own and no light.sun in the file, that one is
/// used.
struct SunSpec {
  double elevation_deg = 40.0;
  /// Compass-free: counter-clockwise from the world's X axis, seen from above.
  double azimuth_deg = 130.0;
  /// Date and time with the offset from UTC, "2014-06-21T15:30:00+02:00"; when given, elevation and
  /// azimuth above follow from it, the place and north_deg, which the file then has instead of
  /// them. Empty: the angles were given themselves.
  std::string date_time;
  double latitude_deg = 48.85;
  double longitude_deg = 2.35;
  /// Direction of north, counter-clockwise from the world's X axis.
  double north_deg = 90.0;
  /// Diameter of the disc.
  double angular_diameter_deg = 0.53;
  /// Multiplies the sun's physical strength; 0 turns it off.
  double strength = 1.0;

  bool operator==(const SunSpec&) const = default;
};

/// light.sky.clouds: procedural clouds over the clear sky; the other models have none.
struct CloudSpec {
  /// Share of the sky above the horizon that clouds cover; 0 none. A cloud before the sun dims it.
  double share = 0.0;
  /// Another seed makes other clouds.
  uint64_t seed = 1;

  bool operator==(const CloudSpec&) const = default;
};

struct SkySpec {
  /// clear (analytic, from sun and turbidity), constant or map.
  std::string model = "clear";
  double turbidity = 3.0;
  CloudSpec clouds;
  /// Radiance of the constant sky.
  std::array<double, 3> radiance = {1.0, 1.0, 1.0};
  /// Path of a latitude-longitude HDR image (EXR or HDR), or empty. It brings its own sun.
  std::string map;
  /// Turns the map about Z, counter-clockwise seen from above.
  double map_rotation_deg = 0.0;
  /// Multiplies the sky's strength; 0 turns it off.
  double strength = 1.0;

  bool operator==(const SkySpec&) const = default;
};

struct LightSpec {
  /// Absent for a sky map, which brings its own sun, and for a glTF scene: its own sun if it has
  /// one, else the default SunSpec. A canyon under another sky always has one.
  std::optional<SunSpec> sun;
  SkySpec sky;

  bool operator==(const LightSpec&) const = default;
};

struct RenderSpec {
  /// cached: skylight and indirect light are computed once and stored on the surfaces; path: every
  /// pixel traces whole paths, the reference.
  std::string light = "cached";
  /// Cached light: how finely it is stored. Twice the value halves the spacing of the records and
  /// makes each of four times the rays.
  double light_quality = 1.0;
  uint64_t seed = 1;
  /// Samples of each pixel (paths, with light: path).
  int samples = 8;
  /// Cached light: pixels whose samples differ get more of them, up to this many.
  int max_samples = 64;
  /// Scattering events along a path at most.
  int max_bounces = 6;
  /// Least roughness of surfaces that a path meets after its first one; 0: no bias.
  double min_indirect_roughness = 0.3;

  bool operator==(const RenderSpec&) const = default;
};

struct GroundTruthSpec {
  /// Distances beyond are +inf, like the sky.
  double max_distance_m = 500.0;

  bool operator==(const GroundTruthSpec&) const = default;
};

struct SequenceSpec {
  std::string name = "pfseq";
  ImageSpec image;
  std::vector<Named<LensSpec>> lenses;
  /// rig.cameras in the file; the first is the reference.
  std::vector<Named<CameraSpec>> cameras;
  TrajectorySpec trajectory;
  SceneSpec scene;
  LightSpec light;
  RenderSpec render;
  ShutterSpec shutter;
  OpticsSpec optics;
  SensorSpec sensor;
  GroundTruthSpec ground_truth;

  bool operator==(const SequenceSpec&) const = default;

  /// Whether realistic frames differ from clean ones.
  bool IsRealistic() const { return shutter.IsOn() || optics.IsOn() || sensor.IsRealistic(); }
};

}  // namespace pfseq
