// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/completeness_check.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// Why the sequence cannot have such a file; nothing when it can.
std::optional<std::string> Stranger(const SequenceReader& reader, const FrameFile& file) {
  const auto is_one_of = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (!is_one_of(reader.Lenses(), file.lens)) {
    return fmt::format("{} has no lens '{}'", kRigFile, file.lens);
  }
  if (!is_one_of(reader.Cameras(), file.camera)) {
    return fmt::format("{} has no camera '{}'", kRigFile, file.camera);
  }
  if (static_cast<size_t>(file.frame) >= reader.Poses().size()) {
    return fmt::format("{} has no frame {}", kPosesFile, file.frame);
  }
  return std::nullopt;
}

void NoteGaps(const std::vector<CheckedView>& views, CheckReport& report) {
  // What a frame has, as the path that it would have for frame 0.
  std::map<int, std::set<std::string>> files_by_frame;
  std::set<std::string> all_files;
  for (const CheckedView& view : views) {
    for (const Output output : view.outputs) {
      const std::string kind = fmt::format("{}/{}/{}", view.lens, view.camera, OutputName(output));
      files_by_frame[view.frame].insert(kind);
      all_files.insert(kind);
    }
  }
  for (const auto& [frame, files] : files_by_frame) {
    for (const std::string& kind : all_files) {
      if (!files.contains(kind)) {
        report.AddNote(kind, fmt::format("frame {} is not there, but its other files are", frame));
      }
    }
  }
}

}  // namespace

std::vector<CheckedView> CheckCompleteness(const SequenceReader& reader, CheckReport& report) {
  std::map<std::tuple<std::string, std::string, int>, CheckedView> views;
  for (const std::filesystem::path& path : SequenceFiles(reader.Folder())) {
    const std::optional<FrameFile> file = FrameFile::FromRelativePath(path);
    if (!file) {
      continue;
    }
    if (const std::optional<std::string> reason = Stranger(reader, *file)) {
      report.AddFault(path.generic_string(), *reason);
      continue;
    }
    CheckedView& view = views[{file->lens, file->camera, file->frame}];
    view.lens = file->lens;
    view.camera = file->camera;
    view.frame = file->frame;
    view.outputs.insert(file->output);
  }
  std::vector<CheckedView> sorted;
  for (const auto& [key, view] : views) {
    sorted.push_back(view);
  }
  if (sorted.empty()) {
    report.AddNote(".", "no frames at all");
  }
  NoteGaps(sorted, report);
  return sorted;
}

}  // namespace pfseq
