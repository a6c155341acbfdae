// SPDX-License-Identifier: Apache-2.0
#include "tools/study_runner.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/progress.h"
#include "renderer/lit_scene.h"
#include "renderer/sequence/sequence_schema.h"
#include "tools/common_options.h"
#include "tools/sequence_input.h"
#include "validator/benchmark/pairs.h"
#include "validator/benchmark/results_writer.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kStudyFile = "study.yaml";
constexpr const char* kVariantFile = "variant.yaml";
constexpr const char* kVariantsFolder = "variants";

/// The file's text must be this one; it is written where there is none.
void ExpectText(const std::filesystem::path& path, const std::string& text) {
  if (!std::filesystem::exists(path)) {
    WriteFileAtomically(path, text);
    return;
  }
  const std::string old = ReadFile(path);
  if (old != text) {
    const auto [in_old, in_new] = std::mismatch(old.begin(), old.end(), text.begin(), text.end());
    throw InputError("{}: was made from another study (line {} differs); take another --out",
                     path.string(),
                     1 + std::count(old.begin(), in_old, '\n'));
  }
}

void TakeFolder(const StudySpec& study, const StudyRunOptions& options) {
  const std::filesystem::path file = options.out / kStudyFile;
  if (std::filesystem::exists(file) && !options.resume) {
    throw InputError("{}: already holds a study; --resume goes on with it", options.out.string());
  }
  if (!std::filesystem::exists(file) && std::filesystem::exists(options.out)) {
    for (const auto& entry : std::filesystem::directory_iterator(options.out)) {
      const std::string name = entry.path().filename().string();
      if (!name.ends_with(kPartialSuffix)) {
        throw InputError(
            "{}: the folder holds other things than a study ({})", options.out.string(), name);
      }
    }
  }
  ExpectText(file, study.effective_yaml);
}

/// What distance and sky depend on.
std::string TruthKey(const SequenceSpec& spec) {
  SequenceSpec key;
  key.image = spec.image;
  key.lenses = spec.lenses;
  key.cameras = spec.cameras;
  key.trajectory = spec.trajectory;
  key.scene = spec.scene;
  key.ground_truth = spec.ground_truth;
  return CanonicalYaml(key);
}

/// What clean frames depend on besides.
std::string CleanKey(const SequenceSpec& spec) {
  SequenceSpec key = spec;
  key.name = "";
  key.shutter = {};
  key.optics = {};
  key.sensor = {};
  key.sensor.exposure = spec.sensor.exposure;
  key.sensor.metering = spec.sensor.metering;
  key.sensor.tone_curve = spec.sensor.tone_curve;
  return CanonicalYaml(key);
}

std::vector<Output> OutputsOf(const StudySpec& study) {
  return {study.images == "clean" ? Output::kClean : Output::kRealistic,
          Output::kDistance,
          Output::kSky};
}

}  // namespace

std::filesystem::path VariantFolder(const std::filesystem::path& out, const StudyVariant& variant) {
  return out / kVariantsFolder / variant.name;
}

bool IsMeasured(const std::filesystem::path& out, const StudyVariant& variant) {
  const std::filesystem::path folder = VariantFolder(out, variant);
  return std::filesystem::exists(folder / "sequence" / kManifestFile) &&
         std::filesystem::exists(folder / "bench" / "results.json");
}

std::vector<Output> SameOutputs(const SequenceSpec& a, const SequenceSpec& b) {
  std::vector<Output> same;
  if (TruthKey(a) == TruthKey(b)) {
    same = {Output::kDistance, Output::kSky};
    if (CleanKey(a) == CleanKey(b)) {
      same.push_back(Output::kClean);
    }
  }
  return same;
}

