// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "validator/benchmark/unit.h"
#include "validator/metrics/lift.h"

namespace pfseq {
namespace {

constexpr size_t kNumCachedViews = 8;

std::string HashOf(const Image<uint8_t>& image) {
  const auto* bytes = reinterpret_cast<const char*>(image.Values().data());
  return fmt::format("{} x {} x {} ", image.WidthPx(), image.HeightPx(), image.NumChannels()) +
         Sha256Hex(std::string_view(bytes, image.Values().size()));
}

Tolerances TolerancesOf(const Grid& grid) {
  Tolerances tolerances;
  for (const double angle_deg : grid.angles_deg) {
    tolerances.angles_rad.push_back(RadFromDeg(angle_deg));
  }
  return tolerances;
}

}  // namespace

BenchmarkContext::BenchmarkContext(const ViewSource& source,
                                   const Grid& grid,
                                   const BenchmarkOptions& options,
                                   std::string variant)
    : source_(source),
      grid_(grid),
      options_(options),
      variant_(std::move(variant)),
      store_(options.stages),
      judging_{TolerancesOf(grid), grid.best},
      draws_(options.seed) {
  if (options.judge == Judge::kRay) {
    scene_ = source.Scene();
    if (scene_ == nullptr) {
      throw InputError("{}: --judge ray: expected a scene (scene.glb), got none; see --judge map",
                       source.Name());
    }
  }
}

BenchmarkContext::CachedView& BenchmarkContext::Cached(const std::string& lens,
                                                       const ViewName& view) const {
  for (auto cached = cached_.begin(); cached != cached_.end(); ++cached) {
    if (cached->lens == lens && cached->view == view) {
      cached_.splice(cached_.begin(), cached_, cached);
      return cached_.front();
    }
  }
  if (cached_.size() == kNumCachedViews) {
    cached_.pop_back();
  }
  const Image<uint8_t> image = source_.ReadImage(lens, view, variant_);
  cached_.push_front(
      {lens,
       view,
       std::make_shared<const LoadedImage>(LoadedImage{
           WorkImage::Fisheye(image), image.WidthPx(), image.HeightPx(), HashOf(image)}),
       nullptr});
  return cached_.front();
}

std::shared_ptr<const LoadedImage> BenchmarkContext::ImageOf(const std::string& lens,
                                                             const ViewName& view) const {
  const std::lock_guard lock(mutex_);
  return Cached(lens, view).image;
}

std::shared_ptr<const WorkImage> BenchmarkContext::PolarOf(const std::string& lens,
                                                           const ViewName& view) const {
  const std::lock_guard lock(mutex_);
  CachedView& cached = Cached(lens, view);
  if (cached.polar == nullptr) {
    cached.polar = std::make_shared<const WorkImage>(
        WorkImage::Polar(source_.ReadImage(lens, view, variant_), source_.LensOf(lens)));
  }
  return cached.polar;
}

ScenePoints BenchmarkContext::Lift(const std::string& lens_name,
                                   const ViewName& view,
                                   const std::vector<Vec2d>& pixels_px) const {
  const Lens& lens = source_.LensOf(lens_name);
  const RigidTransform world_from_camera = source_.WorldFromCamera(view);
  ScenePoints points_m;
  points_m.reserve(pixels_px.size());
  if (options_.judge == Judge::kRay) {
    for (const Vec2d& pixel_px : pixels_px) {
      points_m.push_back(
          LiftByRay(pixel_px, lens, world_from_camera, *scene_, source_.MaxDistanceM()));
    }
  } else {
    const Image<float> distance_m = source_.ReadDistance(lens_name, view);
    for (const Vec2d& pixel_px : pixels_px) {
      points_m.push_back(LiftByMap(pixel_px, lens, world_from_camera, distance_m));
    }
  }
  return points_m;
}

}  // namespace pfseq
