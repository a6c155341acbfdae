// SPDX-License-Identifier: Apache-2.0
#include "tools/common_options.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parallel.h"
#include "renderer/film/exposure.h"
#include "renderer/metering.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/sequence_schema.h"
#include "renderer/trace/lighting.h"
#include "scenes/catalog.h"
#include "scenes/gltf/gltf_writer.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string_view>
#include <utility>

namespace pfseq {
namespace {

constexpr int kMaxThreads = 1024;

[[noreturn]] void FailFrames(const std::string& text) {
  throw InputError("--frames {}: expected numbers or START:STOP[:STEP], separated by commas", text);
}

std::vector<std::string_view> Split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const size_t position = text.find(separator);
    parts.push_back(text.substr(0, position));
    if (position == std::string_view::npos) {
      return parts;
    }
    text.remove_prefix(position + 1);
  }
}

/// Gives the scene the sun that lights it (not dimmed by clouds, which are the sky's).
Lighting SettleLight(const SequenceSpec& spec, Scene& scene) {
  Lighting lighting = MakeLighting(spec.light, scene.sun);
  if (spec.light.sky.model == "map") {
    scene.sun.reset();
    if (lighting.sun.has_value()) {
      scene.sun = Sun{lighting.sun->DirectionToSun().cast<float>(), lighting.sun->Irradiance()};
    }
  }
  if (spec.light.sun.has_value()) {
    scene.sun = MakeSun(*spec.light.sun, spec.light.sky.turbidity);
  }
  return lighting;
}

}  // namespace

std::string CommandLine() {
  // Words end with zero bytes (proc(5)).
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string text;
  for (std::string word; std::getline(file, word, '\0');) {
    if (text.empty()) {
      text = std::filesystem::path(word).filename().string();
      continue;
    }
    const bool is_plain =
        !word.empty() && word.find_first_of(" \t\n\"'\\$&;|<>()*?#") == std::string::npos;
    text += is_plain ? " " + word : fmt::format(" '{}'", word);
  }
  return text;
}

void AddRunFlags(CLI::App& command, RunFlags& flags) {
  flags.num_threads = NumHardwareThreads();
  command
      .add_option("--threads", flags.num_threads, "Number of threads; results do not depend on it")
      ->check(CLI::Range(1, kMaxThreads))
      ->capture_default_str();
  command.add_flag("--quiet", flags.quiet, "No progress");
}

void AddSelectionFlags(CLI::App& command, SelectionFlags& flags) {
  command.add_option("--frames",
                     flags.frames,
                     "Frames: 0,24,40 or START:STOP[:STEP], STOP not included (default: all)");
  command.add_option("--cameras", flags.cameras, "Cameras, separated by commas (default: all)")
      ->delimiter(',');
  command.add_option("--lenses", flags.lenses, "Lenses, separated by commas (default: all)")
      ->delimiter(',');
}

void AddDescriptionFlags(CLI::App& command, DescriptionFlags& flags) {
  command.add_option("SEQUENCE.yaml", flags.path, "Description of the sequence")->required();
  command
      .add_option("--set",
                  flags.overrides,
                  "Sets a key of the description, for example image.size_px=300; repeatable")
      ->type_name("KEY=VALUE")
      ->take_all();
}

std::vector<int> ParseFrames(const std::string& text) {
  std::vector<int> frames;
  if (text.empty()) {
    return frames;
  }
  constexpr int kMaxFrame = 1'000'000;
  const auto number = [&](std::string_view part) {
    int value = -1;
    const auto [last, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || last != part.data() + part.size() || value < 0 ||
        value > kMaxFrame) {
      FailFrames(text);
    }
    return value;
  };
  for (const std::string_view item : Split(text, ',')) {
    const std::vector<std::string_view> parts = Split(item, ':');
    if (parts.size() > 3) {
      FailFrames(text);
    }
    const int start = number(parts[0]);
    const int stop = parts.size() > 1 ? number(parts[1]) : start + 1;
    const int step = parts.size() > 2 ? number(parts[2]) : 1;
    if (step < 1 || stop <= start) {
      FailFrames(text);
    }
    for (int frame = start; frame < stop; frame += step) {
      frames.push_back(frame);
    }
  }
  return frames;
}

SequenceInput LoadSequenceInput(const DescriptionFlags& flags) {
  SequenceInput input;
  input.spec = ReadSequenceSpec(flags.path, flags.overrides);
  Scene scene = LoadScene(input.spec, "");
  input.lighting = std::make_shared<const Lighting>(SettleLight(input.spec, scene));
  input.scene = std::make_shared<const Scene>(std::move(scene));
  if (!input.spec.sensor.exposure.has_value()) {
    input.spec.sensor.exposure =
        input.spec.sensor.metering == "frame"
            ? MeteredExposure(input.spec, input.scene, *input.lighting, NumHardwareThreads())
            : AutoExposure(*input.lighting);
  }

  // The written description refers to the copies in its own folder.
  SequenceSpec written = input.spec;
  const bool has_photos = !written.scene.canyon.facades.empty();
  if (!written.scene.gltf.empty() || has_photos) {
    written.scene.gltf = kSceneFile;
  }
  const auto copy = [&](std::string& path, std::string_view name) {
    if (!path.empty()) {
      input.files.push_back({std::string(name), ReadFile(path)});
      path = name;
    }
  };
  copy(written.trajectory.tum, kTumInputFile);
  copy(written.trajectory.csv, kCsvInputFile);
  std::string& map = written.light.sky.map;
  copy(map, map.empty() || IsExr(ReadFile(map)) ? kExrSkyMapFile : kHdrSkyMapFile);
  const std::string credits = SceneCredits(input.spec, "");
  std::string yaml = CanonicalYaml(written);
  if (!credits.empty()) {
    yaml += "# " + credits + "\n";
  }
  input.files.insert(input.files.begin(), {std::string(kSequenceFile), yaml});
  input.files.push_back({std::string(kSceneFile), GlbBytes(*input.scene, credits)});
  return input;
}

}  // namespace pfseq
