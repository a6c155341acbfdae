// SPDX-License-Identifier: Apache-2.0
// What the report shows of the sequence itself: views with key points and matches, ground truth in
// colour, the drive from above, and where in the image matches fail.
#pragma once

#include "validator/report/match_failures.h"
#include "validator/report/result_set.h"

#include <array>
#include <string>
#include <vector>

namespace pfseq {

struct ReportPicture {
  size_t case_idx = 0;
  std::string title;
  std::string caption;
  /// JPEG or PNG as a data: address.
  std::string source;
  int width_px = 0;
  int height_px = 0;
};

/// A view of the drive from above, world coordinates in metres.
struct DrivePoint {
  int frame = 0;
  double x_m = 0.0;
  double y_m = 0.0;
};
struct DriveMark {
  std::string label;
  double x_m = 0.0;
  double y_m = 0.0;
};
struct DrivePath {
  size_t source_idx = 0;
  std::vector<DrivePoint> path;
  /// The cameras of the cases.
  std::vector<DriveMark> marks;
};

struct SequencePictures {
  std::vector<ReportPicture> pictures;
  std::vector<FailureTable> failures;
  std::vector<DrivePath> drives;
  /// Why something is missing, a line each.
  std::vector<std::string> remarks;
};

/// More cases than these have no pictures.
inline constexpr size_t kMaxPictureCases = 4;

/// Measures `setups` (names of triplets) once more, on the first kMaxPictureCases cases of each
/// sequence whose folder is known, and draws what they do. What cannot be shown gets a remark.
SequencePictures MakeSequencePictures(const ResultSet& results,
                                      const std::vector<std::string>& setups,
                                      int num_threads,
                                      bool quiet);

}  // namespace pfseq
