// SPDX-License-Identifier: Apache-2.0
#include "tools/commands.h"
#include "tools/common_options.h"
#include "validator/checks/check_sequence.h"

#include <memory>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kFooter = R"(
Verifies the manifest's checksums, images, poses, distance maps against scene.glb, and that the cameras' distance maps
agree in 3D where two of them see the same surface. Exit status 1 when there are faults.

Examples:
  pfseq check out/pfseq
  pfseq check out/pfseq --stride 1        every pixel against the scene)";

struct CheckFlags {
  std::filesystem::path folder;
  CheckOptions options;
  RunFlags run;
};

}  // namespace

void AddCheckCommand(CLI::App& app, int& exit_status) {
  auto flags = std::make_shared<CheckFlags>();
  CLI::App* command = app.add_subcommand("check", "Verifies a sequence's folder");
  command->footer(kFooter);
  command->add_option("DIR", flags->folder, "Folder of a sequence")->required();
  constexpr int kMaxStride = 1000;
  command
      ->add_option("--stride",
                   flags->options.stride_px,
                   "Compare each n-th pixel in x and y with the scene and the other cameras; 0: by "
                   "the image's size")
      ->check(CLI::Range(0, kMaxStride))
      ->capture_default_str();
  AddRunFlags(*command, flags->run);
  command->callback([flags, &exit_status] {
    flags->options.num_threads = flags->run.num_threads;
    flags->options.quiet = flags->run.quiet;
    const CheckReport report = CheckSequence(flags->folder, flags->options);
    fmt::print("{}", report.Text());
    exit_status = report.NumFaults() > 0 ? kExitFaultsFound : 0;
  });
}

}  // namespace pfseq
