// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/checks/check_context.h"
#include "validator/checks/check_report.h"

#include <filesystem>

namespace pfseq {

/// Each file of manifest.json is there with its size and SHA-256, and no file is there that it
/// lacks. A file with the content of another one is told as such: swapped files.
void CheckManifest(const std::filesystem::path& folder,
                   const CheckOptions& options,
                   CheckReport& report);

}  // namespace pfseq
