// SPDX-License-Identifier: Apache-2.0
#include "renderer/frame_renderer.h"

#include "renderer/core/parallel.h"
#include "renderer/pixel_context.h"
#include "renderer/trace/sampler.h"

#include <algorithm>
#include <optional>

namespace pfseq {
namespace {

// Neighbouring pixels meet the same parts of the scene: a tile's data stays in the cache.
constexpr int kTilePx = 16;

}  // namespace

Rgb RenderPixel(
    const PathTracer& tracer, const View& view, int num_samples, int x, int y, CellFilm* film) {
  const uint64_t pixel_idx =
      static_cast<uint64_t>(y) * static_cast<uint64_t>(view.width_px) + static_cast<uint64_t>(x);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int i = 0; i < num_samples; ++i) {
    PixelSampler sampler(view.seed, view.frame, view.view_idx, pixel_idx, static_cast<uint32_t>(i));
    const Vec2d place = sampler.Get2D();
    const std::optional<Vec3d> direction_camera = view.lens->Unproject(Vec2d(x, y) + place);
    Rgb radiance = Rgb::Zero();
    if (direction_camera.has_value()) {
      Vec3d origin_m = view.world_from_camera.translation_m;
      Vec3d direction = view.world_from_camera.Direction(*direction_camera);
      if (view.exposure != nullptr && !view.exposure->IsStill()) {
        const Vec2d image_place((x + place.x()) / view.width_px, (y + place.y()) / view.height_px);
        const ExposurePoses::Pose pose =
            view.exposure->At(view.exposure->OwnShutter().TimeS(sampler.Get2D(), image_place));
        origin_m = pose.origin_m.cast<double>();
        direction = (pose.world_from_camera.cast<double>() * *direction_camera).normalized();
      }
      radiance = tracer.Radiance(origin_m, direction, sampler);
      sum += radiance.cast<double>();
    }
    if (film != nullptr) {
      CellFilm::Cell& cell = film->At(x, y, place.cast<float>());
      cell.sum += radiance;
      cell.num_samples += 1.0F;
    }
  }
  return (sum / num_samples).cast<float>();
}

Image<float> RenderRadiance(const PathTracer& tracer,
                            const View& view,
                            int num_samples,
                            int num_threads,
                            Progress* progress,
                            const std::function<std::string(int x, int y)>& describe_pixel,
                            CellFilm* film) {
  Image<float> image(view.width_px, view.height_px, 3);
  const int num_tiles_x = (view.width_px + kTilePx - 1) / kTilePx;
  const int num_tiles_y = (view.height_px + kTilePx - 1) / kTilePx;
  ParallelFor(
      static_cast<size_t>(num_tiles_x) * static_cast<size_t>(num_tiles_y),
      num_threads,
      [&](size_t tile_idx) {
        const int x0 = static_cast<int>(tile_idx) % num_tiles_x * kTilePx;
        const int y0 = static_cast<int>(tile_idx) / num_tiles_x * kTilePx;
        const int x1 = std::min(x0 + kTilePx, view.width_px);
        const int y1 = std::min(y0 + kTilePx, view.height_px);
        PixelContext context(describe_pixel);
        const FailureContext scope(&context);
        for (int y = y0; y < y1; ++y) {
          for (int x = x0; x < x1; ++x) {
            context.x = x;
            context.y = y;
            const Rgb radiance = RenderPixel(tracer, view, num_samples, x, y, film);
            for (int channel = 0; channel < 3; ++channel) {
              image.At(x, y, channel) = radiance[channel];
            }
          }
        }
        if (progress != nullptr) {
          progress->Advance(static_cast<uint64_t>(x1 - x0) * static_cast<uint64_t>(y1 - y0));
        }
      });
  return image;
}

}  // namespace pfseq
