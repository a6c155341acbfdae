// SPDX-License-Identifier: Apache-2.0
// What the tests of the schema's parts share.
#pragma once

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/sequence_schema.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {

inline const std::filesystem::path kData = std::filesystem::path(PFSEQ_SOURCE_DIR) / "data";

/// The least that a description needs.
inline constexpr char kSmall[] =
    "lenses:\n"
    "  fish: {circle_px: 90}\n"
    "rig:\n"
    "  cameras:\n"
    "    front: {}\n";

/// Reads descriptions from a folder of its own.
class SchemaTest : public testing::Test {
 protected:
  SequenceSpec Read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    WriteFileAtomically(path_, text);
    return ReadSequenceSpec(path_, overrides);
  }

  /// The message, without the folder of the file.
  std::string ErrorOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const std::string message = MessageOf<InputError>([&] { Read(text, overrides); });
    const std::string folder = folder_.Path().string() + "/";
    return message.find(folder) == 0 ? message.substr(folder.size()) : message;
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_.Path() / "demo.yaml";
};

}  // namespace pfseq
