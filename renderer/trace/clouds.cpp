// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/clouds.h"

#include "renderer/core/check.h"
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/trace/material.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

constexpr double kEarthRadiusM = 6.371e6;
constexpr double kBaseM = 1500.0;
constexpr double kVeilM = 6000.0;
/// Height of the tallest clouds over their base, and the excess of the noise over the threshold at
/// which a cloud has half of it.
constexpr float kMaxHeightM = 900.0F;
constexpr float kHalfExcess = 0.28F;
/// Extinction inside a cloud, the excess at which it has come to that, and the depth below the top
/// over which it does.
constexpr float kExtinctionPerM = 0.028F;
constexpr float kSoftExcess = 0.5F;
constexpr float kSoftTopM = 200.0F;
/// Steps of a ray through the cumulus.
constexpr int kMinSteps = 6;
constexpr int kMaxSteps = 24;
constexpr float kStepM = 75.0F;
/// A ray that has lost this much goes no further.
constexpr float kOpaque = 0.01F;
constexpr float kAsymmetry = 0.85F;
/// How far and how strongly the finer tile displaces and adds to the coarser one.
constexpr float kWarpM = 70.0F;
constexpr float kDetailWeight = 0.12F;
/// Metres that the details move aside with each metre of height.
constexpr float kShear = 0.6F;
/// Pixels of the coarser tile in a square of its bound, a side.
constexpr int kBoundPx = 8;
constexpr int kNumBounds = NoiseTile::kSizePx / kBoundPx;
/// Distance over which air of turbidity 1 takes away 1 - 1/e of the light.
constexpr float kAirM = 60000.0F;
constexpr float kGroundAlbedo = 0.2F;
constexpr double kGoldenAngleRad = std::numbers::pi * (3.0 - 2.23606797749978969);
constexpr float kInvPi = std::numbers::inv_pi_v<float>;

/// Henyey and Greenstein 1941, per steradian.
float HenyeyGreenstein(float cos_angle, float g) {
  const float denominator = 1.0F + g * g - 2.0F * g * cos_angle;
  return 0.25F * kInvPi * (1.0F - g * g) / (denominator * std::sqrt(denominator));
}

float SunPhase(float cos_angle) {
  return 0.7F * HenyeyGreenstein(cos_angle, kAsymmetry) +
         0.3F * HenyeyGreenstein(cos_angle, -0.15F);
}

float HeightM(float excess) { return kMaxHeightM * excess / (excess + kHalfExcess); }

/// Share of the light that comes through a cloud by many scatterings.
float Diffused(float optical_depth) {
  return 1.0F / (1.0F + 0.75F * (1.0F - kAsymmetry) * optical_depth);
}

/// Distance to a shell of the given height over the ground.
double ShellDistanceM(double sin_elevation, double height_m) {
  const double up_m = kEarthRadiusM * sin_elevation;
  return std::sqrt(up_m * up_m + height_m * (2.0 * kEarthRadiusM + height_m)) - up_m;
}

}  // namespace

Clouds::Clouds(double share, uint64_t seed, const CloudLight& light)
    : light_(light),
      to_sun_(light.direction_to_sun.x(),
              light.direction_to_sun.y(),
              std::max(0.0, light.direction_to_sun.z())),
      ground_irradiance_(kGroundAlbedo *
                         (light.sky_irradiance + light.sun_irradiance * to_sun_.z())),
      places_(15000.0,
              {{NoiseOctave::Kind::kGradient, 4, 0.33F},
               {NoiseOctave::Kind::kGradient, 9, 0.33F},
               {NoiseOctave::Kind::kGradient, 19, 0.22F},
               {NoiseOctave::Kind::kBillow, 17, 0.33F},
               {NoiseOctave::Kind::kBillow, 37, 0.16F},
               {NoiseOctave::Kind::kBillow, 79, 0.08F}},
              HashKey({seed, 1})),
      details_(2500.0,
               {{NoiseOctave::Kind::kBillow, 20, 0.45F},
                {NoiseOctave::Kind::kBillow, 45, 0.25F},
                {NoiseOctave::Kind::kGradient, 60, 0.22F},
                {NoiseOctave::Kind::kGradient, 130, 0.08F}},
               HashKey({seed, 2})) {
  PFSEQ_CHECK(share > 0.0 && share <= 1.0, "share {}", share);
  veil_amount_ = static_cast<float>(std::min(1.0, share / 0.3));
  BoundPlaces();
  CalibrateThreshold(share);
}

