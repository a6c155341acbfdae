// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark.h"

#include "renderer/core/error.h"
#include "renderer/core/progress.h"
#include "validator/matching/brute_force_matcher.h"
#include "validator/metrics/lift.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

namespace pfseq {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// OpenCV keeps its number of threads in a global; it gets its old one back.
class OpenCvThreads {
 public:
  explicit OpenCvThreads(int num_threads) : previous_(cv::getNumThreads()) {
    cv::setNumThreads(num_threads);
  }
  ~OpenCvThreads() { cv::setNumThreads(previous_); }
  OpenCvThreads(const OpenCvThreads&) = delete;
  OpenCvThreads& operator=(const OpenCvThreads&) = delete;
  OpenCvThreads(OpenCvThreads&&) = delete;
  OpenCvThreads& operator=(OpenCvThreads&&) = delete;

 private:
  int previous_;
};

std::array<std::string, 2> ChooseCameras(const SequenceReader& reader,
                                         std::array<std::string, 2> cameras) {
  if (cameras[0].empty() && cameras[1].empty()) {
    if (reader.Cameras().size() < 2) {
      throw InputError("{}: a benchmark needs two cameras, got {}",
                       reader.Folder().string(),
                       reader.Cameras().size());
    }
    return {reader.Cameras()[0], reader.Cameras()[1]};
  }
  reader.RigFromCamera(cameras[0]);  // Throws for an unknown name.
  reader.RigFromCamera(cameras[1]);
  if (cameras[0] == cameras[1]) {
    throw InputError("cameras: expected two different ones, got '{}' twice", cameras[0]);
  }
  return cameras;
}

/// The frames for which both cameras have a clean image and a distance map.
std::vector<int> CompleteFrames(const SequenceReader& reader,
                                const std::string& lens,
                                const std::array<std::string, 2>& cameras) {
  std::vector<int> complete = reader.Frames(lens, cameras[0], Output::kClean);
  for (const auto& [camera, output] : {std::pair(cameras[0], Output::kDistance),
                                       std::pair(cameras[1], Output::kClean),
                                       std::pair(cameras[1], Output::kDistance)}) {
    const std::vector<int> frames = reader.Frames(lens, camera, output);
    std::vector<int> both;
    std::set_intersection(
        complete.begin(), complete.end(), frames.begin(), frames.end(), std::back_inserter(both));
    complete = both;
  }
  return complete;
}

std::vector<int> ChooseFrames(const SequenceReader& reader,
                              const std::string& lens,
                              const std::array<std::string, 2>& cameras,
                              const std::vector<int>& wanted) {
  std::vector<int> complete = CompleteFrames(reader, lens, cameras);
  if (wanted.empty()) {
    return complete;
  }
  const std::set<int> sorted(wanted.begin(), wanted.end());
  for (const int frame : sorted) {
    if (!std::binary_search(complete.begin(), complete.end(), frame)) {
      throw InputError("{}: frame {}: expected clean images and distance maps of {} and {}",
                       (reader.Folder() / lens).string(),
                       frame,
                       cameras[0],
                       cameras[1]);
    }
  }
  return {sorted.begin(), sorted.end()};
}

/// Key points with a place in the world.
struct View {
  Features features;
  std::vector<std::optional<Vec3d>> points_m;
};

void Lift(const SequenceReader& reader,
          const PairResult& pair,
          const std::string& camera,
          View& view) {
  const Image<float> distance_m = reader.ReadDistance(pair.lens, camera, pair.frame);
  const RigidTransform world_from_camera = reader.WorldFromCamera(camera, pair.frame);
  const Lens& lens = reader.LensOf(pair.lens);
  for (const Vec2d& pixel_px : view.features.pixels_px) {
    view.points_m.push_back(LiftToWorld(pixel_px, lens, world_from_camera, distance_m));
  }
}

PairResult MeasurePair(const SequenceReader& reader,
                       const std::string& lens,
                       int frame,
                       const std::array<std::string, 2>& cameras,
                       const BenchmarkOptions& options) {
  PairResult pair;
  pair.lens = lens;
  pair.frame = frame;
  std::array<View, 2> views;
  const std::array<Image<uint8_t>, 2> images = {reader.ReadClean(lens, cameras[0], frame),
                                                reader.ReadClean(lens, cameras[1], frame)};
  Clock::time_point start = Clock::now();
  for (size_t i = 0; i < views.size(); ++i) {
    views[i].features = DetectSift(images[i], options.sift);
  }
  pair.detect_s = SecondsSince(start);

  start = Clock::now();
  const std::vector<DescriptorMatch> matches = MatchBruteForce(
      views[0].features.descriptors, views[1].features.descriptors, options.num_threads);
  pair.match_s = SecondsSince(start);

  start = Clock::now();
  for (size_t i = 0; i < views.size(); ++i) {
    Lift(reader, pair, cameras[i], views[i]);
  }
  const std::vector<double> distances_m =
      MatchDistancesM(matches, views[0].points_m, views[1].points_m);
  pair.metrics = MeasureFeatures(views[0].points_m, views[1].points_m, distances_m);
  for (size_t i = 0; i < matches.size(); ++i) {
    pair.attempted.push_back({{views[0].features.pixels_px[matches[i].first_idx],
                               views[1].features.pixels_px[matches[i].second_idx]},
                              distances_m[i]});
  }
  pair.judge_s = SecondsSince(start);
  return pair;
}

}  // namespace

