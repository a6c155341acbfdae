// SPDX-License-Identifier: Apache-2.0
#include "renderer/metering.h"

#include "renderer/core/units.h"
#include "renderer/film/exposure.h"
#include "renderer/frame_renderer.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/trace/path_tracer.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/texture.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

constexpr int kWidthPx = 96;
constexpr int kNumSamples = 32;

/// Keeps a black pixel from deciding all, relative to the mean.
constexpr double kLeastShare = 1e-3;

/// Pixels on the rim are dark in part.
bool IsInside(const Lens& lens, int x, int y) {
  for (const int corner : {0, 1, 2, 3}) {
    if (!lens.Unproject(Vec2d(x + corner % 2, y + corner / 2)).has_value()) {
      return false;
    }
  }
  return true;
}

}  // namespace

double MeteredExposure(const SequenceSpec& spec,
                       const std::shared_ptr<const Scene>& scene,
                       const Lighting& lighting,
                       int num_threads) {
  SequenceSpec small = spec;
  LensSpec& lens_spec = small.lenses.front().value;
  if (lens_spec.image_width_px == 0) {
    lens_spec.image_width_px = spec.image.size_px[0];
  }
  small.image.size_px = {
      kWidthPx,
      std::max(1,
               static_cast<int>(std::lround(static_cast<double>(kWidthPx) * spec.image.size_px[1] /
                                            spec.image.size_px[0])))};
  const Lens lens = MakeLenses(small).front().value;
  const RayScene rays(scene);
  const TextureSet textures(*scene);
  const PathTracer tracer(
      rays,
      textures,
      lighting,
      {.max_bounces = spec.render.max_bounces,
       .min_indirect_roughness = static_cast<float>(spec.render.min_indirect_roughness)});
  const View view{.lens = &lens,
                  .world_from_camera = FramePoses(spec.trajectory).front().world_from_rig *
                                       MakeCameras(spec).front().rig_from_camera,
                  .width_px = small.image.size_px[0],
                  .height_px = small.image.size_px[1]};
  const Image<float> radiance =
      RenderRadiance(tracer, view, kNumSamples, num_threads, nullptr, {}, nullptr);
  std::vector<double> luminances;
  double sum = 0.0;
  for (int y = 0; y < view.height_px; ++y) {
    for (int x = 0; x < view.width_px; ++x) {
      if (IsInside(lens, x, y)) {
        luminances.push_back(
            Luminance(Rgb(radiance.At(x, y, 0), radiance.At(x, y, 1), radiance.At(x, y, 2))));
        sum += luminances.back();
      }
    }
  }
  const double least = kLeastShare * sum / static_cast<double>(luminances.size());
  double sum_of_logs = 0.0;
  for (const double luminance : luminances) {
    sum_of_logs += std::log(std::max(luminance, least));
  }
  return ExposureForMean(sum > 0.0 ? std::exp(sum_of_logs / static_cast<double>(luminances.size()))
                                   : 0.0);
}

}  // namespace pfseq