void Clouds::BoundPlaces() {
  float greatest_detail = 0.0F;
  float displacement = 0.0F;
  for (int row = 0; row < NoiseTile::kSizePx; ++row) {
    for (int column = 0; column < NoiseTile::kSizePx; ++column) {
      const Vec2f& detail = details_.Pixel(column, row);
      greatest_detail = std::max(greatest_detail, detail.x());
      displacement = std::max(displacement, detail.lpNorm<Eigen::Infinity>());
    }
  }
  // A point of a square reaches this far beyond it: the displacement, and the next pixel.
  const int reach = static_cast<int>(std::ceil(displacement * kWarpM * places_.PixelsAMetre())) + 1;
  place_bounds_.assign(static_cast<size_t>(kNumBounds) * kNumBounds, -1e9F);
  for (int row = 0; row < kNumBounds; ++row) {
    for (int column = 0; column < kNumBounds; ++column) {
      float& bound = place_bounds_[static_cast<size_t>(row) * kNumBounds + column];
      for (int y = row * kBoundPx - reach; y < (row + 1) * kBoundPx + reach; ++y) {
        for (int x = column * kBoundPx - reach; x < (column + 1) * kBoundPx + reach; ++x) {
          bound = std::max(bound, places_.Pixel(x, y).x());
        }
      }
      bound += kDetailWeight * greatest_detail;
    }
  }
}

void Clouds::SetThreshold(float threshold) {
  threshold_ = threshold;
  height_bounds_m_.resize(place_bounds_.size());
  for (size_t i = 0; i < place_bounds_.size(); ++i) {
    const float excess = place_bounds_[i] - threshold_;
    height_bounds_m_[i] = excess > 0.0F ? HeightM(excess) : 0.0F;
  }
}

void Clouds::CalibrateThreshold(double share) {
  // Directions at even steps of z, so each stands for the same solid angle, turned by the golden
  // angle.
  constexpr int kNumDirections = 4000;
  float least = -3.0F;
  float most = 3.0F;
  for (int i = 0; i < 13; ++i) {
    SetThreshold(0.5F * (least + most));
    std::atomic<int> num_covered = 0;
    ParallelFor(kNumDirections, NumHardwareThreads(), [&](size_t k) {
      const double z = (static_cast<double>(k) + 0.5) / kNumDirections;
      const double azimuth_rad = kGoldenAngleRad * static_cast<double>(k);
      const double radius = std::sqrt(1.0 - z * z);
      if (Transmittance({radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), z}) <
          0.5F) {
        ++num_covered;
      }
    });
    (num_covered > share * kNumDirections ? least : most) = threshold_;
  }
}

float Clouds::HeightBoundM(const Vec3f& point_m) const {
  const float squares_a_metre = places_.PixelsAMetre() / kBoundPx;
  const int column = static_cast<int>(std::floor(point_m.x() * squares_a_metre)) & (kNumBounds - 1);
  const int row = static_cast<int>(std::floor(point_m.y() * squares_a_metre)) & (kNumBounds - 1);
  return height_bounds_m_[static_cast<size_t>(row) * kNumBounds + column];
}

