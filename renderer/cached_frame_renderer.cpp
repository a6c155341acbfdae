// SPDX-License-Identifier: Apache-2.0
#include "renderer/cached_frame_renderer.h"

#include "renderer/core/parallel.h"
#include "renderer/pixel_context.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <optional>

namespace pfseq {
namespace {

constexpr int kTilePx = 16;

/// Textures are filtered over this share of a stratum's sides: the interpolation between texels
/// widens the filter by the rest.
constexpr float kFootprintShare = 0.6F;

/// The strata of a pixel's first samples: the columns and rows of a grid of which each cell holds
/// one of the first num_samples points of the sampler's sequence, if that is a power of two.
struct Strata {
  explicit Strata(int num_samples) {
    constexpr int kMaxStrata = 64;
    const auto bits = static_cast<int>(std::bit_width(
                          static_cast<unsigned>(std::clamp(num_samples, 1, kMaxStrata)))) -
                      1;
    columns = static_cast<float>(1 << ((bits + 1) / 2));
    rows = static_cast<float>(1 << (bits / 2));
  }
  Vec2f Middle(const Vec2f& place) const {
    return {(std::floor(place.x() * columns) + 0.5F) / columns,
            (std::floor(place.y() * rows) + 0.5F) / rows};
  }
  float columns;
  float rows;
};

/// What is known of a pixel: sums over its samples.
struct PixelSums {
  Rgb radiance = Rgb::Zero();
  /// Of the first half of the first samples.
  float half_luminance = 0.0F;
  int num_samples = 0;
};

/// The directions of one pixel in the world.
class PixelRays {
 public:
  PixelRays(const LensRaster& raster, const RigidTransform& world_from_camera, int x, int y)
      : lens_(raster.OwnLens()),
        world_from_camera_(world_from_camera),
        corner_px_(x, y),
        is_inside_(raster.IsInside(x, y)) {
    if (is_inside_) {
      const std::array<Vec3f, 4> corners = raster.CornerDirections(x, y);
      const Eigen::Matrix3f rotation = world_from_camera.rotation.toRotationMatrix().cast<float>();
      origin_ = rotation * corners[0];
      along_x_ = rotation * (corners[1] - corners[0]);
      along_y_ = rotation * (corners[2] - corners[0]);
      twist_ = rotation * (corners[3] - corners[2] - corners[1] + corners[0]);
    }
  }

  /// The unit direction of a place in the pixel, both coordinates in [0, 1); nothing outside the
  /// field of view.
  std::optional<Vec3f> Direction(const Vec2f& place) const {
    if (is_inside_) {
      return Vec3f(origin_ + place.x() * along_x_ + place.y() * (along_y_ + place.x() * twist_))
          .normalized();
    }
    const std::optional<Vec3d> direction = lens_.Unproject(corner_px_ + place.cast<double>());
    if (!direction.has_value()) {
      return std::nullopt;
    }
    return Vec3f(world_from_camera_.Direction(*direction).cast<float>());
  }

  /// The bundle of a sample at `place` that stands for the stratum around `middle`.
  RayFootprint Footprint(const Vec2f& place, const Vec2f& middle, const Strata& strata) const {
    if (!is_inside_) {
      // The rim: narrow, and never far from its own place.
      const float pixel = static_cast<float>(1.0 / lens_.FocalPx().minCoeff());
      return {Vec3f::Zero(), Vec3f::Constant(0.5F * pixel / strata.columns), Vec3f::Zero()};
    }
    const Vec3f dx = along_x_ + place.y() * twist_;
    const Vec3f dy = along_y_ + place.x() * twist_;
    return {(middle.x() - place.x()) * dx + (middle.y() - place.y()) * dy,
            dx * (kFootprintShare / strata.columns),
            dy * (kFootprintShare / strata.rows)};
  }

 private:
  const Lens& lens_;
  const RigidTransform& world_from_camera_;
  Vec2d corner_px_;
  bool is_inside_;
  Vec3f origin_ = Vec3f::Zero();
  Vec3f along_x_ = Vec3f::Zero();
  Vec3f along_y_ = Vec3f::Zero();
  Vec3f twist_ = Vec3f::Zero();
};

/// Collects samples until a packet is full, then traces it and adds the results to their pixels.
class PacketBuilder {
 public:
  PacketBuilder(const CachedLightTracer& tracer, const Vec3d& origin_m)
      : tracer_(tracer), origin_m_(origin_m.cast<float>()) {}

