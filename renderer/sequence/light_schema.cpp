// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/units.h"
#include "renderer/sequence/schema_parts.h"
#include "renderer/sequence/sun_position.h"

#include <cstdint>
#include <optional>

#include <fmt/format.h>

namespace pfseq {
namespace {

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

}  // namespace

YamlTypePtr<LightSpec> LightSchema() {
  auto schema = NewMapping<LightSpec>();
  schema->Key("sun", &LightSpec::sun, YamlOptional(SunSchema()), "")
      .Key("sky", &LightSpec::sky, SkySchema(), "")
      .Finish(FinishLight);
  return schema;
}

}  // namespace pfseq
