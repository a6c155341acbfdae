// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/sequence/image_io.h"
#include "renderer/sequence/layout.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

/// What to do with a folder that already holds a sequence.
enum class OnExisting {
  kRefuse,     ///< InputError
  kResume,     ///< go on, when it was made from the same description; InputError otherwise
  kOverwrite,  ///< remove the sequence's files first
};

/// A file of the description, written before the first frame.
struct DescriptionFile {
  std::string name;
  std::string bytes;
};

/// A sequence's folder being filled. Each file is written under a temporary name and renamed;
/// manifest.json, which says that the sequence is complete, is taken away at the start and written
/// last.
class SequenceWriter {
 public:
  /// Makes the folder and writes the description's files. With kResume, those that are there
  /// already must have the very same bytes: InputError names the file that differs. A folder that
  /// holds other things than a sequence is refused. Files that `sibling`, another sequence's folder
  /// or empty, has with the same bytes are linked to (copied where the disk has no links).
  SequenceWriter(std::filesystem::path folder,
                 const std::vector<DescriptionFile>& description,
                 OnExisting on_existing,
                 std::filesystem::path sibling = {});

  /// True when the file is there already, from a run that is being resumed.
  bool Has(const FrameFile& file) const;

  void WriteFrameFile(const FrameFile& file, const Bytes& bytes) const;

  /// Takes the sibling's file, unless the sibling has none or the file is there already.
  void LinkFrameFile(const FrameFile& file) const;

  /// When all expected files are there: removes what killed runs left under temporary names, writes
  /// the manifest over all files of the folder, and returns true.
  bool FinishIfComplete(const std::vector<FrameFile>& expected, int num_threads) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path sibling_;
};

}  // namespace pfseq
