// SPDX-License-Identifier: Apache-2.0
// Renders and measures the variants of a study. What they have in common is done once: variants of
// one scene and light run after each other and share both, and files that would be the same bytes
// (scene.glb, distance and sky, clean frames) are links to those of an earlier variant.
#pragma once

#include "renderer/sequence_renderer.h"
#include "tools/study_forecast.h"
#include "validator/study/study_plan.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

struct StudyRunOptions {
  std::filesystem::path out;
  bool resume = false;
  /// Takes a block of the variants, in their order of work.
  int shard = 0;
  int num_shards = 1;
  int num_threads = 1;
  bool quiet = false;
  LightCacheOptions light_cache;
};

/// out/variants/NAME/{sequence,bench}
std::filesystem::path VariantFolder(const std::filesystem::path& out, const StudyVariant& variant);

/// Whether a variant is rendered and measured.
bool IsMeasured(const std::filesystem::path& out, const StudyVariant& variant);

/// Outputs of which two descriptions give the same bytes.
std::vector<Output> SameOutputs(const SequenceSpec& a, const SequenceSpec& b);

/// Variants by scene and light, in the order in which they come: what shares them lies together.
std::vector<size_t> OrderOfWork(const std::vector<StudyVariant>& variants);

class StudyRunner {
 public:
  /// Takes the folder: InputError when it holds another study, one without options.resume, or other
  /// things. All must outlive this.
  StudyRunner(const StudySpec& study,
              const std::vector<StudyVariant>& variants,
              const StudyRunOptions& options);

  /// What this run has to do, from the times of finished variants where there are such.
  const StudyForecast& Forecast() const { return forecast_; }

  /// Does it. A stopped run leaves finished files alone. True when all variants of the study are
  /// measured.
  bool Run();

 private:
  void Render(const StudyVariant& variant, const SequenceInput& input) const;
  void Measure(const StudyVariant& variant) const;

  const StudySpec& study_;
  const std::vector<StudyVariant>& variants_;
  const StudyRunOptions& options_;
  /// What is left to do, in order.
  std::vector<size_t> work_;
  StudyForecast forecast_;
};

}  // namespace pfseq