Clouds::Way Clouds::CumulusWay(const Vec3d& direction) const {
  const double distance_m = ShellDistanceM(direction.z(), kBaseM);
  // The layer is a shell: a ray meets it steeper than it leaves the ground.
  const double sin_there = (kEarthRadiusM * direction.z() + distance_m) / (kEarthRadiusM + kBaseM);
  const double cos_there = std::sqrt(std::max(0.0, 1.0 - sin_there * sin_there));
  const Vec2d horizontal = direction.head<2>();
  const Vec2d ahead =
      horizontal.norm() > 0.0 ? Vec2d(horizontal.normalized()) : Vec2d(Vec2d::UnitX());
  const double length_m = kMaxHeightM / sin_there;
  Way way;
  way.num_steps = std::clamp(static_cast<int>(length_m / kStepM), kMinSteps, kMaxSteps);
  way.step_length_m = static_cast<float>(length_m / way.num_steps);
  way.distance_m = static_cast<float>(distance_m);
  const Vec2d start_m = horizontal * distance_m;
  way.start_m = Vec3d(start_m.x(), start_m.y(), 0.0).cast<float>();
  way.step_m = way.step_length_m *
               Vec3d(ahead.x() * cos_there, ahead.y() * cos_there, sin_there).cast<float>();
  return way;
}

float Clouds::ExtinctionPerM(const Vec3f& point_m) const {
  if (point_m.z() >= HeightBoundM(point_m)) {
    return 0.0F;
  }
  // Sheared, so that the details of a cloud's side change with the height.
  const Vec2f detail =
      details_.At(point_m.x() + kShear * point_m.z(), point_m.y() - kShear * point_m.z());
  const float place =
      places_.At(point_m.x() + kWarpM * detail.x(), point_m.y() + kWarpM * detail.y()).x();
  const float excess = place + kDetailWeight * detail.x() - threshold_;
  if (excess <= 0.0F) {
    return 0.0F;
  }
  const float below_top = std::clamp((HeightM(excess) - point_m.z()) / kSoftTopM, 0.0F, 1.0F);
  return kExtinctionPerM * below_top * std::min(1.0F, excess / kSoftExcess);
}

float Clouds::MeanExtinctionPerM(const Vec3f& point_m, float length_m) const {
  if (point_m.z() >= HeightBoundM(point_m) + length_m) {
    return 0.0F;
  }
  const float excess = places_.At(point_m.x(), point_m.y()).x() - threshold_;
  if (excess <= 0.0F) {
    return 0.0F;
  }
  const float below_top = std::clamp((HeightM(excess) - point_m.z()) / length_m + 0.5F, 0.0F, 1.0F);
  return kExtinctionPerM * below_top * std::min(1.0F, excess / kSoftExcess);
}

Rgb Clouds::Source(const Vec3f& point_m, float sun_phase) const {
  // Optical depth toward the sun, in steps that grow with the distance, the far ones without
  // details.
  float depth = 30.0F * ExtinctionPerM(point_m + 15.0F * to_sun_);
  float start_m = 30.0F;
  for (const float length_m : {60.0F, 130.0F, 300.0F}) {
    depth +=
        length_m * MeanExtinctionPerM(point_m + (start_m + 0.5F * length_m) * to_sun_, length_m);
    start_m += length_m;
  }
  const Rgb sun =
      light_.sun_irradiance * (sun_phase * std::exp(-depth) + 0.65F * kInvPi * Diffused(depth));
  const Rgb around = 0.5F * kInvPi *
                     (light_.sky_irradiance * Diffused(depth) +
                      ground_irradiance_ * Diffused(kExtinctionPerM * point_m.z()));
  return sun + around;
}

float Clouds::VeilDepth(const Vec3d& direction) const {
  const double distance_m = ShellDistanceM(direction.z(), kVeilM);
  const Vec2f point_m = (direction.head<2>() * distance_m).cast<float>();
  // Wind draws it out along one direction.
  const Vec2f detail = details_.At(0.22F * point_m.x(), 0.4F * point_m.y());
  const float place =
      places_
          .At(0.25F * point_m.x() + 120.0F * detail.x(), 0.45F * point_m.y() + 120.0F * detail.y())
          .y();
  const float excess = place + 0.35F * detail.x() - 0.02F;
  return excess > 0.0F ? veil_amount_ * 0.8F * excess : 0.0F;
}

