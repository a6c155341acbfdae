// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sequence_schema.h"
#include "tools/commands.h"

#include <fmt/format.h>

namespace pfseq {

void AddKeysCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("keys", "Lists what can be set in a SEQUENCE.yaml and with --set");
  command->footer("\nExamples:\n  pfseq keys\n  pfseq keys | grep sky");
  command->callback([] { fmt::print("{}", SchemaHelp()); });
}

}  // namespace pfseq
