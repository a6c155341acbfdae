// SPDX-License-Identifier: Apache-2.0
#include "renderer/cached_frame_renderer.h"

#include "renderer/core/parallel.h"
#include "renderer/pixel_context.h"
#include "renderer/pixel_rays.h"
#include "renderer/trail_sampling.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

namespace pfseq {
namespace {

constexpr int kTilePx = 16;

/// What is known of a pixel: sums over its samples.
struct PixelSums {
  Rgb radiance = Rgb::Zero();
  /// Of the first half of the first samples.
  float half_luminance = 0.0F;
  int num_samples = 0;
};

/// A camera ray.
struct CameraRay {
  Vec3f origin_m;
  Vec3f direction;
  RayFootprint footprint;
};

/// Where the light of a sample goes.
struct SampleTarget {
  PixelSums* sums = nullptr;
  bool is_first_half = false;
  /// May be null.
  CellFilm::Cell* cell = nullptr;
};

/// One sample of a pixel in so many columns and rows finds nearly all records that a view looks up;
/// the others are computed when they are looked up.
constexpr int kMarkingStepPx = 2;

/// Collects samples until a packet is full, then marks the records that they look up.
class PacketMarker {
 public:
  explicit PacketMarker(const CachedLightTracer& tracer) : tracer_(tracer) {}

  void Add(const CameraRay& ray, const PixelSampler& sampler, const SampleTarget&) {
    const auto lane = static_cast<size_t>(count_);
    packet_.rays.Set(count_, ray.origin_m, ray.direction);
    packet_.footprints[lane] = ray.footprint;
    packet_.samplers[lane] = sampler;
    if (++count_ == kPacketSize) {
      Flush();
    }
  }

  void Flush() {
    tracer_.WantRecords(packet_, missing_);
    packet_.rays.active = 0;
    count_ = 0;
  }

  const std::vector<LightStore::RecordId>& Missing() const { return missing_; }

 private:
  const CachedLightTracer& tracer_;
  CameraPacket packet_;
  int count_ = 0;
  std::vector<LightStore::RecordId> missing_;
};

/// Collects samples until a packet is full, then traces it and adds the results to their pixels.
class PacketBuilder {
 public:
  explicit PacketBuilder(const CachedLightTracer& tracer) : tracer_(tracer) {}

  void Add(const CameraRay& ray, const PixelSampler& sampler, const SampleTarget& target) {
    const auto lane = static_cast<size_t>(count_);
    packet_.rays.Set(count_, ray.origin_m, ray.direction);
    packet_.footprints[lane] = ray.footprint;
    packet_.samplers[lane] = sampler;
    targets_[lane] = target;
    if (++count_ == kPacketSize) {
      Flush();
    }
  }

  void Flush() {
    if (count_ == 0) {
      return;
    }
    std::array<Rgb, kPacketSize> radiance;
    tracer_.Radiance(packet_, radiance);
    for (size_t lane = 0; lane < static_cast<size_t>(count_); ++lane) {
      const Rgb& value = radiance[lane];
      // A triangle without area has no normal; what came of it must not spoil the whole pixel.
      if (value.isFinite().all()) {
        const SampleTarget& target = targets_[lane];
        target.sums->radiance += value;
        target.sums->half_luminance += target.is_first_half ? Luminance(value) : 0.0F;
        if (target.cell != nullptr) {
          target.cell->sum += value;
          target.cell->num_samples += 1.0F;
        }
      }
    }
    packet_.rays.active = 0;
    count_ = 0;
  }

 private:
  const CachedLightTracer& tracer_;
  CameraPacket packet_;
  std::array<SampleTarget, kPacketSize> targets_{};
  int count_ = 0;
};

/// Renders pixels of a view into their sums.
class ViewSampler {
 public:
  ViewSampler(const CachedLightTracer& tracer,
              const LensRaster& raster,
              const View& view,
              const PixelSampling& sampling,
              int num_threads,
              CellFilm* film)
      : raster_(raster),
        view_(view),
        film_(film),
        still_(view.world_from_camera),
        origin_m_(view.world_from_camera.translation_m.cast<float>()),
        sampling_(sampling),
        sums_(static_cast<size_t>(view.width_px) * static_cast<size_t>(view.height_px)) {
    if (view.exposure != nullptr && !view.exposure->IsStill()) {
      still_ = {};
      trail_.emplace(tracer.Rays(), raster, view.world_from_camera, *view.exposure, num_threads);
    }
  }

