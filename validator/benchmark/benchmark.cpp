// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/benchmark.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/progress.h"
#include "validator/benchmark/pairs.h"
#include "validator/benchmark/unit.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

namespace pfseq {
namespace {

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

struct UnitPlan {
  size_t pair_idx = 0;
  /// Families come first, then imported features.
  size_t family_idx = 0;
  /// Roughly how long it takes, in units of a small one.
  uint64_t effort = 1;
};

/// Width of the images that figures of effort are from.
constexpr double kEffortWidthPx = 1200.0;
constexpr double kSecondsPerEffort = 0.0035;

/// Distances grow with the square of the key points; these figures are from the pairs of the
/// default sequence and only serve order and forecast. `area` of the image, against those.
uint64_t EffortOf(const Grid& grid, const Family& family, double area = 1.0) {
  const DetectorSetting& detector = grid.detectors[family.front()].detector;
  double points = 2000.0;
  if (detector.setting.Is("SIFT")) {
    points = 20000.0;
  } else if (detector.setting.Is("BRISK")) {
    points = 36000.0 * std::pow(10.0 / detector.setting.Number("thresh"), 1.2);
  }
  const double both = area * points * (detector.is_polar ? 2.5 : 1.0) / 1000.0;
  size_t num_descriptors = 1;
  for (const size_t member : family) {
    num_descriptors = std::max(num_descriptors, grid.detectors[member].descriptors.size());
  }
  return static_cast<uint64_t>(50.0 + both * both * static_cast<double>(num_descriptors)) +
         20 * family.size();
}

/// Pair by pair, so that few images are held; within a pair the largest first, so that no thread is
/// left with it at the end.
std::vector<UnitPlan> PlanUnits(const Grid& grid,
                                const std::vector<Family>& families,
                                size_t num_pairs) {
  std::vector<UnitPlan> plan;
  for (size_t pair = 0; pair < num_pairs; ++pair) {
    const size_t begin = plan.size();
    for (size_t family = 0; family < families.size(); ++family) {
      plan.push_back({pair, family, EffortOf(grid, families[family])});
    }
    for (size_t i = 0; i < grid.imported.size(); ++i) {
      plan.push_back({pair, families.size() + i, 1});
    }
    std::stable_sort(plan.begin() + static_cast<std::ptrdiff_t>(begin),
                     plan.end(),
                     [](const UnitPlan& a, const UnitPlan& b) { return a.effort > b.effort; });
  }
  return plan;
}

/// Brings the units' results into the grid's order.
void Collect(const Grid& grid,
             const std::vector<Family>& families,
             const std::vector<UnitPlan>& plan,
             std::vector<UnitResult>& units,
             BenchmarkResults& results) {
  for (size_t pair = 0; pair < results.pairs.size(); ++pair) {
    std::vector<std::vector<SettingResult>*> of_detector(
        grid.detectors.size() + grid.imported.size(), nullptr);
    for (size_t i = 0; i < plan.size(); ++i) {
      if (plan[i].pair_idx == pair) {
        const size_t family = plan[i].family_idx;
        for (size_t member = 0; member < units[i].of_members.size(); ++member) {
          of_detector[family < families.size() ? families[family][member]
                                               : grid.detectors.size() + family - families.size()] =
              &units[i].of_members[member];
        }
        results.times.insert(results.times.end(), units[i].times.begin(), units[i].times.end());
      }
    }
    for (size_t i = 0; i < of_detector.size(); ++i) {
      if (of_detector[i] != nullptr &&
          (i >= grid.detectors.size() || grid.detectors[i].is_reported)) {
        results.settings.push_back(std::move(of_detector[i]->front()));
      }
    }
    for (std::vector<SettingResult>* settings : of_detector) {
      if (settings != nullptr) {
        for (size_t i = 1; i < settings->size(); ++i) {
          results.settings.push_back(std::move((*settings)[i]));
        }
      }
    }
  }
}

/// Calls body(i) in ascending order on several threads, each taking the next when it is free.
void InOrder(size_t count, int num_threads, const std::function<void(size_t)>& body) {
  std::atomic<size_t> next{0};
  ParallelFor(static_cast<size_t>(num_threads), num_threads, [&](size_t) {
    for (size_t i = next++; i < count; i = next++) {
      body(i);
    }
  });
}

}  // namespace

std::vector<JudgedMatch> TripletMatches::Judged() const {
  std::vector<JudgedMatch> matches;
  for (const auto& [first, second] : attempted) {
    matches.push_back(
        {{detections_px[0][first], detections_px[1][second]}, DistanceM(points, first, second)});
  }
  return matches;
}

const Metric* BenchmarkResults::Find(const std::string& setup,
                                     size_t pair_idx,
                                     const std::string& metric) const {
  for (const SettingResult& setting : settings) {
    if (setting.setup == setup && setting.pair_idx == pair_idx) {
      for (const Metric& candidate : setting.metrics) {
        if (candidate.name == metric) {
          return &candidate;
        }
      }
    }
  }
  return nullptr;
}

BenchmarkResults RunBenchmark(const ViewSource& source,
                              const Grid& grid,
                              const BenchmarkOptions& options) {
  BenchmarkResults results;
  results.sequence = source.Name();
  results.variant = ChooseVariant(source, options.variant);
  results.judge = options.judge;
  results.seed = options.seed;
  results.pairs = ChoosePairs(source, results.variant, options);
  const BenchmarkContext context(source, grid, options, results.variant);
  results.tolerances = context.Judging().tolerances;
  if (!options.stages.empty() && !options.resume) {
    std::filesystem::remove_all(options.stages);
  }

  const std::vector<Family> families = FamiliesOf(grid);
  std::vector<UnitPlan> plan;
  for (const UnitPlan& unit : PlanUnits(grid, families, results.pairs.size())) {
    const size_t number =
        unit.pair_idx * (families.size() + grid.imported.size()) + unit.family_idx;
    if (static_cast<int>(number % static_cast<size_t>(options.num_shards)) == options.shard) {
      plan.push_back(unit);
    }
  }
  uint64_t effort = 0;
  for (const UnitPlan& unit : plan) {
    effort += unit.effort;
  }
  const OpenCvThreads one_each(1);
  Progress progress("benchmark", effort, options.quiet);
  std::vector<UnitResult> units(plan.size());
  InOrder(plan.size(), options.num_threads, [&](size_t i) {
    const UnitPlan& unit = plan[i];
    const PairOfViews& pair = results.pairs[unit.pair_idx];
    const bool is_imported = unit.family_idx >= families.size();
    if (is_imported) {
      const ImportedSetting& setting = grid.imported[unit.family_idx - families.size()];
      progress.SetDetail(fmt::format("pair {}, {}", pair.label, setting.name));
      units[i] = RunImportedUnit(context, pair, unit.pair_idx, setting);
    } else {
      const Family& family = families[unit.family_idx];
      progress.SetDetail(
          fmt::format("pair {}, {}", pair.label, grid.detectors[family.front()].detector.Name()));
      units[i] = RunUnit(context, pair, unit.pair_idx, family);
    }
    progress.Advance(unit.effort);
  });
  progress.Finish();
  Collect(grid, families, plan, units, results);
  return results;
}

double ForecastCpuSeconds(const Grid& grid, int image_width_px) {
  const double scale = image_width_px / kEffortWidthPx;
  uint64_t effort = 0;
  for (const Family& family : FamiliesOf(grid)) {
    effort += EffortOf(grid, family, scale * scale);
  }
  return kSecondsPerEffort * static_cast<double>(effort);
}

std::string BenchmarkTable(const BenchmarkResults& results, size_t max_lines) {
  constexpr size_t kShown[] = {1, 5, 10};
  std::string text = fmt::format("{:<48}{:>14}{:>8}{:>12}", "setting", "lens", "pair", "attempted");
  for (const size_t i : kShown) {
    text += fmt::format("{:>8}", fmt::format("{:g} m", kTolerancesM[i]));
  }
  text += "   (matching score, or repeatability of a detector)\n";
  size_t num_lines = 0;
  for (const SettingResult& setting : results.settings) {
    if (++num_lines > max_lines) {
      text += fmt::format("... and {} more\n", results.settings.size() - max_lines);
      break;
    }
    const PairOfViews& pair = results.pairs[setting.pair_idx];
    std::string count, shares;
    for (const Metric& metric : setting.metrics) {
      if (metric.name == "attempted") {
        count = fmt::format("{}", metric.values[0]);
      }
      if (metric.name == "matching_score" || metric.name == "repeatability") {
        for (const size_t i : kShown) {
          shares += fmt::format("{:>7.1f}%", 100.0 * metric.values[i]);
        }
      }
    }
    text += fmt::format("{:<48}{:>14}{:>8}{:>12}{}{}\n",
                        setting.setup,
                        pair.lens,
                        pair.label,
                        count,
                        shares,
                        setting.is_degenerate ? "  degenerate" : "");
  }
  return text;
}

}  // namespace pfseq
