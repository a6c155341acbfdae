// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/manifest_check.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parallel.h"
#include "renderer/core/progress.h"
#include "renderer/sequence/layout.h"
#include "renderer/sequence/manifest.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace pfseq {
namespace {

using NamedEntry = std::pair<std::string, Manifest::Entry>;

/// What is wrong with a listed file; nothing when it is as listed.
std::optional<std::string> FaultOf(const std::filesystem::path& path,
                                   const NamedEntry& listed,
                                   const std::map<std::string, std::string>& name_by_sha256) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return FrameFile::FromRelativePath(listed.first) ? "missing frame file" : "missing";
  }
  try {
    const uint64_t size_bytes = std::filesystem::file_size(path);
    const std::string sha256 = Sha256HexOfFile(path);
    if (sha256 == listed.second.sha256 && size_bytes == listed.second.size_bytes) {
      return std::nullopt;
    }
    const auto other = name_by_sha256.find(sha256);
    if (other != name_by_sha256.end() && other->second != listed.first) {
      return fmt::format("has the content of {}: swapped?", other->second);
    }
    if (size_bytes != listed.second.size_bytes) {
      return fmt::format(
          "{} bytes, {} in the manifest: {}",
          size_bytes,
          listed.second.size_bytes,
          size_bytes < listed.second.size_bytes ? "truncated or replaced" : "replaced");
    }
    return "its SHA-256 is not that of the manifest: changed after rendering";
  } catch (const InputError& fault) {
    return WithoutPath(fault.what(), path);
  } catch (const std::filesystem::filesystem_error& fault) {
    return fault.code().message();
  }
}

void CheckListedFiles(const std::filesystem::path& folder,
                      const Manifest& manifest,
                      const CheckOptions& options,
                      CheckReport& report) {
  const std::vector<NamedEntry> listed(manifest.files.begin(), manifest.files.end());
  std::map<std::string, std::string> name_by_sha256;
  for (const auto& [name, entry] : listed) {
    name_by_sha256.emplace(entry.sha256, name);
  }
  std::vector<std::optional<std::string>> faults(listed.size());
  Progress progress("files", listed.size(), options.quiet);
  ParallelFor(listed.size(), options.num_threads, [&](size_t i) {
    faults[i] = FaultOf(folder / listed[i].first, listed[i], name_by_sha256);
    progress.Advance();
  });
  progress.Finish();
  for (size_t i = 0; i < listed.size(); ++i) {
    if (faults[i]) {
      report.AddFault(listed[i].first, *faults[i]);
    }
  }
  report.num_files_hashed = listed.size();
}

/// Tells files that should not be there; `manifest` may be absent.
void CheckOtherFiles(const std::filesystem::path& folder,
                     const Manifest* manifest,
                     CheckReport& report) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      names.push_back(entry.path().lexically_relative(folder).generic_string());
    }
  }
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    if (name == kManifestFile || (manifest != nullptr && manifest->files.contains(name))) {
      continue;
    }
    if (name.ends_with(kPartialSuffix)) {
      report.AddNote(name, "left by a run that was stopped: can be deleted");
    } else if (!BelongsToSequence(name)) {
      report.AddNote(name, "not a file of a sequence");
    } else if (manifest != nullptr) {
      report.AddFault(name, "not in the manifest: added after rendering");
    }
  }
}

}  // namespace

void CheckManifest(const std::filesystem::path& folder,
                   const CheckOptions& options,
                   CheckReport& report) {
  const std::string manifest_name(kManifestFile);
  std::optional<Manifest> manifest;
  if (!std::filesystem::exists(folder / manifest_name)) {
    report.AddFault(manifest_name, "missing: the sequence is unfinished, resume the rendering");
  } else {
    try {
      manifest = Manifest::Read(folder);
      CheckListedFiles(folder, *manifest, options, report);
    } catch (const InputError& fault) {
      report.AddFault(manifest_name, WithoutPath(fault.what(), folder / manifest_name));
    }
  }
  CheckOtherFiles(folder, manifest ? &*manifest : nullptr, report);
}

}  // namespace pfseq
