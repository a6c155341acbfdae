// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "tools/commands.h"
#include "tools/common_options.h"
#include "validator/report/report.h"

#include <memory>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kFooter = R"(
RESULTS are folders that `pfseq bench` wrote. Writes
  report.html   one page that works offline: verdict, curves, tables, pictures, and what became of the conclusions of 2014
  tables/       the settings that are best somewhere, as CSV and LaTeX (booktabs); pdflatex all.tex prints them all
  figures/      their curves, as gnuplot scripts and, where there is gnuplot, SVG and PNG

Pictures need the sequence: bench notes where it lies; --sequence tells another place.

Examples:
  pfseq report out/paper --out out/report
  pfseq report out/clear out/evening --out out/light
  pfseq report out/paper --out out/report --sequence /data/pfseq
  pfseq report out/paper --out out/report --no-pictures)";

}  // namespace

void AddReportCommand(CLI::App& app) {
  struct Flags {
    ReportOptions options;
    bool no_pictures = false;
    RunFlags run;
  };
  auto flags = std::make_shared<Flags>();
  CLI::App* command = app.add_subcommand("report", "Makes a page, tables and figures of results");
  command->footer(kFooter);
  command->add_option("RESULTS", flags->options.results, "Folders that pfseq bench wrote");
  command->add_option("--out", flags->options.out, "Folder of the report");
  command
      ->add_option("--sequence",
                   flags->options.sequences,
                   "Folder of the sequence: one for all RESULTS or, separated by commas, one each")
      ->delimiter(',');
  command->add_flag(
      "--no-pictures", flags->no_pictures, "Leaves pictures out, which need the sequence");
  AddRunFlags(*command, flags->run);
  command->callback([flags] {
    ReportOptions& options = flags->options;
    if (options.results.empty() || options.out.empty()) {
      throw InputError("report: expected RESULTS and --out DIR");
    }
    options.has_pictures = !flags->no_pictures;
    options.num_threads = flags->run.num_threads;
    options.quiet = flags->run.quiet;
    options.command = CommandLine();
    const ReportSummary summary = WriteReport(options);
    for (const std::string& remark : summary.remarks) {
      fmt::print("{}\n", remark);
    }
    if (!summary.has_figures) {
      fmt::print("gnuplot is missing: figures/ has scripts without drawings\n");
    }
    fmt::print("{} tables; report in {}\n", summary.num_tables, summary.page.string());
  });
}

}  // namespace pfseq
