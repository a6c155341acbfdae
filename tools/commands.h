// SPDX-License-Identifier: Apache-2.0
// The subcommands of pfseq: each adds itself to the command line and runs from its callback. A
// callback throws InputError or SystemError; main turns them into one line and an exit status.
#pragma once

#include <CLI/CLI.hpp>

namespace pfseq {

/// Exit status of a command that ran well but found faults (pfseq check).
inline constexpr int kExitFaultsFound = 1;

void AddRenderCommand(CLI::App& app);
/// `exit_status` is set when the sequence has faults.
void AddCheckCommand(CLI::App& app, int& exit_status);
void AddSceneCommand(CLI::App& app);
void AddLensCommand(CLI::App& app);
void AddBenchCommand(CLI::App& app);
void AddReportCommand(CLI::App& app);
void AddViewCommand(CLI::App& app);
void AddStudyCommand(CLI::App& app);
void AddKeysCommand(CLI::App& app);

}  // namespace pfseq
