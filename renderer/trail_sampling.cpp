// SPDX-License-Identifier: Apache-2.0
#include "renderer/trail_sampling.h"

#include "renderer/blur_vectors.h"
#include "renderer/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

int DivideUp(int dividend, int divisor) { return (dividend + divisor - 1) / divisor; }

RigidTransform Exact(const ExposurePoses::Pose& pose) {
  RigidTransform world_from_camera;
  world_from_camera.rotation = Eigen::Quaterniond(pose.world_from_camera.cast<double>());
  world_from_camera.translation_m = pose.origin_m.cast<double>();
  return world_from_camera;
}

}  // namespace

TrailSampling::TrailSampling(const RayScene& scene,
                             const LensRaster& raster,
                             const RigidTransform& world_from_camera,
                             const ExposurePoses& exposure,
                             int num_threads)
    : exposure_(&exposure),
      image_size_px_(raster.WidthPx(), raster.HeightPx()),
      motion_px_(DivideUp(raster.WidthPx(), kBlockPx), DivideUp(raster.HeightPx(), kBlockPx), 2) {
  const Shutter& shutter = exposure.OwnShutter();
  const double middle_s = shutter.MiddleS({0.5, 0.5});
  const double half_s = 0.5 * shutter.ExposureS();
  const ImageMotion motion(scene,
                           raster,
                           world_from_camera,
                           Exact(exposure.At(middle_s - half_s)),
                           Exact(exposure.At(middle_s + half_s)));
  ParallelFor(static_cast<size_t>(motion_px_.HeightPx()), num_threads, [&](size_t row) {
    const auto block_y = static_cast<int>(row);
    const int y = std::min(block_y * kBlockPx + kBlockPx / 2, raster.HeightPx() - 1);
    for (int block_x = 0; block_x < motion_px_.WidthPx(); ++block_x) {
      const int x = std::min(block_x * kBlockPx + kBlockPx / 2, raster.WidthPx() - 1);
      const Vec2d moved_px = motion.AtPx(x, y);
      motion_px_.At(block_x, block_y, 0) = static_cast<float>(moved_px.x());
      motion_px_.At(block_x, block_y, 1) = static_cast<float>(moved_px.y());
    }
  });
}

ExposurePoses::Pose TrailSampling::PoseOf(int x,
                                          int y,
                                          const Vec2f& place,
                                          const Vec2d& sample) const {
  const Vec2f motion_px(motion_px_.At(x / kBlockPx, y / kBlockPx, 0),
                        motion_px_.At(x / kBlockPx, y / kBlockPx, 1));
  // What is at `place` at an instant is at the centre earlier by the share of the exposure that the
  // way between them takes. Ways shorter than a pixel leave the instants as they are.
  const double earlier =
      (place - Vec2f(0.5F, 0.5F)).dot(motion_px) / std::max(1.0F, motion_px.squaredNorm());
  const double instant = sample.x() + earlier;
  const Vec2d image_place = (Vec2d(x, y) + place.cast<double>()).cwiseQuotient(image_size_px_);
  return exposure_->At(
      exposure_->OwnShutter().TimeS({instant - std::floor(instant), sample.y()}, image_place));
}

}  // namespace pfseq