  PixelSums& SumsOf(int x, int y) { return sums_[Index(x, y)]; }

  /// Adds samples to a pixel up to the given number.
  template <typename Builder>
  void SampleUpTo(int num_samples, int x, int y, Builder& builder) {
    PixelSums& sums = SumsOf(x, y);
    const int first = sums.num_samples;
    sums.num_samples = num_samples;
    if (raster_.IsOutside(x, y)) {
      return;
    }
    const bool moves = trail_.has_value();
    const PixelRays rays(raster_, still_, x, y);
    const Strata strata(num_samples);
    const PixelSampler pixel(
        view_.seed, view_.frame, view_.view_idx, static_cast<uint64_t>(Index(x, y)), 0);
    for (int i = first; i < num_samples; ++i) {
      PixelSampler sampler = pixel.ForSample(static_cast<uint32_t>(i));
      Vec3d sample = Vec3d::Zero();
      if (moves) {
        sample = sampler.Get3D();
      } else {
        sample.head<2>() = sampler.Get2D();
      }
      const Vec2f place = sample.head<2>().cast<float>().cwiseMin(kBelowOne);
      const std::optional<Vec3f> direction = rays.Direction(place);
      CellFilm::Cell* cell = film_ != nullptr ? &film_->At(x, y, place) : nullptr;
      if (direction.has_value()) {
        const CameraRay ray =
            moves ? MovingRay(trail_->PoseOf(x, y, place, {sample.z(), sampler.Get1D()}),
                              *direction,
                              rays.MovingFootprint(place))
                  : CameraRay{
                        origin_m_, *direction, rays.Footprint(place, strata.Middle(place), strata)};
        builder.Add(ray, sampler, {&sums, i < sampling_.num_samples / 2, cell});
      } else if (cell != nullptr) {
        cell->num_samples += 1.0F;
      }
    }
  }

  /// How many samples a pixel needs by what its first ones say. Each half of them covers the pixel
  /// evenly, so what the halves differ by is what samples miss, not what the pixel shows. The
  /// number is proportional to the error: that makes the least error of the image for all samples.
  int NumSamplesNeeded(int x, int y) {
    const PixelSums& sums = SumsOf(x, y);
    const int half = sums.num_samples / 2;
    if (half == 0) {
      return sums.num_samples;
    }
    const float total = Luminance(sums.radiance);
    const float first = sums.half_luminance / static_cast<float>(half);
    const float second =
        (total - sums.half_luminance) / static_cast<float>(sums.num_samples - half);
    const float error = 0.5F * std::abs(first - second);
    const float scale =
        std::max(total / static_cast<float>(sums.num_samples), 0.1F * sampling_.reference_radiance);
    const float excess = error / (sampling_.tolerance * scale);
    if (!(excess > 1.0F)) {
      return sums.num_samples;
    }
    const auto packets = std::ceil(excess * static_cast<float>(sums.num_samples) / kPacketSize);
    return static_cast<int>(
        std::min(packets * kPacketSize, static_cast<float>(sampling_.max_samples)));
  }

 private:
  static constexpr float kBelowOne = 0x1.fffffep-1F;

  /// The ray of a direction and footprint in a camera.
  static CameraRay MovingRay(const ExposurePoses::Pose& camera,
                             const Vec3f& direction,
                             const RayFootprint& footprint) {
    return {camera.origin_m,
            camera.world_from_camera * direction,
            {Vec3f::Zero(),
             camera.world_from_camera * footprint.axis_x,
             camera.world_from_camera * footprint.axis_y}};
  }

  size_t Index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(view_.width_px) + static_cast<size_t>(x);
  }

