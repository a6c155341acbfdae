// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace pfseq {

/// manifest.json: size and SHA-256 of each file of a sequence. It is written last: its presence
/// means that the sequence is complete.
struct Manifest {
  struct Entry {
    uint64_t size_bytes = 0;
    std::string sha256;
  };
  /// By path relative to the sequence's folder, with forward slashes.
  std::map<std::string, Entry> files;

  /// Sizes and hashes of all files of the sequence in `folder` (those whose names layout.h knows).
  static Manifest OfFolder(const std::filesystem::path& folder, int num_threads);

  /// InputError when it is missing or not a manifest.
  static Manifest Read(const std::filesystem::path& folder);
  void Write(const std::filesystem::path& folder) const;
};

}  // namespace pfseq
