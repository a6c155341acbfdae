// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sequence_schema.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/sequence/sun_position.h"
#include "renderer/sequence/yaml_schema.h"

#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>

#include <fmt/format.h>

namespace pfseq {
namespace {

YamlTypePtr<double> Above0(double most) { return YamlNumber({0.0, most, true}); }
YamlTypePtr<double> From(double least, double most) { return YamlNumber({least, most, false}); }

template <typename T>
std::shared_ptr<YamlMapping<T>> NewMapping() {
  return std::make_shared<YamlMapping<T>>();
}

YamlTypePtr<ImageSpec> ImageSchema() {
  auto schema = NewMapping<ImageSpec>();
  schema->Key("size_px",
              &ImageSpec::size_px,
              YamlArray<2>(YamlInteger<int>(1, 32768), true),
              "Width and height of the frames in pixels.");
  return schema;
}

void FinishLens(const YamlMappingView& yaml, LensSpec& lens) {
  if (lens.circle_px == 0.0 && lens.focal_px[0] == 0.0) {
    yaml.Fail("circle_px", "expected circle_px or focal_px, got neither");
  }
  const bool has_polynomial = lens.model == KannalaBrandt::kName;
  if (!has_polynomial && yaml.Has("coefficients")) {
    yaml.Fail(
        "coefficients",
        fmt::format("expected only for {}, the model is {}", KannalaBrandt::kName, lens.model));
  }
  const LensModel model = MakeLensModel(lens);
  if (!LensModelCovers(model, 0.5 * RadFromDeg(lens.fov_deg))) {
    yaml.Fail("fov_deg",
              fmt::format("expected {}, got {}", LensModelFieldText(model), lens.fov_deg));
  }
}

YamlTypePtr<LensSpec> LensSchema() {
  auto schema = NewMapping<LensSpec>();
  schema
      ->Key("model",
            &LensSpec::model,
            YamlChoice(LensModelNames()),
            "Projection: image height r of a ray at the incidence angle t to the optical axis. "
            "equidistant f t, "
            "equisolid 2 f sin(t/2), stereographic 2 f tan(t/2), orthographic f sin(t), "
            "perspective f tan(t), "
            "kannala_brandt f (t + k1 t^3 + k2 t^5 + k3 t^7 + k4 t^9).")
      .Key("fov_deg",
           &LensSpec::fov_deg,
           Above0(360.0),
           "Full field of view in degrees; rays beyond do not reach the image.")
      .Key("circle_px",
           &LensSpec::circle_px,
           Above0(1e6),
           "Diameter of the image circle, to which the field of view maps, in pixels; or give "
           "focal_px.",
           [](const LensSpec& lens) { return lens.circle_px != 0.0; })
      .Key("focal_px",
           &LensSpec::focal_px,
           YamlArray<2>(Above0(1e6), true),
           "Focal length along x and y in pixels; or give circle_px.",
           [](const LensSpec& lens) { return lens.focal_px[0] != 0.0; })
      .Key("principal_point_px",
           &LensSpec::principal_point_px,
           YamlOptional(YamlArray<2>(From(-1e6, 1e6))),
           "Where the optical axis meets the image, from its outer upper-left corner, in pixels "
           "(the first pixel's "
           "centre is 0.5, 0.5); absent: the image's centre.")
      .Key("image_width_px",
           &LensSpec::image_width_px,
           YamlInteger<int>(0, 1000000),
           "Image width for which the pixel figures above are meant; at another width they scale "
           "with it. 0: they "
           "are meant as they are.")
      .Key("coefficients",
           &LensSpec::coefficients,
           YamlArray<4>(YamlNumber({})),
           "k1 to k4 of kannala_brandt.",
           [](const LensSpec& lens) { return lens.model == KannalaBrandt::kName; })
      .Exclusive({"circle_px", "focal_px"})
      .Finish(FinishLens);
  return schema;
}

YamlTypePtr<CameraSpec> CameraSchema() {
  auto schema = NewMapping<CameraSpec>();
  schema
      ->Key("position_m",
            &CameraSpec::position_m,
            YamlArray<3>(From(-1000.0, 1000.0)),
            "Position on the rig in metres: X forward, Y left, Z up.")
      .Key("rotation_xzy_deg",
           &CameraSpec::rotation_xzy_deg,
           YamlArray<3>(From(-360.0, 360.0)),
           "Rotation in degrees about X, Y and Z, applied in the order X, Z, Y. With zeros the "
           "camera looks at the "
           "zenith, image right is forward, image down is left.");
  return schema;
}

YamlTypePtr<SequenceSpec> RigSchema() {
  auto schema = NewMapping<SequenceSpec>();
  schema->Key("cameras", &SequenceSpec::cameras, YamlNamed("camera", CameraSchema()), "");
  return schema;
}

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

void CheckAscending(const YamlMappingView& yaml,
                    const std::string& key,
                    const std::array<double, 2>& range) {
  if (range[0] > range[1]) {
    yaml.Fail(key, fmt::format("expected the least first, got [{}, {}]", range[0], range[1]));
  }
}

YamlTypePtr<CanyonSpec> CanyonSchema() {
  auto schema = NewMapping<CanyonSpec>();
  schema
      ->Key("seed",
            &CanyonSpec::seed,
            YamlInteger<uint64_t>(0, UINT64_MAX),
            "Another seed makes another city.")
      .Key("street_width_m",
           &CanyonSpec::street_width_m,
           YamlArray<2>(From(4.0, 100.0)),
           "Least and greatest distance between opposite facades in metres.")
      .Key("building_height_m",
           &CanyonSpec::building_height_m,
           YamlArray<2>(From(3.0, 300.0)),
           "Least and greatest height of eaves or parapets in metres.")
      .Key("detail",
           &CanyonSpec::detail,
           From(0.0, 2.0),
           "Density of detail: 0 bare walls with windows, 1 normal, 2 the most.")
      .Key("street_life",
           &CanyonSpec::street_life,
           From(0.0, 2.0),
           "Cars, people, trees, lamps, signs, wires: 0 none, 1 normal, 2 crowded.")
      .Key("texel_m",
           &CanyonSpec::texel_m,
           From(0.004, 1.0),
           "Size of the texels of walls at street level beside the drive in metres.")
      .Key("pitched_roof_share",
           &CanyonSpec::pitched_roof_share,
           From(0.0, 1.0),
           "Share of the buildings that have a pitched roof.")
      .Key("surrounding_blocks",
           &CanyonSpec::surrounding_blocks,
           YamlInteger<int>(0, 20),
           "Rows of blocks around the U in each direction.")
      .Key("facades",
           &CanyonSpec::facades,
           YamlPath(),
           "A description of facade photographs (data/facades) to take the fronts from.",
           [](const CanyonSpec& canyon) { return !canyon.facades.empty(); })
      .Finish([](const YamlMappingView& yaml, CanyonSpec& canyon) {
        CheckAscending(yaml, "street_width_m", canyon.street_width_m);
        CheckAscending(yaml, "building_height_m", canyon.building_height_m);
      });
  return schema;
}

YamlTypePtr<SceneSpec> SceneSchema() {
  auto schema = NewMapping<SceneSpec>();
  schema
      ->Key("canyon",
            &SceneSpec::canyon,
            CanyonSchema(),
            "",
            [](const SceneSpec& scene) { return scene.gltf.empty(); })
      .Key("gltf",
           &SceneSpec::gltf,
           YamlPath(),
           "A .glb or .gltf file to use instead of the canyon.")
      .Exclusive({"canyon", "gltf"});
  return schema;
}

bool HasDate(const SunSpec& sun) { return !sun.date_time.empty(); }

/// The direction that follows from date, time and place.
void FinishSun(const YamlMappingView& yaml, SunSpec& sun) {
  if (!HasDate(sun)) {
    for (const char* key : {"latitude_deg", "longitude_deg", "north_deg"}) {
      if (yaml.Has(key)) {
        yaml.Fail(key, "expected only with date_time, got none");
      }
    }
    return;
  }
  const std::optional<double> unix_time_s = ParseDateTime(sun.date_time);
  if (!unix_time_s) {
    yaml.Fail("date_time",
              fmt::format("expected a date from 1900 to 2099 and a time with its offset from UTC, "
                          "such as 2014-06-21T15:30:00+02:00, got {}",
                          sun.date_time));
  }
  const SunPosition position =
      SunAt(*unix_time_s, RadFromDeg(sun.latitude_deg), RadFromDeg(sun.longitude_deg));
  sun.elevation_deg = DegFromRad(position.elevation_rad);
  sun.azimuth_deg = sun.north_deg - DegFromRad(position.azimuth_from_north_rad);
  if (sun.elevation_deg <= 0.0) {
    yaml.Fail("date_time",
              fmt::format("expected a time when the sun is up; at {} it stands at {:.1f} degrees",
                          sun.date_time,
                          sun.elevation_deg));
  }
}

YamlTypePtr<SunSpec> SunSchema() {
  auto schema = NewMapping<SunSpec>();
  const auto has_angles = [](const SunSpec& sun) { return !HasDate(sun); };
  schema
      ->Key("elevation_deg",
            &SunSpec::elevation_deg,
            From(0.0, 90.0),
            "Angle above the horizon in degrees; or give date_time.",
            has_angles)
      .Key("azimuth_deg",
           &SunSpec::azimuth_deg,
           From(-360.0, 360.0),
           "Direction in degrees, counter-clockwise from the world's X axis seen from above; or "
           "give date_time.",
           has_angles)
      .Key("date_time",
           &SunSpec::date_time,
           YamlLine(),
           "Date and time with the offset from UTC, such as 2014-06-21T15:30:00+02:00; the sun's "
           "direction follows from it and the three keys below.",
           HasDate)
      .Key("latitude_deg",
           &SunSpec::latitude_deg,
           From(-90.0, 90.0),
           "Latitude of the place in degrees, north positive.",
           HasDate)
      .Key("longitude_deg",
           &SunSpec::longitude_deg,
           From(-180.0, 180.0),
           "Longitude of the place in degrees, east positive.",
           HasDate)
      .Key("north_deg",
           &SunSpec::north_deg,
           From(-360.0, 360.0),
           "Direction of north in degrees, counter-clockwise from the world's X axis seen from "
           "above.",
           HasDate)
      .Key("angular_diameter_deg",
           &SunSpec::angular_diameter_deg,
           Above0(20.0),
           "Diameter of the disc in degrees.")
      .Key("strength",
           &SunSpec::strength,
           From(0.0, 1e6),
           "Multiplies the sun's physical strength; 0 turns it off.");
  for (const char* angle : {"elevation_deg", "azimuth_deg"}) {
    for (const char* other : {"date_time", "latitude_deg", "longitude_deg", "north_deg"}) {
      schema->Exclusive({angle, other});
    }
  }
  schema->Finish(FinishSun);
  return schema;
}

YamlTypePtr<CloudSpec> CloudSchema() {
  auto schema = NewMapping<CloudSpec>();
  schema
      ->Key("share",
            &CloudSpec::share,
            From(0.0, 1.0),
            "Share of the clear sky above the horizon that clouds cover, 0 none. A cloud before "
            "the sun dims it.")
      .Key("seed",
           &CloudSpec::seed,
           YamlInteger<uint64_t>(0, UINT64_MAX),
           "Another seed makes other clouds.");
  return schema;
}

/// A map makes the model map; of a map and a model that do not fit, one set by an override replaces
/// another one from the file.
void FinishSky(const YamlMappingView& yaml, SkySpec& sky) {
  if (!sky.map.empty() && sky.model != "map") {
    const bool is_map_override = HasOverride(yaml.Find("map"));
    const bool is_model_override = HasOverride(yaml.Find("model"));
    if (!yaml.Has("model") || (is_map_override && !is_model_override)) {
      sky.model = "map";
    } else if (is_model_override && !is_map_override) {
      sky.map.clear();
    } else {
      yaml.Fail("map", fmt::format("expected only with model: map, the model is {}", sky.model));
    }
  }
  if (sky.map.empty() && sky.model == "map") {
    yaml.Fail("map", "expected the path of a file with model: map, got none");
  }
}

YamlTypePtr<SkySpec> SkySchema() {
  auto schema = NewMapping<SkySpec>();
  schema
      ->Key("model",
            &SkySpec::model,
            YamlChoice({"clear", "constant", "map"}),
            "clear: from sun and turbidity, with clouds; constant: the same radiance everywhere; "
            "map: a picture, which brings its own sun.")
      .Key("turbidity",
           &SkySpec::turbidity,
           From(1.8, 10.0),
           "Haze of the clear sky: 2 very clear, 10 hazy.")
      .Key("clouds", &SkySpec::clouds, CloudSchema(), "")
      .Key("radiance",
           &SkySpec::radiance,
           YamlArray<3>(From(0.0, 1e6)),
           "Radiance of the constant sky, linear Rec. 709.")
      .Key("map",
           &SkySpec::map,
           YamlPath(),
           "An EXR or HDR file with the radiance of all directions, latitude-longitude, twice as "
           "wide as high: top row zenith, centre column the world's X axis, +Y to the left of it.")
      .Key("map_rotation_deg",
           &SkySpec::map_rotation_deg,
           From(-360.0, 360.0),
           "Turns the map about Z in degrees, counter-clockwise seen from above.")
      .Key("strength",
           &SkySpec::strength,
           From(0.0, 1e6),
           "Multiplies the sky's strength, with a map that of its sun too; 0 turns it off.")
      .Finish(FinishSky);
  return schema;
}

/// A map has the place of the sun; one set by an override replaces the sun of the file.
void FinishLight(const YamlMappingView& yaml, LightSpec& light) {
  if (light.sky.model != "map" || !yaml.Has("sun")) {
    return;
  }
  const YamlValue* sky = yaml.Find("sky");
  const bool is_map_override = HasOverride(sky->Find("map")) || HasOverride(sky->Find("model"));
  if (!is_map_override || HasOverride(yaml.Find("sun"))) {
    yaml.Fail("sun", "expected none with a sky map, which brings its own sun");
  }
  light.sun.reset();
}

YamlTypePtr<LightSpec> LightSchema() {
  auto schema = NewMapping<LightSpec>();
  schema->Key("sun", &LightSpec::sun, YamlOptional(SunSchema()), "")
      .Key("sky", &LightSpec::sky, SkySchema(), "")
      .Finish(FinishLight);
  return schema;
}

YamlTypePtr<RenderSpec> RenderSchema() {
  auto schema = NewMapping<RenderSpec>();
  schema
      ->Key("light",
            &RenderSpec::light,
            YamlChoice({"cached", "path"}),
            "cached: skylight and indirect light are computed once and stored on the surfaces; "
            "path: every pixel traces whole paths, the reference.")
      .Key("light_quality",
           &RenderSpec::light_quality,
           From(0.1, 16.0),
           "Cached light: twice the value halves the spacing of the stored light and makes each "
           "record of four times the rays.")
      .Key("seed",
           &RenderSpec::seed,
           YamlInteger<uint64_t>(0, UINT64_MAX),
           "Another seed gives other noise.")
      .Key("samples",
           &RenderSpec::samples,
           YamlInteger<int>(1, 1000000),
           "Samples of each pixel (paths, with light: path).")
      .Key("max_samples",
           &RenderSpec::max_samples,
           YamlInteger<int>(1, 1000000),
           "Cached light: pixels whose samples differ get more of them, up to this many; at most "
           "as many as samples: none.")
      .Key("max_bounces",
           &RenderSpec::max_bounces,
           YamlInteger<int>(0, 1000),
           "Scattering events of a path at most.")
      .Key("min_indirect_roughness",
           &RenderSpec::min_indirect_roughness,
           From(0.0, 1.0),
           "Least roughness of surfaces that a path meets after its first one; 0: no bias, but "
           "bright "
           "points where windows throw sunlight.");
  return schema;
}

YamlTypePtr<SensorSpec> SensorSchema() {
  auto schema = NewMapping<SensorSpec>();
  schema
      ->Key("exposure",
            &SensorSpec::exposure,
            YamlWordOr("auto", Above0(1e9)),
            "Multiplies linear radiance before the tone curve. auto: from the light that falls on "
            "the ground, the same for the whole sequence.")
      .Key("tone_curve",
           &SensorSpec::tone_curve,
           YamlChoice({"clip", "shoulder"}),
           "clip: linear up to white; shoulder: highlights roll off smoothly.");
  return schema;
}

YamlTypePtr<GroundTruthSpec> GroundTruthSchema() {
  auto schema = NewMapping<GroundTruthSpec>();
  schema->Key("max_distance_m",
              &GroundTruthSpec::max_distance_m,
              Above0(1e6),
              "Distances beyond are +inf in the maps, like the sky; metres.");
  return schema;
}

YamlTypePtr<SequenceSpec> SequenceSchema() {
  auto schema = NewMapping<SequenceSpec>();
  schema
      ->Note("pfseq_version",
             PFSEQ_VERSION,
             "Version of the program that wrote the file; not looked at.")
      .Key("name", &SequenceSpec::name, YamlLine(), "A name for people.")
      .Key("image", &SequenceSpec::image, ImageSchema(), "")
      .Key("lenses", &SequenceSpec::lenses, YamlNamed("lens", LensSchema()), "")
      .Group("rig", RigSchema())
      .Key("trajectory", &SequenceSpec::trajectory, TrajectorySchema(), "")
      .Key("scene", &SequenceSpec::scene, SceneSchema(), "")
      .Key("light", &SequenceSpec::light, LightSchema(), "")
      .Key("render", &SequenceSpec::render, RenderSchema(), "")
      .Key("sensor", &SequenceSpec::sensor, SensorSchema(), "")
      .Key("ground_truth", &SequenceSpec::ground_truth, GroundTruthSchema(), "")
      .Finish([](const YamlMappingView& /*yaml*/, SequenceSpec& spec) {
        if (spec.scene.gltf.empty() && !spec.light.sun && spec.light.sky.model != "map") {
          spec.light.sun.emplace();
        }
      });
  return schema;
}

/// The file's mapping; InputError when it holds anything else.
YamlValue ReadYamlMapping(const std::filesystem::path& path, const std::string& what) {
  YamlValue root = ReadYaml(path);
  if (root.kind != YamlValue::Kind::kMapping) {
    FailAtYaml(
        root,
        "",
        fmt::format(
            "expected the description of a {} (KEY: VALUE), got {}", what, DescribeYaml(root)));
  }
  return root;
}

}  // namespace

SequenceSpec ReadSequenceSpec(const std::filesystem::path& path,
                              const std::vector<std::string>& overrides) {
  YamlValue root = ReadYamlMapping(path, "sequence");
  for (const std::string& override_text : overrides) {
    ApplyOverride(override_text, root);
  }
  SequenceSpec spec;
  SequenceSchema()->Read(root, "", spec);
  return spec;
}

std::string CanonicalYaml(const SequenceSpec& spec) {
  return YamlText(SequenceSchema()->Write(spec));
}

LensSpec ReadLensSpec(const std::filesystem::path& path) {
  LensSpec lens;
  LensSchema()->Read(ReadYamlMapping(path, "lens"), "", lens);
  return lens;
}

bool IsSequenceFile(const std::filesystem::path& path) {
  return ReadYamlMapping(path, "lens or sequence").Find("lenses") != nullptr;
}

std::string SchemaHelp() {
  const SequenceSpec defaults;
  std::vector<YamlKeyHelp> keys;
  SequenceSchema()->Describe({}, defaults, keys);
  std::string text;
  for (const YamlKeyHelp& help : keys) {
    fmt::format_to(std::back_inserter(text),
                   "{}: {}\n    {}\n    {}\n",
                   help.key,
                   help.default_text,
                   help.expected,
                   help.meaning);
  }
  return text;
}

}  // namespace pfseq