  const LensRaster& raster_;
  const View& view_;
  CellFilm* film_;
  /// Nothing when the camera rests.
  std::optional<TrailSampling> trail_;
  /// World from camera; the identity when the camera moves.
  RigidTransform still_;
  Vec3f origin_m_;
  PixelSampling sampling_;
  std::vector<PixelSums> sums_;
};

struct Tile {
  int x0, y0, x1, y1;
};

/// Calls body(tile) for the tiles of an image.
void ForEachTile(const View& view, int num_threads, const std::function<void(const Tile&)>& body) {
  const int num_tiles_x = (view.width_px + kTilePx - 1) / kTilePx;
  const int num_tiles_y = (view.height_px + kTilePx - 1) / kTilePx;
  ParallelFor(static_cast<size_t>(num_tiles_x) * static_cast<size_t>(num_tiles_y),
              num_threads,
              [&](size_t tile_idx) {
                const int x0 = static_cast<int>(tile_idx) % num_tiles_x * kTilePx;
                const int y0 = static_cast<int>(tile_idx) / num_tiles_x * kTilePx;
                body({x0,
                      y0,
                      std::min(x0 + kTilePx, view.width_px),
                      std::min(y0 + kTilePx, view.height_px)});
              });
}

}  // namespace

Image<float> RenderCachedRadiance(const CachedLightTracer& tracer,
                                  const LensRaster& raster,
                                  const View& view,
                                  const PixelSampling& sampling,
                                  int num_threads,
                                  Progress* progress,
                                  const std::function<std::string(int x, int y)>& describe_pixel,
                                  CellFilm* film) {
  ViewSampler sampler(tracer, raster, view, sampling, num_threads, film);
  const auto for_each_pixel = [&](const auto& num_samples_at) {
    ForEachTile(view, num_threads, [&](const Tile& tile) {
      PixelContext context(describe_pixel);
      const FailureContext scope(&context);
      PacketBuilder builder(tracer);
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
          context.x = x;
          context.y = y;
          sampler.SampleUpTo(num_samples_at(x, y), x, y, builder);
        }
      }
      builder.Flush();
    });
  };
  for_each_pixel([&](int, int) { return sampling.num_samples; });

  if (sampling.max_samples > sampling.num_samples) {
    Image<int> needed(view.width_px, view.height_px, 1);
    ParallelFor(static_cast<size_t>(view.height_px), num_threads, [&](size_t row) {
      for (int x = 0; x < view.width_px; ++x) {
        needed.At(x, static_cast<int>(row)) = sampler.NumSamplesNeeded(x, static_cast<int>(row));
      }
    });
    // A neighbour that differs says that an edge is near, which the first samples here may have
    // missed.
    for_each_pixel([&](int x, int y) {
      int most = 0;
      for (int j = std::max(0, y - 1); j <= std::min(view.height_px - 1, y + 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(view.width_px - 1, x + 1); ++i) {
          most = std::max(most, needed.At(i, j));
        }
      }
      return most;
    });
  }

  Image<float> image(view.width_px, view.height_px, 3);
  for (int y = 0; y < view.height_px; ++y) {
    for (int x = 0; x < view.width_px; ++x) {
      const PixelSums& sums = sampler.SumsOf(x, y);
      for (int channel = 0; channel < 3; ++channel) {
        image.At(x, y, channel) = sums.radiance[channel] / static_cast<float>(sums.num_samples);
      }
    }
  }
  if (progress != nullptr) {
    progress->Advance(image.NumPixels());
  }
  return image;
}

std::vector<LightStore::RecordId> WantedRecords(const CachedLightTracer& tracer,
                                                const LensRaster& raster,
                                                const View& view,
                                                const PixelSampling& sampling,
                                                int num_threads) {
  ViewSampler sampler(tracer, raster, view, sampling, num_threads, nullptr);
  std::vector<LightStore::RecordId> all;
  std::mutex mutex;
  ForEachTile(view, num_threads, [&](const Tile& tile) {
    PacketMarker marker(tracer);
    for (int y = tile.y0; y < tile.y1; y += kMarkingStepPx) {
      for (int x = tile.x0; x < tile.x1; x += kMarkingStepPx) {
        sampler.SampleUpTo(1, x, y, marker);
      }
    }
    marker.Flush();
    const std::lock_guard lock(mutex);
    all.insert(all.end(), marker.Missing().begin(), marker.Missing().end());
  });
  return all;
}

}  // namespace pfseq
