// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "tools/commands.h"
#include "tools/common_options.h"
#include "validator/benchmark.h"
#include "validator/benchmark_writer.h"

#include <memory>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kFooter = R"(
Writes results.csv (matches, repeatability, correct matches and matching score at twelve distance tolerances),
summary.csv, times.csv, benchmark.json and a picture of the matches of each pair.

Examples:
  pfseq bench out/pfseq --out out/pfseq_bench
  pfseq bench out/pfseq --out out/pfseq_bench --frames 0,24,40 --lenses equisolid)";

struct BenchFlags {
  std::filesystem::path folder;
  std::filesystem::path out;
  SelectionFlags selection;
  RunFlags run;
};

void RunBench(const BenchFlags& flags) {
  const SequenceReader reader(flags.folder);
  BenchmarkOptions options;
  options.frames = ParseFrames(flags.selection.frames);
  options.lenses = flags.selection.lenses;
  if (!flags.selection.cameras.empty()) {
    if (flags.selection.cameras.size() != 2) {
      throw InputError("--cameras: expected a pair, got {} cameras",
                       flags.selection.cameras.size());
    }
    options.cameras = {flags.selection.cameras[0], flags.selection.cameras[1]};
  }
  options.num_threads = flags.run.num_threads;
  options.quiet = flags.run.quiet;
  const BenchmarkResults results = RunBenchmark(reader, options);
  WriteBenchmark(results, reader, flags.out);
  fmt::print("{}results in {}\n", BenchmarkTable(results), flags.out.string());
}

}  // namespace

void AddBenchCommand(CLI::App& app) {
  auto flags = std::make_shared<BenchFlags>();
  CLI::App* command = app.add_subcommand("bench", "Measures features on pairs of views");
  command->footer(kFooter);
  command->add_option("DIR", flags->folder, "Folder of a sequence")->required();
  command->add_option("--out", flags->out, "Folder of the results")->required();
  AddSelectionFlags(*command, flags->selection);
  AddRunFlags(*command, flags->run);
  command->callback([flags] { RunBench(*flags); });
}

}  // namespace pfseq
