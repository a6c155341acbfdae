// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/manifest.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parallel.h"
#include "renderer/sequence/layout.h"

#include <vector>

#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

constexpr const char* kFormat = "pfseq sequence 1";

}  // namespace

Manifest Manifest::OfFolder(const std::filesystem::path& folder, int num_threads) {
  const std::vector<std::filesystem::path> paths = SequenceFiles(folder);
  std::vector<Entry> entries(paths.size());
  ParallelFor(paths.size(), num_threads, [&](size_t i) {
    entries[i] = {std::filesystem::file_size(folder / paths[i]),
                  Sha256HexOfFile(folder / paths[i])};
  });
  Manifest manifest;
  for (size_t i = 0; i < paths.size(); ++i) {
    manifest.files[paths[i].generic_string()] = entries[i];
  }
  return manifest;
}

Manifest Manifest::Read(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kManifestFile;
  const std::string text = ReadFile(path);
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.at("format") != kFormat) {
      throw InputError("{}: format: expected '{}'", path.string(), kFormat);
    }
    Manifest manifest;
    for (const auto& [name, entry] : json.at("files").items()) {
      manifest.files[name] = {entry.at("size_bytes").get<uint64_t>(),
                              entry.at("sha256").get<std::string>()};
    }
    return manifest;
  } catch (const nlohmann::json::exception& error) {
    throw InputError("{}: expected a manifest: {}", path.string(), error.what());
  }
}

void Manifest::Write(const std::filesystem::path& folder) const {
  nlohmann::ordered_json json;
  json["format"] = kFormat;
  json["files"] = nlohmann::ordered_json::object();
  for (const auto& [name, entry] : files) {
    json["files"][name] = {{"size_bytes", entry.size_bytes}, {"sha256", entry.sha256}};
  }
  WriteFileAtomically(folder / kManifestFile, json.dump(2) + "\n");
}

}  // namespace pfseq
