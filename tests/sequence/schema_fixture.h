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

#include <fmt/format.h>
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

  /// Expects a key to take numbers in [least, most], up to the ends, and to refuse the next ones in
  /// a line that names it.
  void ExpectRange(const std::string& key, double least, double most) {
    ExpectEnds(key,
               {least, most},
               {least - kBeyond, most + kBeyond},
               fmt::format("a number from {} to {}", least, most));
  }

  /// The same of numbers in (0, most]; `others` are overrides of other keys that go with them.
  void ExpectAbove0(const std::string& key,
                    double most,
                    const std::vector<std::string>& others = {}) {
    ExpectEnds(key,
               {kBeyond, most},
               {0.0, most + kBeyond},
               fmt::format("a number > 0 and <= {}", most),
               others);
  }

  /// The same of whole numbers in [least, most].
  void ExpectWholeRange(const std::string& key, double least, double most) {
    ExpectEnds(key,
               {least, most},
               {least - 1.0, most + 1.0, least + 0.5},
               fmt::format("a whole number from {} to {}", least, most));
  }

  static constexpr double kBeyond = 1e-6;

  void ExpectEnds(const std::string& key,
                  const std::vector<double>& taken,
                  const std::vector<double>& refused,
                  const std::string& expected,
                  const std::vector<std::string>& others = {}) {
    std::vector<SequenceSpec> specs;
    for (const double value : taken) {
      std::vector<std::string> overrides = others;
      overrides.push_back(fmt::format("{}={}", key, value));
      specs.push_back(Read(kSmall, overrides));
      EXPECT_EQ(Read(CanonicalYaml(specs.back())), specs.back()) << overrides.back();
    }
    EXPECT_NE(specs.front(), specs.back()) << key;
    for (const double value : refused) {
      std::vector<std::string> overrides = others;
      overrides.push_back(fmt::format("{}={}", key, value));
      EXPECT_EQ(ErrorOf(kSmall, overrides),
                fmt::format("--set {}: expected {}, got {}", overrides.back(), expected, value));
    }
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_.Path() / "demo.yaml";
};

}  // namespace pfseq
