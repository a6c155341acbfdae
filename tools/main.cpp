// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "tools/commands.h"

#include <cstdio>
#include <exception>

#include <fmt/format.h>

namespace {

constexpr int kExitWorldFailed = 1;
constexpr int kExitBadInput = 2;

constexpr const char* kFooter = R"(
Examples:
  pfseq render data/sequences/pfseq.yaml --out out/pfseq --frames 0,24,40
  pfseq check out/pfseq
  pfseq bench out/pfseq --out out/pfseq_bench
  pfseq report out/pfseq_bench --out out/report
  pfseq study data/studies/blur.yaml --out out/blur
  pfseq view out/pfseq
  pfseq keys                      what can be set in a SEQUENCE.yaml and with --set
  pfseq COMMAND --help            flags and examples of one command

Exit status: 0 well, 1 the machine failed or `check` found faults, 2 wrong input.)";

int Run(int argc, char** argv) {
  CLI::App app(
      "pfseq makes fisheye sequences with exact ground truth and measures features on them.",
      "pfseq");
  app.footer(kFooter);
  app.set_version_flag("--version", "pfseq " PFSEQ_VERSION);
  app.require_subcommand(1);
  int exit_status = 0;
  pfseq::AddRenderCommand(app);
  pfseq::AddCheckCommand(app, exit_status);
  pfseq::AddSceneCommand(app);
  pfseq::AddLensCommand(app);
  pfseq::AddBenchCommand(app);
  pfseq::AddReportCommand(app);
  pfseq::AddStudyCommand(app);
  pfseq::AddViewCommand(app);
  pfseq::AddKeysCommand(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_help = error.get_exit_code() == 0;
    app.exit(error);
    return is_help ? 0 : kExitBadInput;
  }
  return exit_status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return Run(argc, argv);
  } catch (const pfseq::InputError& error) {
    fmt::print(stderr, "pfseq: {}\n", error.what());
    return kExitBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "pfseq: {}\n", error.what());
    return kExitWorldFailed;
  }
}