Rgb Clouds::VeilSource(float sun_phase, float depth) const {
  return light_.sun_irradiance * (sun_phase * std::exp(-depth) + 0.4F * kInvPi) +
         0.5F * kInvPi * (light_.sky_irradiance + ground_irradiance_);
}

Clouds::Layer Clouds::Toward(const Vec3d& direction, const Rgb& sky_radiance) const {
  const auto turbidity = static_cast<float>(light_.turbidity);
  const float phase = SunPhase(static_cast<float>(direction.dot(light_.direction_to_sun)));
  const auto through_air = [&](const Rgb& radiance, double distance_m) {
    const float clear = std::exp(-static_cast<float>(distance_m) * turbidity / kAirM);
    return Rgb(clear * radiance + (1.0F - clear) * sky_radiance);
  };

  const Way way = CumulusWay(direction);
  Layer layer;
  Rgb scattered = Rgb::Zero();
  Rgb source = Rgb::Zero();
  Vec3f point_m = way.start_m + 0.5F * way.step_m;
  for (int i = 0; i < way.num_steps && layer.transmittance > kOpaque; ++i, point_m += way.step_m) {
    const float extinction = ExtinctionPerM(point_m);
    if (extinction <= 0.0F) {
      continue;
    }
    const float share = layer.transmittance * (1.0F - std::exp(-extinction * way.step_length_m));
    // What adds little may as well have the light of the point before it.
    if (share > 0.02F || (source == 0.0F).all()) {
      source = Source(point_m, phase);
    }
    scattered += share * source;
    layer.transmittance -= share;
  }
  const float covered = 1.0F - layer.transmittance;
  if (covered > 0.0F) {
    layer.radiance = covered * through_air(scattered / covered, way.distance_m);
  }
  const float veil_depth = VeilDepth(direction);
  if (veil_depth > 0.0F) {
    const float passed = std::exp(-veil_depth);
    const Rgb veil =
        through_air(VeilSource(phase, veil_depth), ShellDistanceM(direction.z(), kVeilM));
    layer.radiance += layer.transmittance * (1.0F - passed) * veil;
    layer.transmittance *= passed;
  }
  return layer;
}

float Clouds::CumulusDepth(const Vec3d& direction) const {
  const Way way = CumulusWay(direction);
  float depth = 0.0F;
  Vec3f point_m = way.start_m + 0.5F * way.step_m;
  for (int i = 0; i < way.num_steps; ++i, point_m += way.step_m) {
    depth += ExtinctionPerM(point_m) * way.step_length_m;
  }
  return depth;
}

float Clouds::Transmittance(const Vec3d& direction) const {
  return std::exp(-CumulusDepth(direction) - VeilDepth(direction));
}

float Clouds::SunTransmittance(double angular_diameter_rad) const {
  // Rings of equal solid angle (the disc is small), turned by the golden angle.
  constexpr int kNumSamples = 128;
  const ShadingFrame frame(light_.direction_to_sun);
  float sum = 0.0F;
  for (int i = 0; i < kNumSamples; ++i) {
    const double radius = std::sin(0.5 * angular_diameter_rad) * std::sqrt((i + 0.5) / kNumSamples);
    const double azimuth_rad = kGoldenAngleRad * i;
    Vec3d direction = frame.ToWorld({radius * std::cos(azimuth_rad),
                                     radius * std::sin(azimuth_rad),
                                     std::sqrt(1.0 - radius * radius)});
    direction.z() = std::max(direction.z(), 0.0);
    sum += Transmittance(direction);
  }
  return sum / kNumSamples;
}

}  // namespace pfseq
