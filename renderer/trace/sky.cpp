// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/sky.h"

#include "renderer/trace/clouds.h"
#include "renderer/trace/sky_map.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace pfseq {
namespace {

/// Nodes a side of the image of a cloudless sky: 0.21 degrees apart at most. It is within a few in
/// 10000 of the formula but for the cusp at the sun's centre.
constexpr int kClearNodes = 769;
/// Nodes a side of a sky with details: 0.13 degrees apart at most, which is less than a pixel of a
/// fisheye image 1200 px wide.
constexpr int kDetailedNodes = 1217;
/// Below the horizon of a map.
constexpr int kLowerMapNodes = 641;
/// Below the horizon where all is the same: as many as give even samples.
constexpr int kGroundNodes = 513;
/// Intervals of an image in a cell of its sampler, a side.
constexpr int kCellIntervals = 4;

constexpr float kGroundAlbedo = 0.2F;
/// Least share of the samples for each half of a sky that has light.
constexpr double kLeastShare = 0.02;
constexpr double kUniformPdf = 0.25 * std::numbers::inv_pi;

/// What lies below the horizon of a sky without a picture of it.
DomeImage GroundUnder(const DomeImage& upper) {
  const Rgb radiance =
      upper.HorizontalIrradiance() * (kGroundAlbedo * std::numbers::inv_pi_v<float>);
  return {kGroundNodes, [&](const Vec3d& /*direction*/) { return radiance; }};
}

}  // namespace

Sky::Images::Images(DomeImage upper_image, DomeImage lower_image)
    : upper(std::move(upper_image)),
      lower(std::move(lower_image)),
      upper_sampler(upper, kCellIntervals),
      lower_sampler(lower, kCellIntervals) {
  const double total = upper_sampler.Total() + lower_sampler.Total();
  const double share = total > 0.0 ? upper_sampler.Total() / total : 0.5;
  upper_share = kLeastShare + (1.0 - 2.0 * kLeastShare) * share;
}

Sky::Sky(DomeImage upper, DomeImage lower)
    : images_(std::make_shared<const Images>(std::move(upper), std::move(lower))) {
  is_black_ = images_->upper_sampler.Total() + images_->lower_sampler.Total() <= 0.0;
  horizontal_irradiance_ = images_->upper.HorizontalIrradiance();
}

Sky Sky::Constant(const Rgb& radiance) {
  Sky sky;
  sky.constant_ = radiance;
  sky.horizontal_irradiance_ = std::numbers::pi_v<float> * radiance;
  sky.is_black_ = radiance.maxCoeff() <= 0.0F;
  return sky;
}

Sky Sky::Clear(const Vec3d& direction_to_sun, double turbidity, double strength) {
  const ClearSky clear(direction_to_sun, turbidity, strength);
  DomeImage upper(kClearNodes, [&](const Vec3d& direction) { return clear.Radiance(direction); });
  DomeImage lower = GroundUnder(upper);
  return {std::move(upper), std::move(lower)};
}

Sky Sky::With(const Clouds& clouds) const {
  DomeImage upper(kDetailedNodes, [&](const Vec3d& direction) {
    const Rgb behind = Radiance(direction);
    const Clouds::Layer layer = clouds.Toward(direction, behind);
    return Rgb(layer.radiance + layer.transmittance * behind);
  });
  DomeImage lower = GroundUnder(upper);
  return {std::move(upper), std::move(lower)};
}

Sky Sky::FromMap(const SkyMap& map, double strength) {
  const auto factor = static_cast<float>(strength);
  return {DomeImage(kDetailedNodes,
                    [&](const Vec3d& direction) { return Rgb(factor * map.Radiance(direction)); }),
          DomeImage(kLowerMapNodes, [&](const Vec3d& direction) {
            const Vec3d mirrored(direction.x(), direction.y(), -direction.z());
            return Rgb(factor * map.Radiance(mirrored));
          })};
}

Sky::DirectionSample Sky::SampleDirection(const Vec2d& sample) const {
  if (images_ == nullptr) {
    const double z = 1.0 - 2.0 * sample.y();
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    const double azimuth_rad = 2.0 * std::numbers::pi * sample.x();
    return {{radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), z}, kUniformPdf};
  }
  const double upper_share = images_->upper_share;
  Vec3d direction;
  if (sample.y() < upper_share) {
    direction = images_->upper_sampler.Sample({sample.x(), sample.y() / upper_share});
  } else {
    const double rest = (sample.y() - upper_share) / (1.0 - upper_share);
    direction = images_->lower_sampler.Sample({sample.x(), std::min(rest, 1.0 - 0x1.0p-53)});
    direction.z() = -direction.z();
  }
  return {direction, Pdf(direction)};
}

double Sky::Pdf(const Vec3d& direction) const {
  if (images_ == nullptr) {
    return kUniformPdf;
  }
  return direction.z() >= 0.0
             ? images_->upper_share * images_->upper_sampler.Pdf(direction)
             : (1.0 - images_->upper_share) * images_->lower_sampler.Pdf(direction);
}

}  // namespace pfseq
