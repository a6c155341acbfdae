// SPDX-License-Identifier: Apache-2.0
// What a check of a sequence finds and measures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

enum class Severity {
  kFault,  ///< the sequence is not what it says it is
  kNote,   ///< worth knowing, nothing is wrong
};

struct Finding {
  Severity severity = Severity::kFault;
  /// Relative to the sequence's folder.
  std::string file;
  /// One line.
  std::string text;
};

/// How well the distance maps of one camera agree with another's, through one lens. Counts are of
/// pixels of `from_camera`.
struct PairAgreement {
  std::string lens;
  std::string from_camera;
  std::string to_camera;
  /// -1: all frames.
  int frame = -1;
  /// Finite distance; each is one of the next five.
  size_t num_sampled = 0;
  size_t num_outside = 0;    ///< the point lies outside the other's image circle
  size_t num_occluded = 0;   ///< something stands between the other camera and the point
  size_t num_no_common = 0;  ///< no pixel of the other camera near it shows the same plane
  size_t num_agreeing = 0;
  size_t num_disagreeing = 0;
  /// Distance between the maps' surfaces along the normal; of all compared, accurate to 3 %.
  double median_gap_m = 0.0;
  double percentile_99_gap_m = 0.0;

  size_t NumCompared() const { return num_agreeing + num_disagreeing; }
  /// Of those compared; 1 when there are none.
  double AgreeingShare() const;
};

struct CheckReport {
  std::vector<Finding> findings;

  size_t num_files_hashed = 0;
  size_t num_images = 0;
  size_t num_poses = 0;
  size_t num_maps_recast = 0;
  size_t num_pixels_recast = 0;
  /// Largest relative difference between a map and the scene among the pixels that agree.
  double max_relative_error = 0.0;
  /// Per lens, direction and frame.
  std::vector<PairAgreement> pairs;
  /// The same over all frames.
  std::vector<PairAgreement> pair_totals;

  void AddFault(std::string file, std::string text);
  void AddNote(std::string file, std::string text);
  void Add(const std::vector<Finding>& more);
  size_t NumFaults() const;

  /// One line a finding (faults first), then the measured numbers as a table and the verdict.
  std::string Text() const;
};

/// The text of an error about `path` without the path itself, which a finding names already.
std::string WithoutPath(const std::string& error_text, const std::filesystem::path& path);

}  // namespace pfseq