  void Add(const Vec3f& direction,
           const RayFootprint& footprint,
           const PixelSampler& sampler,
           bool is_first_half,
           PixelSums& sums) {
    const auto lane = static_cast<size_t>(count_);
    packet_.rays.Set(count_, origin_m_, direction);
    packet_.footprints[lane] = footprint;
    packet_.samplers[lane] = sampler;
    sums_[lane] = &sums;
    half_weights_[lane] = is_first_half ? 1.0F : 0.0F;
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
        sums_[lane]->radiance += value;
        sums_[lane]->half_luminance += half_weights_[lane] * Luminance(value);
      }
    }
    packet_.rays.active = 0;
    count_ = 0;
  }

 private:
  const CachedLightTracer& tracer_;
  Vec3f origin_m_;
  CameraPacket packet_;
  std::array<PixelSums*, kPacketSize> sums_{};
  std::array<float, kPacketSize> half_weights_{};
  int count_ = 0;
};

/// Renders pixels of a view into their sums.
class ViewSampler {
 public:
  ViewSampler(const CachedLightTracer& tracer,
              const LensRaster& raster,
              const View& view,
              const PixelSampling& sampling)
      : tracer_(tracer),
        raster_(raster),
        view_(view),
        sampling_(sampling),
        strata_(sampling.num_samples),
        sums_(static_cast<size_t>(view.width_px) * static_cast<size_t>(view.height_px)) {}

  PixelSums& SumsOf(int x, int y) { return sums_[Index(x, y)]; }

  /// Adds samples to a pixel up to the given number.
  void SampleUpTo(int num_samples, int x, int y, PacketBuilder& builder) {
    PixelSums& sums = SumsOf(x, y);
    const int first = sums.num_samples;
    sums.num_samples = num_samples;
    if (raster_.IsOutside(x, y)) {
      return;
    }
    const PixelRays rays(raster_, view_.world_from_camera, x, y);
    const PixelSampler pixel(
        view_.seed, view_.frame, view_.view_idx, static_cast<uint64_t>(Index(x, y)), 0);
    for (int i = first; i < num_samples; ++i) {
      PixelSampler sampler = pixel.ForSample(static_cast<uint32_t>(i));
      const Vec2f place = sampler.Get2D().cast<float>().cwiseMin(kBelowOne);
      const std::optional<Vec3f> direction = rays.Direction(place);
      if (direction.has_value()) {
        builder.Add(*direction,
                    rays.Footprint(place, strata_.Middle(place), strata_),
                    sampler,
                    i < sampling_.num_samples / 2,
                    sums);
      }
    }
  }

  /// How many samples a pixel needs by what its first ones say. Each half of them covers the pixel
  /// evenly, so what the halves differ by is what samples miss, not what the pixel shows.
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
    const float needed =
        std::ceil(excess * excess) * static_cast<float>(std::max(kPacketSize, sums.num_samples));
    return static_cast<int>(std::min(needed, static_cast<float>(sampling_.max_samples)));
  }

 private:
  static constexpr float kBelowOne = 0x1.fffffep-1F;

  size_t Index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(view_.width_px) + static_cast<size_t>(x);
  }

  const CachedLightTracer& tracer_;
  const LensRaster& raster_;
  const View& view_;
  PixelSampling sampling_;
  Strata strata_;
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
                                  const std::function<std::string(int x, int y)>& describe_pixel) {
  ViewSampler sampler(tracer, raster, view, sampling);
  const auto for_each_pixel = [&](const auto& num_samples_at) {
    ForEachTile(view, num_threads, [&](const Tile& tile) {
      PixelContext context(describe_pixel);
      const FailureContext scope(&context);
      PacketBuilder builder(tracer, view.world_from_camera.translation_m);
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
                                                int num_threads) {
  std::vector<LightStore::RecordId> all;
  std::mutex mutex;
  const Eigen::Matrix3d rotation = view.world_from_camera.rotation.toRotationMatrix();
  const Vec3f origin_m = view.world_from_camera.translation_m.cast<float>();
  ForEachTile(view, num_threads, [&](const Tile& tile) {
    std::vector<LightStore::RecordId> missing;
    RayPacket packet;
    int count = 0;
    const auto flush = [&] {
      tracer.WantRecords(packet, missing);
      packet.active = 0;
      count = 0;
    };
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0 + y % 2; x < tile.x1; x += 2) {
        const std::optional<Vec3d> direction = raster.CentreDirection(x, y);
        if (direction.has_value()) {
          packet.Set(count, origin_m, Vec3d(rotation * *direction).cast<float>());
          if (++count == kPacketSize) {
            flush();
          }
        }
      }
    }
    flush();
    const std::lock_guard lock(mutex);
    all.insert(all.end(), missing.begin(), missing.end());
  });
  return all;
}

}  // namespace pfseq
