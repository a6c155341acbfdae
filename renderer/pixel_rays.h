// SPDX-License-Identifier: Apache-2.0
// The rays of a pixel and what each of them stands for.
#pragma once

#include "renderer/core/rigid_transform.h"
#include "renderer/lens/lens_raster.h"
#include "renderer/trace/surface_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace pfseq {

/// Textures are filtered over this share of a stratum's sides: the interpolation between texels
/// widens the filter by the rest.
inline constexpr float kFootprintShare = 0.6F;
/// The same of a pixel's sides, for moving pictures.
inline constexpr float kMovingFootprintShare = 0.7F;

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

/// The directions of one pixel in the world; in the camera, when world_from_camera is the identity.
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

  /// The bundle of a sample of a moving picture, which stands for the whole pixel: what passes
  /// there while the shutter is open differs more than what a stratum of the pixel shows.
  RayFootprint MovingFootprint(const Vec2f& place) const {
    const Vec3f dx = is_inside_ ? Vec3f(along_x_ + place.y() * twist_) : Vec3f::Zero();
    const Vec3f dy = is_inside_ ? Vec3f(along_y_ + place.x() * twist_) : Vec3f::Zero();
    return {Vec3f::Zero(), kMovingFootprintShare * dx, kMovingFootprintShare * dy};
  }

 private:
  const Lens& lens_;
  RigidTransform world_from_camera_;
  Vec2d corner_px_;
  bool is_inside_;
  Vec3f origin_ = Vec3f::Zero();
  Vec3f along_x_ = Vec3f::Zero();
  Vec3f along_y_ = Vec3f::Zero();
  Vec3f twist_ = Vec3f::Zero();
};

}  // namespace pfseq
