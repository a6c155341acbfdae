// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "tools/commands.h"
#include "tools/common_options.h"
#include "tools/study_runner.h"
#include "validator/study/study_report.h"

#include <memory>
#include <tuple>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kFooter = R"(
STUDY.yaml names a base sequence, factors with their values, a grid of features, pairs and repetitions
(validator/study/study_spec.h tells its form; data/studies has some). Each variant is rendered and measured once; scene,
light, distance and sky are shared where they agree. Writes
  study.yaml          the study with its defaults; pfseq study runs it again
  variants/NAME/      sequence (as pfseq render) and bench (as pfseq bench) of each variant
  report/             study.html, one page that works offline; tables (CSV, LaTeX) and figures (SVG, PNG)

A stopped study goes on with --resume. With --shard I/N several programs or machines share the work of one DIR; the last
one to finish, or a run with --resume, makes the report.

Examples:
  pfseq study data/studies/blur.yaml --list
  pfseq study data/studies/blur.yaml --out out/blur
  pfseq study data/studies/lens.yaml --out out/lens --shard 0/4)";

struct StudyFlags {
  std::filesystem::path path;
  bool is_list = false;
  std::string shard = "0/1";
  LightFlags light;
  RunFlags run;
  StudyRunOptions options;
};

void RunStudy(StudyFlags& flags) {
  if (flags.path.empty()) {
    throw InputError("study: expected STUDY.yaml");
  }
  const StudySpec study = ReadStudy(flags.path);
  const std::vector<StudyVariant> variants = PlanVariants(study);
  StudyRunOptions& options = flags.options;
  std::tie(options.shard, options.num_shards) = ParseShard(flags.shard);
  options.resume |= options.num_shards > 1;
  options.num_threads = flags.run.num_threads;
  options.quiet = flags.run.quiet;
  options.light_cache = flags.light.Options();
  if (options.out.empty() && !flags.is_list) {
    throw InputError("study: expected --out DIR (or --list)");
  }
  StudyRunner runner(study, variants, options);
  fmt::print("{}\nforecast: {}\n", PlanSummary(study, variants.size()), runner.Forecast().Text());
  if (flags.is_list) {
    for (const StudyVariant& variant : variants) {
      const bool is_done = !options.out.empty() && IsMeasured(options.out, variant);
      fmt::print("{}{}\n", variant.name, is_done ? "  (done)" : "");
    }
    return;
  }
  std::fflush(stdout);
  if (!runner.Run()) {
    fmt::print("shard {} done; other variants are missing: run once more with --resume\n",
               flags.shard);
    return;
  }
  StudyReportOptions report;
  report.out = options.out / "report";
  report.command = CommandLine();
  for (const StudyVariant& variant : variants) {
    report.folders.push_back(VariantFolder(options.out, variant));
  }
  const ReportSummary summary = WriteStudyReport(study, variants, report);
  for (const std::string& remark : summary.remarks) {
    fmt::print("{}\n", remark);
  }
  fmt::print("report in {}\n", summary.page.string());
}

}  // namespace

void AddStudyCommand(CLI::App& app) {
  auto flags = std::make_shared<StudyFlags>();
  CLI::App* command = app.add_subcommand(
      "study", "Turns knobs of a sequence and measures what features make of it");
  command->footer(kFooter);
  command->add_option("STUDY.yaml", flags->path, "Description of the study");
  command->add_option("--out", flags->options.out, "Folder of the study");
  command->add_flag(
      "--list,--dry-run", flags->is_list, "Only tells the variants and how long they will take");
  command->add_flag("--resume", flags->options.resume, "Goes on with the study that is there");
  command
      ->add_option("--shard",
                   flags->shard,
                   "I/N: a share of the variants, all shards into one DIR; implies --resume")
      ->capture_default_str();
  AddLightFlags(*command, flags->light);
  AddRunFlags(*command, flags->run);
  command->callback([flags] { RunStudy(*flags); });
}

}  // namespace pfseq