BenchmarkResults RunBenchmark(const SequenceReader& reader, const BenchmarkOptions& options) {
  BenchmarkResults results;
  results.sequence = std::filesystem::weakly_canonical(reader.Folder()).filename().string();
  results.cameras = ChooseCameras(reader, options.cameras);
  results.lenses = options.lenses.empty() ? reader.Lenses() : options.lenses;
  results.sift = options.sift;

  std::vector<std::pair<std::string, int>> work;
  std::set<int> frames;
  for (const std::string& lens : results.lenses) {
    reader.LensOf(lens);  // Throws for an unknown name.
    for (const int frame : ChooseFrames(reader, lens, results.cameras, options.frames)) {
      work.emplace_back(lens, frame);
      frames.insert(frame);
    }
  }
  results.frames.assign(frames.begin(), frames.end());
  if (work.empty()) {
    throw InputError("{}: no frame has clean images and distance maps of {} and {}",
                     reader.Folder().string(),
                     results.cameras[0],
                     results.cameras[1]);
  }

  const OpenCvThreads threads(options.num_threads);
  Progress progress("benchmark", work.size(), options.quiet);
  for (const auto& [lens, frame] : work) {
    progress.SetDetail(fmt::format("{} {}", lens, frame));
    results.pairs.push_back(MeasurePair(reader, lens, frame, results.cameras, options));
    progress.Advance();
  }
  progress.Finish();
  return results;
}

std::string BenchmarkTable(const BenchmarkResults& results) {
  constexpr std::array<size_t, 3> kShownTolerances = {1, 5, 10};
  std::string text = fmt::format("{}\n{:<14}{:>6}{:>9}{:>9}{:>10}",
                                 results.TripletName(),
                                 "lens",
                                 "pair",
                                 results.cameras[0],
                                 results.cameras[1],
                                 "attempted");
  for (const char* measure : {"repeatability", "matching score"}) {
    text += fmt::format("  {:>24}", measure);
  }
  text += fmt::format("\n{:48}", "");
  for (int measure = 0; measure < 2; ++measure) {
    text += "  ";
    for (const size_t i : kShownTolerances) {
      text += fmt::format("{:>8}", fmt::format("{:g} m", kTolerancesM[i]));
    }
  }
  text += '\n';
  for (const PairResult& pair : results.pairs) {
    const FeatureMetrics& metrics = pair.metrics;
    text += fmt::format("{:<14}{:>6}{:>9}{:>9}{:>10}  ",
                        pair.lens,
                        pair.frame,
                        metrics.num_first,
                        metrics.num_second,
                        pair.attempted.size());
    for (const size_t i : kShownTolerances) {
      text += fmt::format("{:>7.1f}%", 100.0 * metrics.Repeatability(i));
    }
    text += "  ";
    for (const size_t i : kShownTolerances) {
      text += fmt::format("{:>7.1f}%", 100.0 * metrics.MatchingScore(i));
    }
    text += '\n';
  }
  return text;
}

}  // namespace pfseq
