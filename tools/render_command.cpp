// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "renderer/sequence_renderer.h"
#include "tools/commands.h"
#include "tools/common_options.h"

#include <charconv>
#include <memory>
#include <tuple>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kFooter = R"(
Examples:
  pfseq render data/sequences/pfseq.yaml --out out/pfseq --frames 0,24,40
  pfseq render data/sequences/pfseq.yaml --out out/small --set image.size_px=300 --set render.samples=16
  pfseq render data/sequences/pfseq.yaml --out out/truth --outputs distance,sky
  pfseq render data/sequences/pfseq.yaml --out out/lens --frames 0 --set optics=data/optics/strong.yaml
  pfseq render data/sequences/pfseq.yaml --out out/shutter --frames 24 --set shutter.exposure_s=0.1
  pfseq render data/sequences/pfseq.yaml --out out/pfseq --resume --shard 0/4     one of four machines
  pfseq render data/sequences/pfseq.yaml --frames 24 --cameras front --lenses equisolid --pixel 600,300

A stopped run goes on with --resume and ends with the same bytes. manifest.json is written last: its presence means
that all that was asked for is there.)";

struct RenderFlags {
  DescriptionFlags description;
  SelectionFlags selection;
  RunFlags run;
  std::filesystem::path folder;
  std::vector<std::string> outputs;
  bool resume = false;
  bool overwrite = false;
  std::string shard;
  std::string pixel;
  LightFlags light;
};

/// "X,Y" as two whole numbers >= 0.
std::pair<int, int> ParsePixel(const std::string& text) {
  std::pair<int, int> pair;
  const char* end = text.data() + text.size();
  const auto [middle, error] = std::from_chars(text.data(), end, pair.first);
  if (error == std::errc() && middle != end && *middle == ',') {
    const auto [last, second_error] = std::from_chars(middle + 1, end, pair.second);
    if (second_error == std::errc() && last == end && pair.first >= 0 && pair.second >= 0) {
      return pair;
    }
  }
  throw InputError("--pixel {}: expected two whole numbers as X,Y", text);
}

RenderOptions MakeOptions(const RenderFlags& flags) {
  RenderOptions options;
  options.folder = flags.folder;
  options.frames = ParseFrames(flags.selection.frames);
  options.cameras = flags.selection.cameras;
  options.lenses = flags.selection.lenses;
  if (!flags.outputs.empty()) {
    options.outputs.clear();
    for (const std::string& name : flags.outputs) {
      options.outputs.push_back(OutputFromName(name));
    }
  }
  options.light_cache = flags.light.Options();
  options.num_threads = flags.run.num_threads;
  options.quiet = flags.run.quiet;
  options.on_existing = flags.overwrite ? OnExisting::kOverwrite
                        : flags.resume  ? OnExisting::kResume
                                        : OnExisting::kRefuse;
  if (!flags.shard.empty()) {
    if (flags.overwrite) {
      throw InputError("--shard {}: does not go with --overwrite: shards share a folder",
                       flags.shard);
    }
    std::tie(options.shard_idx, options.num_shards) = ParseShard(flags.shard);
    // Whichever shard starts first writes the description; the others find it there.
    options.on_existing = OnExisting::kResume;
  }
  return options;
}

void PrintPixel(const RenderFlags& flags) {
  const auto [x, y] = ParsePixel(flags.pixel);
  const std::vector<int> frames = ParseFrames(flags.selection.frames);
  if (frames.size() != 1 || flags.selection.cameras.size() != 1 ||
      flags.selection.lenses.size() != 1) {
    throw InputError(
        "--pixel {}: expected one frame, camera and lens with --frames, --cameras and --lenses",
        flags.pixel);
  }
  const FrameFile record{
      flags.selection.lenses[0], flags.selection.cameras[0], Output::kClean, frames[0]};
  fmt::print("{}", DescribePixel(LoadSequenceInput(flags.description), record, x, y));
}

void RunRender(const RenderFlags& flags) {
  if (!flags.pixel.empty()) {
    PrintPixel(flags);
    return;
  }
  if (flags.folder.empty()) {
    throw InputError("--out: expected the folder to write to");
  }
  const RenderOptions options = MakeOptions(flags);
  const SequenceInput input = LoadSequenceInput(flags.description);
  if (!flags.run.quiet) {
    fmt::print(stderr,
               "scene: {} triangles, {} materials, {} textures\n",
               input.scene->NumTriangles(),
               input.scene->materials.size(),
               input.scene->textures.size());
  }
  const RenderSummary summary = RenderSequence(input, options);
  fmt::print("{}: {} records, {} files written, {} kept; {}\n",
             options.folder.string(),
             summary.num_records,
             summary.num_files_written,
             summary.num_files_kept,
             summary.is_complete ? "complete" : "other shards have files left to write");
}

}  // namespace

void AddRenderCommand(CLI::App& app) {
  auto flags = std::make_shared<RenderFlags>();
  CLI::App* command = app.add_subcommand("render", "Renders a sequence with its ground truth");
  command->footer(kFooter);
  AddDescriptionFlags(*command, flags->description);
  command->add_option("--out", flags->folder, "Folder of the sequence");
  AddSelectionFlags(*command, flags->selection);
  command
      ->add_option("--outputs",
                   flags->outputs,
                   "What to write: realistic, clean, linear (half-float EXR of clean), distance, "
                   "sky, blur (way in px while the shutter is open), "
                   "realistic_linear (half-float EXR, before the sensor), flare (half-float EXR); "
                   "default: clean,distance,sky and, where shutter, optics or sensor are on, "
                   "realistic")
      ->delimiter(',');
  CLI::Option* resume =
      command->add_flag("--resume", flags->resume, "Go on with a sequence of the same description");
  command->add_flag("--overwrite", flags->overwrite, "Replace the sequence that is there")
      ->excludes(resume);
  command->add_option(
      "--shard", flags->shard, "I/N: render each N-th record, starting with I; implies --resume");
  command->add_option(
      "--pixel", flags->pixel, "X,Y: print what this pixel sees instead of writing anything");
  AddLightFlags(*command, flags->light);
  AddRunFlags(*command, flags->run);
  command->callback([flags] { RunRender(*flags); });
}

}  // namespace pfseq
