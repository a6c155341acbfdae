// SPDX-License-Identifier: Apache-2.0
// Which settings a benchmark measures: a YAML file that lists values, expanded to all combinations.
//
//   detectors:              each with all combinations of the values listed
//     - algorithm: SIFT
//       polar: [false, true]                default: false
//       contrastThreshold: [0.02, 0.04]     a value or a list; "auto" where a parameter has it
//   descriptors:
//     - algorithm: FREAK
//       patternScale: [22, 44]
//   matchers:
//     - algorithm: BruteForce
//   settings:               single settings by name, besides the combinations; where detectors are
//                           named by themselves, those of triplets alone are not reported
//     - SIFT nopol 0.04 5.0 1.6
//     - SIFT nopol 0.04 5.0 1.6 FREAK 44.0 BruteForce
//   imported:               features made elsewhere, see imported_features.h
//     - name: SuperPoint
//       files: features/{lens}/{camera}/{frame}.npz
//       norm: L2
//   best: [500, 1000]       metrics with the N strongest key points, too
//   angles_deg: [0.1, 0.5]  angular tolerances besides the distances
//
// Combinations leave out what does not exist: FLANN with binary descriptors, AKAZE's descriptor on
// other points, and, as in the report of 2014, BRISK descriptors of another patternScale on BRISK
// points.
#pragma once

#include "renderer/sequence/yaml_value.h"
#include "validator/grid/setting.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

/// Features made elsewhere, read from files.
struct ImportedSetting {
  /// Takes the detector's and the descriptor's place in names.
  std::string name;
  /// Path with {lens}, {camera}, {variant} and {frame} (or {frame:06}); .npz or .csv.
  std::string files;
  Norm norm = Norm::kL2;
  /// Where (0, 0) lies: the image's outer corner, or the first pixel's centre (OpenCV).
  bool origin_is_pixel_centre = false;
  /// Path of matches of a pair with {lens}, {first_camera}, {first_frame}, {second_camera},
  /// {second_frame}; empty: none. They go under the matcher's name "Imported".
  std::string matches;

  bool operator==(const ImportedSetting&) const = default;
};

/// One way to key points, with all that is built on it.
struct GridDetector {
  DetectorSetting detector;
  /// Whether its own metrics (repeatability, ...) are asked for, not just its triplets'.
  bool is_reported = true;
  /// Descriptors in order of the grid, each with its matchers.
  struct GridDescriptor {
    Setting descriptor;
    std::vector<Setting> matchers;
  };
  std::vector<GridDescriptor> descriptors;
};

struct Grid {
  std::vector<GridDetector> detectors;
  std::vector<ImportedSetting> imported;
  /// Of imported features; those that fit the norm.
  std::vector<Setting> imported_matchers;
  std::vector<int> best;
  std::vector<double> angles_deg;

  /// "SIFT nopol 0.04 5.0 1.6", in the order of the grid; imported ones last.
  std::vector<std::string> DetectorNames() const;
  std::vector<std::string> TripletNames() const;

  /// InputError with file, line and key.
  static Grid Read(const std::filesystem::path& path);
  static Grid FromYaml(const std::string& text,
                       const std::string& origin,
                       const std::filesystem::path& folder);
  /// Of a mapping that stands in another file.
  static Grid FromTree(const YamlValue& root);
  /// A grid of single settings.
  static Grid FromNames(const std::vector<std::string>& names);
};

std::string TripletName(const DetectorSetting& detector,
                        const Setting& descriptor,
                        const Setting& matcher);

/// "SIFT 27 (54 with polar) ..." : how many of each kind, in lines.
std::string GridSummary(const Grid& grid);

}  // namespace pfseq
