// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/path_tracer.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace pfseq {
namespace {

/// The first scattering event after which a path may end early.
constexpr int kFirstRouletteBounce = 3;

/// The direction of a camera ray is not the BSDF's choice: no other way of sampling competes with
/// it.
constexpr double kCameraPdf = std::numeric_limits<double>::infinity();

/// Veach 1997, equation (9.13) with an exponent of 2: the weight of a sample with density `pdf`
/// where the other way has density `other_pdf`.
float PowerHeuristic(double pdf, double other_pdf) {
  const double ratio = other_pdf / pdf;
  return static_cast<float>(1.0 / (1.0 + ratio * ratio));
}

}  // namespace

PathTracer::PathTracer(const RayScene& scene,
                       const TextureSet& textures,
                       const Lighting& lighting,
                       const PathTracerOptions& options)
    : scene_(scene), textures_(textures), lighting_(lighting), options_(options) {}

Rgb PathTracer::Radiance(const Vec3d& origin_m,
                         const Vec3d& direction,
                         PixelSampler& sampler) const {
  Rgb radiance = Rgb::Zero();
  Rgb throughput = Rgb::Ones();
  Vec3d ray_origin_m = origin_m;
  Vec3d ray_direction = direction;
  double bsdf_pdf = kCameraPdf;
  for (int bounce = 0;; ++bounce) {
    const std::optional<RayHit> hit = scene_.Intersect(ray_origin_m, ray_direction);
    if (!hit.has_value()) {
      radiance += throughput * EscapedLight(ray_direction, bsdf_pdf);
      break;
    }
    const SurfacePoint point(scene_.PlainScene(),
                             textures_,
                             *hit,
                             ray_direction,
                             bounce == 0 ? 0.0F : options_.min_indirect_roughness);
    radiance += throughput * point.Emission();
    if (bounce >= options_.max_bounces) {
      break;
    }
    sampler.StartVertex(bounce);
    const Vec2d direction_sample = sampler.Get2D();
    const double lobe_sample = sampler.Get1D();
    const Vec2d sun_sample = sampler.Get2D();
    const Vec2d sky_sample = sampler.Get2D();
    radiance += throughput * (SunLight(point, sun_sample) + SkyLight(point, sky_sample));

    const std::optional<BsdfSample> sample = point.Sample(lobe_sample, direction_sample);
    if (!sample.has_value()) {
      break;
    }
    throughput *= sample->weight;
    if (bounce + 1 >= kFirstRouletteBounce) {
      const double survival = std::min(1.0, static_cast<double>(throughput.maxCoeff()));
      if (!(sampler.Get1D() < survival)) {
        break;
      }
      throughput /= static_cast<float>(survival);
    }
    bsdf_pdf = sample->pdf;
    ray_origin_m = point.RayOriginM();
    ray_direction = sample->to_light;
  }
  // A triangle without area has no normal; what came of it must not spoil the whole pixel.
  return radiance.isFinite().all() ? radiance : Rgb(Rgb::Zero());
}

Rgb PathTracer::EscapedLight(const Vec3d& direction, double bsdf_pdf) const {
  Rgb light = Rgb::Zero();
  if (!lighting_.sky.IsBlack()) {
    light =
        lighting_.sky.Radiance(direction) * PowerHeuristic(bsdf_pdf, lighting_.sky.Pdf(direction));
  }
  if (lighting_.sun.has_value() && lighting_.sun->Contains(direction)) {
    light += lighting_.sun->Radiance() * PowerHeuristic(bsdf_pdf, lighting_.sun->Pdf());
  }
  return light;
}

Rgb PathTracer::SunLight(const SurfacePoint& point, const Vec2d& sample) const {
  if (!lighting_.sun.has_value()) {
    return Rgb::Zero();
  }
  const Vec3d to_light = lighting_.sun->SampleDirection(sample);
  const BsdfValue value = point.Evaluate(to_light);
  if (value.value_cosine.maxCoeff() <= 0.0F || scene_.Occluded(point.RayOriginM(), to_light)) {
    return Rgb::Zero();
  }
  const double pdf = lighting_.sun->Pdf();
  return value.value_cosine * lighting_.sun->Radiance() *
         (PowerHeuristic(pdf, value.pdf) / static_cast<float>(pdf));
}

Rgb PathTracer::SkyLight(const SurfacePoint& point, const Vec2d& sample) const {
  if (lighting_.sky.IsBlack()) {
    return Rgb::Zero();
  }
  const Sky::DirectionSample light = lighting_.sky.SampleDirection(sample);
  const BsdfValue value = point.Evaluate(light.direction);
  if (value.value_cosine.maxCoeff() <= 0.0F ||
      scene_.Occluded(point.RayOriginM(), light.direction)) {
    return Rgb::Zero();
  }
  return value.value_cosine * lighting_.sky.Radiance(light.direction) *
         (PowerHeuristic(light.pdf, value.pdf) / static_cast<float>(light.pdf));
}

}  // namespace pfseq
