// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sequence_writer.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/manifest.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <system_error>
#include <utility>

namespace pfseq {
namespace {

bool IsPartial(const std::filesystem::path& path) {
  return path.filename().string().ends_with(kPartialSuffix);
}

/// True when the process that writes this temporary file is gone (its number is part of the name).
bool IsAbandoned(const std::filesystem::path& partial) {
  const std::string stem = partial.stem().string();
  const size_t dot = stem.rfind('.');
  pid_t pid = 0;
  if (dot == std::string::npos ||
      std::from_chars(stem.data() + dot + 1, stem.data() + stem.size(), pid).ec != std::errc()) {
    return false;
  }
  return kill(pid, 0) != 0 && errno == ESRCH;
}

void RemoveAbandonedPartials(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> partials;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && IsPartial(entry.path()) && IsAbandoned(entry.path())) {
      partials.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& partial : partials) {
    std::filesystem::remove(partial);
  }
}

/// The number of the first line that differs, from 1.
size_t FirstDifferentLine(const std::string& a, const std::string& b) {
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  return 1 + static_cast<size_t>(std::count(a.begin(), in_a, '\n'));
}

void RemoveSequence(const std::filesystem::path& folder) {
  // The manifest goes first: without it nobody takes the rest for complete.
  std::filesystem::remove(folder / kManifestFile);
  for (const std::filesystem::path& file : SequenceFiles(folder)) {
    std::filesystem::remove(folder / file);
  }
  RemoveAbandonedPartials(folder);
}

void ExpectSameIfPresent(const std::filesystem::path& folder, const DescriptionFile& file) {
  const std::filesystem::path path = folder / file.name;
  if (!std::filesystem::exists(path)) {
    return;
  }
  const std::string existing = ReadFile(path);
  if (existing != file.bytes) {
    const bool is_text = path.extension() != ".glb";
    throw InputError(
        "{}: was made from another description{}; --overwrite replaces the sequence",
        path.string(),
        is_text ? fmt::format(" (line {} differs)", FirstDifferentLine(existing, file.bytes)) : "");
  }
}

/// Whole or not at all, like a file that is written.
void LinkOrCopy(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::create_directories(to.parent_path(), error);
  std::filesystem::create_hard_link(from, to, error);
  if (error && error != std::errc::file_exists) {
    WriteFileAtomically(to, ReadFile(from));
  }
}

}  // namespace

SequenceWriter::SequenceWriter(std::filesystem::path folder,
                               const std::vector<DescriptionFile>& description,
                               OnExisting on_existing,
                               std::filesystem::path sibling)
    : folder_(std::move(folder)), sibling_(std::move(sibling)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) {
    throw SystemError("cannot make folder {}: {}", folder_.string(), error.message());
  }
  const bool holds_sequence = std::filesystem::exists(folder_ / kSequenceFile);
  if (!holds_sequence) {
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      if (!IsPartial(entry.path())) {
        throw InputError("{}: the folder holds other things than a sequence ({})",
                         folder_.string(),
                         entry.path().filename().string());
      }
    }
  } else if (on_existing == OnExisting::kRefuse) {
    throw InputError(
        "{}: already holds a sequence; --resume goes on with it, --overwrite replaces it",
        folder_.string());
  } else if (on_existing == OnExisting::kOverwrite) {
    RemoveSequence(folder_);
  }
  // All is compared before anything is written or taken away.
  for (const DescriptionFile& file : description) {
    ExpectSameIfPresent(folder_, file);
  }
  for (const DescriptionFile& file : description) {
    if (std::filesystem::exists(folder_ / file.name)) {
      continue;
    }
    const std::filesystem::path same = sibling_ / file.name;
    if (!sibling_.empty() && std::filesystem::exists(same) && ReadFile(same) == file.bytes) {
      LinkOrCopy(same, folder_ / file.name);
    } else {
      WriteFileAtomically(folder_ / file.name, file.bytes);
    }
  }
  std::filesystem::remove(folder_ / kManifestFile);
}

bool SequenceWriter::Has(const FrameFile& file) const {
  return std::filesystem::exists(folder_ / file.RelativePath());
}

void SequenceWriter::WriteFrameFile(const FrameFile& file, const Bytes& bytes) const {
  WriteFileAtomically(folder_ / file.RelativePath(), bytes);
}

void SequenceWriter::LinkFrameFile(const FrameFile& file) const {
  const std::filesystem::path from = sibling_ / file.RelativePath();
  if (!sibling_.empty() && !Has(file) && std::filesystem::exists(from)) {
    LinkOrCopy(from, folder_ / file.RelativePath());
  }
}

bool SequenceWriter::FinishIfComplete(const std::vector<FrameFile>& expected,
                                      int num_threads) const {
  if (!std::all_of(
          expected.begin(), expected.end(), [this](const FrameFile& file) { return Has(file); })) {
    return false;
  }
  RemoveAbandonedPartials(folder_);
  Manifest::OfFolder(folder_, num_threads).Write(folder_);
  return true;
}

}  // namespace pfseq
