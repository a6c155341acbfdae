// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/rigid_transform.h"
#include "renderer/lens/lens_raster.h"
#include "renderer/trace/ray_scene.h"

#include <functional>

namespace pfseq {

/// How far what a pixel's centre shows moves over the image while the shutter is open, in pixels:
/// its velocity at mid-exposure times exposure_s, two channels, x to the right and y down. Only the
/// camera moves; the sky is infinitely far. 0 outside the image circle and without an exposure.
/// `world_from_camera_at` gives the camera so many seconds after mid-exposure.
Image<float> RenderBlurVectors(const RayScene& scene,
                               const LensRaster& raster,
                               const std::function<RigidTransform(double)>& world_from_camera_at,
                               double exposure_s,
                               int num_threads);

}  // namespace pfseq
