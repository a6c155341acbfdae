// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "tools/commands.h"
#include "tools/common_options.h"
#include "validator/benchmark/benchmark.h"
#include "validator/benchmark/results_writer.h"

#include <chrono>
#include <memory>
#include <tuple>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kDefaultSetting = "SIFT nopol 0.04 5.0 1.6 SIFT BruteForce";
constexpr size_t kMaxTableLines = 60;

constexpr const char* kFooter = R"(
DIR is a sequence's folder, or the description (.yaml) of a dataset from elsewhere. Without --grid and --setting one
triplet is measured: SIFT nopol 0.04 5.0 1.6 SIFT BruteForce.

Writes results.csv and results.json (each metric of each setting and pair at twelve distances and the grid's angles), and
times.csv and run.json (how long it took). Finished stages are kept in RESULTS/stages: --resume goes on with them after an interruption, or judges them
anew. With --shard I/N several programs share the work of one RESULTS folder; a last run with --resume writes the results.

Examples:
  pfseq bench --grid data/grids/paper.yaml --list
  pfseq bench out/pfseq --grid data/grids/quick.yaml --out out/quick --pairs 0,24,40 --lens equisolid
  pfseq bench out/pfseq --grid data/grids/paper.yaml --out out/paper --pairs 0,24,40 --lens equisolid --resume
  pfseq bench out/pfseq --setting "CenSurE nopol 16 10 7 ORB 2 BruteForce" --out out/one --pictures
  pfseq bench out/pfseq --grid data/grids/quick.yaml --out out/next --successive 1 --judge map
  pfseq bench out/pfseq --grid data/grids/quick.yaml --out out/far --pairs front:0-front:5,front:0-rear:5)";

struct BenchFlags {
  std::filesystem::path folder;
  std::filesystem::path out;
  std::filesystem::path grid;
  std::vector<std::string> settings;
  std::vector<std::string> cameras;
  std::string judge = "ray";
  std::string shard = "0/1";
  bool has_pictures = false;
  bool is_list = false;
  BenchmarkOptions options;
  RunFlags run;
};

Grid GridOf(const BenchFlags& flags) {
  if (!flags.grid.empty() && !flags.settings.empty()) {
    throw InputError("--setting: expected without --grid, got both");
  }
  if (!flags.grid.empty()) {
    return Grid::Read(flags.grid);
  }
  return Grid::FromNames(flags.settings.empty() ? std::vector<std::string>{kDefaultSetting}
                                                : flags.settings);
}

void List(const Grid& grid) {
  for (const std::string& name : grid.DetectorNames()) {
    fmt::print("{}\n", name);
  }
  for (const std::string& name : grid.TripletNames()) {
    fmt::print("{}\n", name);
  }
  fmt::print("\n{}", GridSummary(grid));
}

void RunBench(BenchFlags& flags) {
  const Grid grid = GridOf(flags);
  if (flags.is_list) {
    return List(grid);
  }
  if (flags.folder.empty() || flags.out.empty()) {
    throw InputError("bench: expected DIR and --out RESULTS (or --list)");
  }
  BenchmarkOptions& options = flags.options;
  if (!flags.cameras.empty()) {
    if (flags.cameras.size() != 2) {
      throw InputError("--cameras: expected a pair, got {} cameras", flags.cameras.size());
    }
    options.cameras = {flags.cameras[0], flags.cameras[1]};
  }
  if (options.successive > 0 && !options.pairs.empty()) {
    throw InputError("--successive: expected without --pairs, got both");
  }
  options.judge = flags.judge == "map" ? Judge::kMap : Judge::kRay;
  std::tie(options.shard, options.num_shards) = ParseShard(flags.shard);
  options.num_threads = flags.run.num_threads;
  options.quiet = flags.run.quiet;
  options.stages = flags.out / "stages";
  options.resume |= options.num_shards > 1;
  if (flags.has_pictures) {
    options.pictures = flags.out / "pictures";
  }
  const auto start = std::chrono::steady_clock::now();
  const std::unique_ptr<ViewSource> source = OpenViews(flags.folder);
  const BenchmarkResults results = RunBenchmark(*source, grid, options);
  if (options.num_shards > 1) {
    fmt::print("shard {} done; run once more with --resume for the results\n", flags.shard);
    return;
  }
  WriteResults(results, flags.out);
  const std::chrono::duration<double> wall_s = std::chrono::steady_clock::now() - start;
  WriteRun({CommandLine(), flags.folder, wall_s.count()}, flags.out);
  fmt::print("{}results in {}\n", BenchmarkTable(results, kMaxTableLines), flags.out.string());
}

}  // namespace

void AddBenchCommand(CLI::App& app) {
  auto flags = std::make_shared<BenchFlags>();
  BenchmarkOptions& options = flags->options;
  CLI::App* command = app.add_subcommand("bench", "Measures features on pairs of views");
  command->footer(kFooter);
  command->add_option("DIR", flags->folder, "Folder of a sequence, or a dataset's description");
  command->add_option("--out", flags->out, "Folder of the results");
  command->add_option("--grid", flags->grid, "Settings to measure (data/grids/*.yaml)");
  command->add_option("--setting", flags->settings, "A setting by its name; repeatable")
      ->take_all();
  command->add_flag("--list", flags->is_list, "Only tells the settings' names and how many");
  command->add_option("--pairs",
                      options.pairs,
                      "Frames of two cameras (0,24,40 or START:STOP[:STEP]) or any two views "
                      "(CAMERA:FRAME-CAMERA:FRAME), separated by commas (default: all frames)");
  command
      ->add_option(
          "--successive", options.successive, "Pairs each frame of a camera with the N-th next one")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--cameras", flags->cameras, "Two cameras (default: the first two)")
      ->delimiter(',');
  command
      ->add_option("--lens,--lenses", options.lenses, "Lenses, separated by commas (default: all)")
      ->delimiter(',');
  command->add_option("--variant",
                      options.variant,
                      "realistic or clean images (default: realistic where there are such)");
  command->add_option("--judge", flags->judge, "Places in the world by exact ray or distance map")
      ->check(CLI::IsMember({"ray", "map"}))
      ->capture_default_str();
  command->add_option("--seed", options.seed, "Of the confidence intervals' random numbers")
      ->capture_default_str();
  command->add_flag("--resume", options.resume, "Takes finished stages from RESULTS/stages");
  command
      ->add_option("--shard",
                   flags->shard,
                   "I/N: each N-th unit of work, starting with I, into RESULTS/stages")
      ->capture_default_str();
  command->add_flag("--pictures", flags->has_pictures, "Pictures of all matches");
  AddRunFlags(*command, flags->run);
  command->callback([flags] { RunBench(*flags); });
}

}  // namespace pfseq
