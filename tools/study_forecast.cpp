// SPDX-License-Identifier: Apache-2.0
#include "tools/study_forecast.h"

#include "renderer/core/file.h"
#include "renderer/core/parallel.h"
#include "renderer/core/progress.h"
#include "renderer/core/random.h"
#include "renderer/lit_scene.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/scene.h"
#include "validator/benchmark/pairs.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

constexpr const char* kTimeFile = "time.json";

// Rates on one core of the machine that they were measured on.
constexpr double kRaysPerSecond = 7.2e5;
constexpr double kSceneS = 15.0;
/// Of light_quality 1; rays a record grow with its square, and records are no more than pixels.
constexpr double kLightS = 120.0;
constexpr double kRenderingSPerMegapixel = 32.0;
constexpr double kSamplesOfRate = 8.0;
/// Reading scene.glb for the judge.
constexpr double kJudgeS = 4.0;

/// Rays a second at random triangles, on all threads.
double TrialRaysPerSecond(int num_threads) {
  constexpr size_t kNumTriangles = 50000;
  constexpr auto kTime = std::chrono::milliseconds(200);
  auto scene = std::make_shared<Scene>();
  Mesh& mesh = scene->meshes.emplace_back();
  const auto random = [](uint64_t i, uint64_t j) {
    return static_cast<float>(UniformFromHash(HashKey({i, j})));
  };
  const auto random_vector = [&](uint64_t i, uint64_t j) {
    return Vec3f(random(i, j), random(i, j + 1), random(i, j + 2));
  };
  for (uint32_t i = 0; i < kNumTriangles; ++i) {
    const Vec3f corner_m = random_vector(i, 0);
    for (uint64_t k = 1; k <= 3; ++k) {
      mesh.positions_m.push_back(corner_m + 0.03F * random_vector(i, 3 * k));
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  scene->materials.emplace_back();
  const RayScene rays(scene);
  std::atomic<uint64_t> num_rays{0};
  const auto start = std::chrono::steady_clock::now();
  ParallelFor(static_cast<size_t>(num_threads), num_threads, [&](size_t thread) {
    uint64_t count = 0;
    while (std::chrono::steady_clock::now() - start < kTime) {
      for (int k = 0; k < 100; ++k, ++count) {
        const Vec3f towards = random_vector(HashKey({thread, count}), 0) - Vec3f::Constant(0.5F);
        rays.Intersect(Vec3f::Constant(0.5F), towards.normalized());
      }
    }
    num_rays += count;
  });
  const std::chrono::duration<double> time_s = std::chrono::steady_clock::now() - start;
  return static_cast<double>(num_rays) / time_s.count();
}

}  // namespace

StudyForecast::StudyForecast(const StudySpec& study, int num_threads)
    : study_(study),
      num_frames_(static_cast<int>(FramesOfPairs(study.pairs).size())),
      trial_(kRaysPerSecond / TrialRaysPerSecond(num_threads)) {}

StudyEffort StudyForecast::EffortOf(const SequenceSpec& spec, bool has_scene) const {
  StudyEffort effort;
  if (!has_scene) {
    effort.scene_s = kSceneS;
    if (spec.render.light == "cached") {
      effort.scene_s += kLightS * spec.render.light_quality * spec.render.light_quality;
    }
  }
  const double megapixels = 1e-6 * spec.image.size_px[0] * spec.image.size_px[1];
  const size_t num_lenses = study_.lenses.empty() ? spec.lenses.size() : study_.lenses.size();
  effort.images_s = kRenderingSPerMegapixel * megapixels * 2.0 * num_frames_ *
                    static_cast<double>(num_lenses) * spec.render.samples / kSamplesOfRate;
  effort.features_s = (study_.judge == Judge::kRay ? kJudgeS : 0.0) +
                      ForecastCpuSeconds(study_.grid, spec.image.size_px[0]) * num_frames_ *
                          static_cast<double>(num_lenses);
  return effort;
}

void StudyForecast::Add(const SequenceSpec& spec) {
  const std::string scene = LitSceneKey(spec);
  left_.push_back(EffortOf(spec, scene == last_scene_));
  last_scene_ = scene;
}

void StudyForecast::Finish(double wall_s, const std::filesystem::path& variant_folder) {
  const double effort_s = left_.front().SumS();
  left_.pop_front();
  done_effort_s_ += effort_s;
  done_wall_s_ += wall_s;
  const nlohmann::json json = {{"effort_s", effort_s}, {"wall_s", wall_s}};
  WriteFileAtomically(variant_folder / kTimeFile, json.dump() + "\n");
}

void StudyForecast::LearnFrom(const std::filesystem::path& variant_folder) {
  if (!std::filesystem::exists(variant_folder / kTimeFile)) {
    return;
  }
  const nlohmann::json json =
      nlohmann::json::parse(ReadFile(variant_folder / kTimeFile), nullptr, false);
  if (json.is_object()) {
    done_effort_s_ += json.value("effort_s", 0.0);
    done_wall_s_ += json.value("wall_s", 0.0);
  }
}

double StudyForecast::SecondsPerEffort() const {
  return done_effort_s_ > 0.0 ? done_wall_s_ / done_effort_s_ : trial_;
}

double StudyForecast::LeftS() const {
  double effort_s = 0.0;
  for (const StudyEffort& effort : left_) {
    effort_s += effort.SumS();
  }
  return effort_s * SecondsPerEffort();
}

std::string StudyForecast::Text() const {
  StudyEffort sum;
  for (const StudyEffort& effort : left_) {
    sum.scene_s += effort.scene_s;
    sum.images_s += effort.images_s;
    sum.features_s += effort.features_s;
  }
  const auto text = [&](double effort_s) { return DurationText(effort_s * SecondsPerEffort()); };
  return fmt::format("{} (scenes and light {}, images {}, features {}), by {}",
                     text(sum.SumS()),
                     text(sum.scene_s),
                     text(sum.images_s),
                     text(sum.features_s),
                     done_effort_s_ > 0.0 ? "the variants that are done"
                                          : "stored rates and a trial of this machine");
}

}  // namespace pfseq
