// SPDX-License-Identifier: Apache-2.0
// A unit of work: one pair of views, one family of detectors, all that is built on it.
#pragma once

#include "validator/benchmark/benchmark.h"
#include "validator/benchmark/judge.h"
#include "validator/benchmark/stage_store.h"
#include "validator/features/detect.h"
#include "validator/features/work_image.h"

#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfseq {

/// Detectors of a grid that share key points, by their index in the grid; at most 64.
using Family = std::vector<size_t>;

/// In order of their first members.
std::vector<Family> FamiliesOf(const Grid& grid);

/// An image, ready to work on.
struct LoadedImage {
  WorkImage fisheye;
  int width_px = 0;
  int height_px = 0;
  /// Of the file's pixels.
  std::string hash;
};

/// What all units share. Safe for many threads.
class BenchmarkContext {
 public:
  BenchmarkContext(const ViewSource& source,
                   const Grid& grid,
                   const BenchmarkOptions& options,
                   std::string variant);

  const ViewSource& Source() const { return source_; }
  const Grid& OwnGrid() const { return grid_; }
  const BenchmarkOptions& Options() const { return options_; }
  const std::string& Variant() const { return variant_; }
  const StageStore& Store() const { return store_; }
  const JudgeSetting& Judging() const { return judging_; }
  const BootstrapDraws& Draws() const { return draws_; }

  /// Of the last few views; others are read again.
  std::shared_ptr<const LoadedImage> ImageOf(const std::string& lens, const ViewName& view) const;
  std::shared_ptr<const WorkImage> PolarOf(const std::string& lens, const ViewName& view) const;

  /// The places of pixels in the world. InputError when the map is missing.
  ScenePoints Lift(const std::string& lens,
                   const ViewName& view,
                   const std::vector<Vec2d>& pixels_px) const;

 private:
  struct CachedView;
  CachedView& Cached(const std::string& lens, const ViewName& view) const;

  const ViewSource& source_;
  const Grid& grid_;
  const BenchmarkOptions& options_;
  std::string variant_;
  StageStore store_;
  JudgeSetting judging_;
  BootstrapDraws draws_;
  std::shared_ptr<const RayScene> scene_;
  mutable std::mutex mutex_;
  mutable std::list<CachedView> cached_;
};

struct BenchmarkContext::CachedView {
  std::string lens;
  ViewName view;
  std::shared_ptr<const LoadedImage> image;
  std::shared_ptr<const WorkImage> polar;
};

struct UnitResult {
  /// Of each member: its own, then those of its triplets in the grid's order.
  std::vector<std::vector<SettingResult>> of_members;
  std::vector<StageTime> times;
};

UnitResult RunUnit(const BenchmarkContext& context,
                   const PairOfViews& pair,
                   size_t pair_idx,
                   const Family& family);

/// The same of features made elsewhere (imported_features.h). InputError when a file is missing or
/// wrong.
UnitResult RunImportedUnit(const BenchmarkContext& context,
                           const PairOfViews& pair,
                           size_t pair_idx,
                           const ImportedSetting& setting);

/// A view's key points of a family that lie within the lens's field.
struct DetectedView {
  FamilyKeyPoints family;
  JudgedView judged;
  /// Hash of all that they depend on.
  std::string key;
};

/// Finds or loads them.
DetectedView DetectView(const BenchmarkContext& context,
                        const std::string& lens,
                        const ViewName& view,
                        const Family& family);

/// The same view with some points only.
JudgedView Subset(const JudgedView& view, const std::vector<int>& points);

/// Fills in what follows from pixels_px.
void PlaceInDisc(const Lens& lens, JudgedView& view);

}  // namespace pfseq
