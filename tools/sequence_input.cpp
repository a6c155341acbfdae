// SPDX-License-Identifier: Apache-2.0
#include "tools/sequence_input.h"

#include "renderer/core/check.h"
#include "renderer/core/file.h"
#include "renderer/core/parallel.h"
#include "renderer/film/exposure.h"
#include "renderer/lit_scene.h"
#include "renderer/metering.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/sequence_schema.h"
#include "renderer/trace/lighting.h"
#include "scenes/catalog.h"
#include "scenes/gltf/gltf_writer.h"

#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace pfseq {
namespace {

/// Gives the scene the sun that lights it (not dimmed by clouds, which are the sky's).
void SettleSun(const SequenceSpec& spec, const Lighting& lighting, Scene& scene) {
  if (spec.light.sky.model == "map") {
    scene.sun.reset();
    if (lighting.sun.has_value()) {
      scene.sun = Sun{lighting.sun->DirectionToSun().cast<float>(), lighting.sun->Irradiance()};
    }
  }
  if (spec.light.sun.has_value()) {
    scene.sun = MakeSun(*spec.light.sun, spec.light.sky.turbidity);
  }
}

void SettleExposure(SequenceInput& input) {
  if (!input.spec.sensor.exposure.has_value()) {
    input.spec.sensor.exposure =
        input.spec.sensor.metering == "frame"
            ? MeteredExposure(input.spec, input.scene, *input.lighting, NumHardwareThreads())
            : AutoExposure(*input.lighting);
  }
}

std::string_view SkyMapFile(const std::string& map) {
  return IsExr(ReadFile(map)) ? kExrSkyMapFile : kHdrSkyMapFile;
}

/// The written description refers to the copies in its own folder.
std::string SequenceYaml(const SequenceSpec& spec, const std::string& credits) {
  SequenceSpec written = spec;
  const bool has_photos = !written.scene.canyon.facades.empty();
  if (!written.scene.gltf.empty() || has_photos) {
    written.scene.gltf = kSceneFile;
  }
  if (!written.trajectory.tum.empty()) {
    written.trajectory.tum = kTumInputFile;
  }
  if (!written.trajectory.csv.empty()) {
    written.trajectory.csv = kCsvInputFile;
  }
  if (!written.light.sky.map.empty()) {
    written.light.sky.map = SkyMapFile(spec.light.sky.map);
  }
  return CanonicalYaml(written) + (credits.empty() ? "" : "# " + credits + "\n");
}

}  // namespace

SequenceInput LoadSequenceInput(const SequenceSpec& spec) {
  SequenceInput input;
  input.spec = spec;
  Scene scene = LoadScene(spec, "");
  Lighting lighting = MakeLighting(spec.light, scene.sun);
  SettleSun(spec, lighting, scene);
  input.lighting = std::make_shared<const Lighting>(std::move(lighting));
  input.scene = std::make_shared<const Scene>(std::move(scene));
  SettleExposure(input);

  const std::string credits = SceneCredits(spec, "");
  input.files.push_back({std::string(kSequenceFile), SequenceYaml(input.spec, credits)});
  const auto copy = [&](const std::string& path, std::string_view name) {
    input.files.push_back({std::string(name), ReadFile(path)});
  };
  if (!spec.trajectory.tum.empty()) {
    copy(spec.trajectory.tum, kTumInputFile);
  }
  if (!spec.trajectory.csv.empty()) {
    copy(spec.trajectory.csv, kCsvInputFile);
  }
  if (!spec.light.sky.map.empty()) {
    copy(spec.light.sky.map, SkyMapFile(spec.light.sky.map));
  }
  input.files.push_back({std::string(kSceneFile), GlbBytes(*input.scene, credits)});
  return input;
}

void ChangeCameras(const SequenceSpec& spec, SequenceInput& input) {
  PFSEQ_CHECK(LitSceneKey(spec) == LitSceneKey(input.spec), "scene or light differ");
  input.spec = spec;
  SettleExposure(input);
  input.files.front().bytes = SequenceYaml(input.spec, SceneCredits(spec, ""));
}

}  // namespace pfseq
