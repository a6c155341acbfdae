// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "tools/commands.h"
#include "validator/view/view_server.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kFooter = R"(
Opens a page on this machine alone (127.0.0.1): all channels of a frame beside each other, a slider over the frames, and
for a clicked pixel its ray, distance, point in the world and place in the other camera. Ctrl-C ends it.

Examples:
  pfseq view out/pfseq
  pfseq view out/pfseq --port 0        takes a free port and tells which)";

}  // namespace

void AddViewCommand(CLI::App& app) {
  struct Flags {
    std::filesystem::path folder;
    int port = 8047;
  };
  auto flags = std::make_shared<Flags>();
  CLI::App* command = app.add_subcommand("view", "Shows a sequence in a local page");
  command->footer(kFooter);
  command->add_option("DIR", flags->folder, "Folder of a sequence");
  command->add_option("--port", flags->port, "Port on the loopback; 0: any free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->callback([flags] {
    if (flags->folder.empty()) {
      throw InputError("view: expected DIR, the folder of a sequence");
    }
    ServeSequence(flags->folder, flags->port, [&](const std::string& address) {
      fmt::print("{} at {} (Ctrl-C ends)\n", flags->folder.string(), address);
      std::fflush(stdout);
    });
  });
}

}  // namespace pfseq
