// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/flare.h"

#include "renderer/core/parallel.h"
#include "renderer/core/units.h"
#include "renderer/trace/sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace pfseq {
namespace {

constexpr int kMaxImages = 16;
/// Rays to the disc over the whole exposure.
constexpr uint32_t kNumRays = 1024;
constexpr std::array<double, 3> kChannelNm = {610.0, 550.0, 465.0};
/// A spike ends after so many times its length, where 1e-4 of its light is left.
constexpr double kSpikeEnd = 9.0;
constexpr double kCutoffSigmas = 4.0;

/// Area on the film of a solid angle about a direction, px^2 per sr.
double AreaPerSolidAngle(const Lens& lens, const Vec3d& direction_camera) {
  // Off the middle so that all points are inside the field of view, where the direction is.
  constexpr double kStepRad = 1e-4;
  const Vec3d axis = Vec3d::UnitZ();
  Vec3d across = axis.cross(direction_camera);
  if (across.norm() < 1e-6) {
    across = Vec3d::UnitX();
  }
  across.normalize();
  const Vec3d outward = across.cross(direction_camera).normalized();
  const auto project = [&](double in, double side) {
    return lens.Project(
        Vec3d(direction_camera - in * kStepRad * outward + side * kStepRad * across));
  };
  const auto at = [&](double in, double side) {
    const std::optional<Vec2d> pixel = project(in, side);
    return pixel.value_or(Vec2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  };
  const Vec2d along_px = at(3.0, 0.0) - at(1.0, 0.0);
  const Vec2d across_px = at(2.0, 1.0) - at(2.0, -1.0);
  const double area_px2 = std::abs(along_px.x() * across_px.y() - along_px.y() * across_px.x());
  return std::isfinite(area_px2) ? area_px2 / (4.0 * kStepRad * kStepRad) : 0.0;
}

/// The sun in the camera at a time, or nothing.
std::optional<Vec2d> Place(const Lens& lens,
                           const ExposurePoses& poses,
                           const Vec3d& direction_world,
                           double time_s) {
  return lens.Project(poses.At(time_s).world_from_camera.transpose().cast<double>() *
                      direction_world);
}

}  // namespace

std::vector<SunImage> SeenSun(const RayScene& scene,
                              const SunDisc& sun,
                              const Lens& lens,
                              const Vec2d& image_size_px,
                              const ExposurePoses& poses) {
  // The time at which a rolling shutter has its middle where the sun is; a step is enough, as the
  // sun hardly moves.
  const Shutter& shutter = poses.OwnShutter();
  double middle_s = shutter.MiddleS(Vec2d::Constant(0.5));
  Vec2d image_place = Vec2d::Constant(0.5);
  const std::optional<Vec2d> first = Place(lens, poses, sun.DirectionToSun(), middle_s);
  if (first.has_value()) {
    image_place = first->cwiseQuotient(image_size_px).cwiseMax(0.0).cwiseMin(1.0);
  }
  const double start_s = shutter.TimeS(Vec2d(0.0, 0.0), image_place);
  const double end_s = shutter.TimeS(Vec2d(1.0, 1.0), image_place);
  const std::optional<Vec2d> start_px = Place(lens, poses, sun.DirectionToSun(), start_s);
  const std::optional<Vec2d> end_px = Place(lens, poses, sun.DirectionToSun(), end_s);
  int num_images = 1;
  if (start_px.has_value() && end_px.has_value()) {
    num_images =
        std::clamp(static_cast<int>(std::ceil((*end_px - *start_px).norm())), 1, kMaxImages);
  }
  const auto count = static_cast<size_t>(num_images);
  std::vector<SunImage> images(count);
  std::vector<Vec2d> place_sums_px(count, Vec2d::Zero());
  std::vector<int> num_seen(count, 0);
  const double solid_angle_sr = 1.0 / sun.Pdf();
  for (uint32_t i = 0; i < kNumRays; ++i) {
    const SobolPoint on_disc = Sobol2D(i);
    // Any few successive points cover the disc, so that each time sees all of it.
    const double time_share = (i + 0.5) / kNumRays;
    const SobolPoint in_time = Sobol2D(i ^ (i >> 1));
    const double time_s = shutter.TimeS({time_share, in_time.y * 0x1.0p-32}, image_place);
    const ExposurePoses::Pose pose = poses.At(time_s);
    const Vec3d direction =
        sun.SampleDirection(Vec2d(on_disc.x * 0x1.0p-32, on_disc.y * 0x1.0p-32));
    const Vec3d direction_camera = pose.world_from_camera.transpose().cast<double>() * direction;
    const std::optional<Vec2d> pixel = lens.Project(direction_camera);
    if (!pixel.has_value() ||
        scene.Intersect(pose.origin_m.cast<double>(), direction).has_value()) {
      continue;
    }
    const auto image_idx = static_cast<size_t>(time_share * num_images);
    images[image_idx].light +=
        sun.Radiance() *
        static_cast<float>(solid_angle_sr / kNumRays * AreaPerSolidAngle(lens, direction_camera));
    const std::optional<Vec2d> middle =
        lens.Project(pose.world_from_camera.transpose().cast<double>() * sun.DirectionToSun());
    place_sums_px[image_idx] += middle.value_or(*pixel);
    ++num_seen[image_idx];
  }
  std::vector<SunImage> seen;
  for (size_t i = 0; i < count; ++i) {
    if (num_seen[i] > 0) {
      images[i].place_px = place_sums_px[i] / num_seen[i];
      seen.push_back(images[i]);
    }
  }
  return seen;
}

Flare::Flare(const OpticsSpec& spec, const Lens& lens)
    : spec_(spec), principal_point_px_(lens.PrincipalPointPx()) {
  const int blades = spec.aperture_blades;
  const double rotation_rad = RadFromDeg(spec.aperture_rotation_deg);
  const auto direction = [&](double turns) {
    const double angle_rad = rotation_rad + 2.0 * std::numbers::pi * turns;
    return Vec2d(std::cos(angle_rad), std::sin(angle_rad));
  };
  if (blades >= 2) {
    const int num_spikes = blades % 2 == 0 ? blades : 2 * blades;
    for (int i = 0; i < num_spikes; ++i) {
      spikes_.push_back(direction(static_cast<double>(i) / num_spikes));
    }
  }
  if (blades >= 3) {
    // Light spreads at right angles to an edge.
    for (int i = 0; i < blades; ++i) {
      edges_.push_back(direction(static_cast<double>(i) / blades));
    }
  }
}

Rgb Flare::StarAt(const Vec2d& from_sun_px) const {
  const SunStarSpec& star = spec_.sun_star;
  Eigen::Array3d value = Eigen::Array3d::Zero();
  for (const Vec2d& spike : spikes_) {
    const double along_px = from_sun_px.dot(spike);
    const double across =
        (from_sun_px.x() * spike.y() - from_sun_px.y() * spike.x()) / star.width_px;
    if (along_px < 0.0 || std::abs(across) > kCutoffSigmas ||
        along_px > kSpikeEnd * star.length_px * kChannelNm[0] / kChannelNm[1]) {
      continue;
    }
    const double profile =
        std::exp(-0.5 * across * across) / (star.width_px * std::sqrt(2.0 * std::numbers::pi));
    for (int channel = 0; channel < 3; ++channel) {
      const double length_px =
          star.length_px * kChannelNm[static_cast<size_t>(channel)] / kChannelNm[1];
      value[channel] += profile * std::exp(-along_px / length_px) / length_px;
    }
  }
  return (star.strength / static_cast<double>(spikes_.size()) * value).cast<float>();
}

Rgb Flare::GhostAt(const GhostSpec& ghost, const Vec2d& from_middle_px) const {
  const double distance_px = from_middle_px.norm();
  if (distance_px > ghost.radius_px + 1.0) {
    return Rgb::Zero();
  }
  const auto num_edges = static_cast<double>(edges_.size());
  double inner_px = ghost.radius_px;
  double level_px = distance_px;
  double area_px2 = std::numbers::pi * ghost.radius_px * ghost.radius_px;
  if (!edges_.empty()) {
    inner_px = ghost.radius_px * std::cos(std::numbers::pi / num_edges);
    level_px = 0.0;
    for (const Vec2d& edge : edges_) {
      level_px = std::max(level_px, from_middle_px.dot(edge));
    }
    area_px2 = 0.5 * num_edges * ghost.radius_px * ghost.radius_px *
               std::sin(2.0 * std::numbers::pi / num_edges);
  }
  const double coverage = std::clamp(inner_px - level_px + 0.5, 0.0, 1.0);
  const double place = std::min(1.0, level_px / inner_px);
  const double brightness = 1.0 - ghost.hollow + 4.0 * ghost.hollow * std::pow(place, 6);
  const auto value = static_cast<float>(coverage * brightness / area_px2);
  return value * Rgb(static_cast<float>(ghost.strength[0]),
                     static_cast<float>(ghost.strength[1]),
                     static_cast<float>(ghost.strength[2]));
}

void Flare::Add(const std::vector<SunImage>& sun, Image<float>& radiance, int num_threads) const {
  if (sun.empty()) {
    return;
  }
  ParallelFor(static_cast<size_t>(radiance.HeightPx()), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < radiance.WidthPx(); ++x) {
      const Vec2d place_px(x + 0.5, y + 0.5);
      Rgb added = Rgb::Zero();
      for (const SunImage& image : sun) {
        if (spec_.sun_star.strength > 0.0) {
          added += image.light * StarAt(place_px - image.place_px);
        }
        for (const Named<GhostSpec>& ghost : spec_.ghosts) {
          const Vec2d middle_px =
              principal_point_px_ + ghost.value.position * (image.place_px - principal_point_px_);
          added += image.light * GhostAt(ghost.value, place_px - middle_px);
        }
      }
      for (int channel = 0; channel < 3; ++channel) {
        radiance.At(x, y, channel) += added[channel];
      }
    }
  });
}

}  // namespace pfseq
