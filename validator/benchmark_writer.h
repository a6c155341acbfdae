// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/sequence/sequence_reader.h"
#include "validator/benchmark.h"

#include <filesystem>

namespace pfseq {

/// Writes into `folder` (made when missing, files of an earlier run are replaced):
///
///   results.csv               lens,pair,metric,setup,tolerance_m,value: the measures, in the form
///   of the 2014 tables summary.csv
///   lens,pair,setup,detections_CAMERA,detections_CAMERA,attempted_matches benchmark.json what was
///   measured and how matches_LENS_NNNNNN.png   both views with correct matches in green and wrong
///   ones in red times.csv                 lens,pair,detect_s,match_s,judge_s: the one file that
///   differs from run to run
///
/// SystemError when the folder cannot be written.
void WriteBenchmark(const BenchmarkResults& results,
                    const SequenceReader& reader,
                    const std::filesystem::path& folder);

}  // namespace pfseq
