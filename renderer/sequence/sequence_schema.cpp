// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sequence_schema.h"

#include "renderer/core/error.h"
#include "renderer/sequence/schema_parts.h"

#include <cstdint>
#include <iterator>

#include <fmt/format.h>

namespace pfseq {
namespace {

YamlTypePtr<ImageSpec> ImageSchema() {
  auto schema = NewMapping<ImageSpec>();
  schema->Key("size_px",
              &ImageSpec::size_px,
              YamlArray<2>(YamlInteger<int>(1, 32768), true),
              "Width and height of the frames in pixels.");
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
      .Key("shutter", &SequenceSpec::shutter, ShutterSchema(), "")
      .Key("optics", &SequenceSpec::optics, OpticsSchema(), "")
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

/// What stands for a mapping in a file of its own: optics and each lens.
void ReadPart(const std::string& what, YamlValue& value) {
  if (value.kind == YamlValue::Kind::kScalar) {
    YamlValue part = ReadYamlMapping(value.origin.folder / value.text, what);
    part.origin.override_key = value.origin.override_key;
    value = std::move(part);
  }
}

/// Puts the mappings of other files where their paths stand.
void ReadParts(YamlValue& root) {
  if (YamlValue* optics = root.Find("optics")) {
    ReadPart("camera's optics", *optics);
  }
  if (YamlValue* lenses = root.Find("lenses")) {
    for (YamlEntry& lens : lenses->entries) {
      ReadPart("lens", lens.value);
    }
  }
}

}  // namespace

SequenceSpec ReadSequenceSpec(const std::filesystem::path& path,
                              const std::vector<std::string>& overrides) {
  YamlValue root = ReadYamlMapping(path, "sequence");
  ReadParts(root);
  for (const std::string& override_text : overrides) {
    ApplyOverride(override_text, root);
    ReadParts(root);
  }
  SequenceSpec spec;
  SequenceSchema()->Read(root, "", spec);
  return spec;
}

SequenceSpec ReadChangedSequenceSpec(const std::filesystem::path& path,
                                     const std::vector<SpecChange>& changes) {
  YamlValue root = ReadYamlMapping(path, "sequence");
  ReadParts(root);
  for (const SpecChange& change : changes) {
    YamlOrigin origin = change.value.origin;
    origin.where += fmt::format(": {}", change.key);
    SetYamlKey(change.key, change.value, origin, root);
    ReadParts(root);
  }
  SequenceSpec spec;
  SequenceSchema()->Read(root, "", spec);
  return spec;
}

std::string CanonicalYaml(const SequenceSpec& spec) {
  return YamlText(SequenceSchema()->Write(spec));
}

std::string CanonicalYaml(const LightSpec& light) { return YamlText(LightSchema()->Write(light)); }

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
