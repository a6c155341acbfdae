// SPDX-License-Identifier: Apache-2.0
// What a study asks: a YAML file that names a base sequence and the knobs to turn.
//
//   name: What does blur do?
//   base: ../sequences/pfseq.yaml       paths start at the study's folder
//   set: {image.size_px: 480}           keys of the base sequence, for all variants
//   factors:
//     exposure:                         a-z, 0-9, _
//       title: Exposure time (s)        default: the key, or the factor's name
//       key: shutter.exposure_s         any key of a sequence (pfseq keys), or a whole part:
//       values: [0, 0.05, 0.1]          key: optics, values: [../optics/off.yaml, ...]
//       base: 0                         the level that the others are compared with; default: first
//     weather:
//       levels:                         instead of key and values: labels, each with its keys
//         - {label: clear}
//         - {label: dull, set: {light.sun.strength: 0, light.sky.turbidity: 8}}
//   design: one at a time               default: the others at their base; or: all combinations
//   repetitions:                        default: none; lists of the same length are set together
//     scene.canyon.seed: [1, 2]
//   pairs: [24, 40]                     as --pairs of pfseq bench
//   cameras: [front, rear]              default: the first two
//   lenses: [equisolid]                 default: all
//   grid: ../grids/quick.yaml           or a grid's mapping (validator/grid/grid.h)
//   images: realistic                   default; or clean
//   judge: ray                          default; or map
//   tolerance_m: 0.04                   of the verdict; one of the benchmark's distances
//   compare:                            default: the best triplet of each detector and descriptor
//     - [SETTING, SETTING]              two triplets or two detectors by name
#pragma once

#include "renderer/sequence/sequence_schema.h"
#include "validator/benchmark/benchmark.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfseq {

/// One setting of a knob.
struct StudyLevel {
  std::string label;
  std::vector<SpecChange> changes;
  /// Where it stands on an axis; nothing for words.
  std::optional<double> number;
};

/// A knob.
struct StudyFactor {
  std::string name;
  std::string title;
  /// At least two; labels differ.
  std::vector<StudyLevel> levels;
  size_t base_idx = 0;

  /// Whether all levels are numbers.
  bool IsNumeric() const;
};

enum class StudyDesign { kOneAtATime, kAllCombinations };

struct StudySpec {
  std::string name;
  std::filesystem::path base;
  std::vector<SpecChange> changes;
  std::vector<StudyFactor> factors;
  StudyDesign design = StudyDesign::kOneAtATime;
  /// At least one; a single one that changes nothing stands for none.
  std::vector<StudyLevel> repetitions;
  std::string pairs;
  std::array<std::string, 2> cameras;
  std::vector<std::string> lenses;
  Grid grid;
  std::string images = "realistic";
  Judge judge = Judge::kRay;
  double tolerance_m = 0.04;
  std::vector<std::array<std::string, 2>> compare;
  /// The study with all that it takes from its defaults and its grid's file, paths made absolute;
  /// reading it gives the same study.
  std::string effective_yaml;
};

/// InputError "FILE:LINE: KEY: expected ..., got ...". Keys of the sequence are looked at when the
/// variants are planned.
StudySpec ReadStudy(const std::filesystem::path& path);

}  // namespace pfseq