std::vector<size_t> OrderOfWork(const std::vector<StudyVariant>& variants) {
  std::map<std::string, size_t> first_with_key;
  std::vector<std::pair<size_t, size_t>> order;
  for (size_t i = 0; i < variants.size(); ++i) {
    order.emplace_back(first_with_key.emplace(LitSceneKey(variants[i].spec), i).first->second, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<size_t> indices;
  for (const auto& [group, i] : order) {
    indices.push_back(i);
  }
  return indices;
}

StudyRunner::StudyRunner(const StudySpec& study,
                         const std::vector<StudyVariant>& variants,
                         const StudyRunOptions& options)
    : study_(study), variants_(variants), options_(options), forecast_(study, options.num_threads) {
  const std::vector<size_t> order = OrderOfWork(variants);
  const auto block = [&](int shard) {
    return order.size() * static_cast<size_t>(shard) / static_cast<size_t>(options.num_shards);
  };
  for (size_t i = block(options.shard); i < block(options.shard + 1); ++i) {
    const StudyVariant& variant = variants[order[i]];
    if (IsMeasured(options.out, variant)) {
      forecast_.LearnFrom(VariantFolder(options.out, variant));
    } else {
      forecast_.Add(variant.spec);
      work_.push_back(order[i]);
    }
  }
}

void StudyRunner::Render(const StudyVariant& variant, const SequenceInput& input) const {
  RenderOptions render;
  render.folder = VariantFolder(options_.out, variant) / "sequence";
  render.frames = FramesOfPairs(study_.pairs);
  render.lenses = study_.lenses;
  for (const std::string& camera : study_.cameras) {
    if (!camera.empty()) {
      render.cameras.push_back(camera);
    }
  }
  render.outputs = OutputsOf(study_);
  render.on_existing = OnExisting::kResume;
  render.num_threads = options_.num_threads;
  render.quiet = options_.quiet;
  render.light_cache = options_.light_cache;
  // The finished variant that has most of it already.
  size_t most = 0;
  for (const StudyVariant& other : variants_) {
    if (&other == &variant ||
        !std::filesystem::exists(VariantFolder(options_.out, other) / "sequence" / kManifestFile)) {
      continue;
    }
    const std::vector<Output> same = SameOutputs(variant.spec, other.spec);
    const bool has_scene = LitSceneKey(variant.spec) == LitSceneKey(other.spec);
    const size_t worth = 2 * same.size() + (has_scene ? 1 : 0);
    if (worth > most) {
      most = worth;
      render.sibling = VariantFolder(options_.out, other) / "sequence";
      render.sibling_outputs.clear();
      std::copy_if(
          same.begin(), same.end(), std::back_inserter(render.sibling_outputs), [&](Output output) {
            return std::find(render.outputs.begin(), render.outputs.end(), output) !=
                   render.outputs.end();
          });
    }
  }
  RenderSequence(input, render);
}

void StudyRunner::Measure(const StudyVariant& variant) const {
  const std::filesystem::path folder = VariantFolder(options_.out, variant);
  BenchmarkOptions bench;
  bench.pairs = study_.pairs;
  bench.lenses = study_.lenses;
  bench.cameras = study_.cameras;
  bench.variant = study_.images;
  bench.judge = study_.judge;
  bench.num_threads = options_.num_threads;
  bench.quiet = options_.quiet;
  bench.stages = folder / "bench" / "stages";
  bench.resume = true;
  const auto start = std::chrono::steady_clock::now();
  const std::unique_ptr<ViewSource> views = OpenViews(folder / "sequence");
  const BenchmarkResults results = RunBenchmark(*views, study_.grid, bench);
  const std::chrono::duration<double> wall_s = std::chrono::steady_clock::now() - start;
  WriteRun({CommandLine(), folder / "sequence", wall_s.count()}, folder / "bench");
  WriteResults(results, folder / "bench");
}

bool StudyRunner::Run() {
  TakeFolder(study_, options_);
  // The base sequence or a file that it names may be another one by now.
  for (const StudyVariant& variant : variants_) {
    const std::filesystem::path file = VariantFolder(options_.out, variant) / kVariantFile;
    if (std::filesystem::exists(file)) {
      ExpectText(file, CanonicalYaml(variant.spec));
    }
  }
  std::optional<SequenceInput> input;
  for (size_t i = 0; i < work_.size(); ++i) {
    const StudyVariant& variant = variants_[work_[i]];
    const std::filesystem::path folder = VariantFolder(options_.out, variant);
    if (!options_.quiet) {
      fmt::print(stderr,
                 "variant {} of {}, {}: some {} left\n",
                 i + 1,
                 work_.size(),
                 variant.name,
                 DurationText(forecast_.LeftS()));
    }
    const auto start = std::chrono::steady_clock::now();
    ExpectText(folder / kVariantFile, CanonicalYaml(variant.spec));
    if (!std::filesystem::exists(folder / "sequence" / kManifestFile)) {
      if (input && LitSceneKey(input->spec) == LitSceneKey(variant.spec)) {
        ChangeCameras(variant.spec, *input);
      } else {
        input.reset();  // Two scenes at once would take twice the memory.
        input = LoadSequenceInput(variant.spec);
        input->lit_scene = std::make_shared<LitScene>(*input);
      }
      Render(variant, *input);
    }
    Measure(variant);
    const std::chrono::duration<double> wall_s = std::chrono::steady_clock::now() - start;
    forecast_.Finish(wall_s.count(), folder);
  }
  return std::all_of(variants_.begin(), variants_.end(), [&](const StudyVariant& variant) {
    return IsMeasured(options_.out, variant);
  });
}

}  // namespace pfseq
