// SPDX-License-Identifier: Apache-2.0
// From pixels to the world.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/rigid_transform.h"
#include "renderer/core/vector.h"
#include "renderer/lens/lens.h"
#include "renderer/trace/ray_scene.h"

#include <optional>

namespace pfseq {

/// The world point that a key point shows: along the ray of its very position, at the distance that
/// the map has for the pixel it lies in (the report's way). Nothing in the sky, beyond the maps'
/// reach and outside the image circle or the image.
std::optional<Vec3d> LiftByMap(const Vec2d& pixel_px,
                               const Lens& lens,
                               const RigidTransform& world_from_camera,
                               const Image<float>& distance_m);

/// The same, but where the ray of the very position meets the scene: exact. Nothing beyond
/// max_distance_m.
std::optional<Vec3d> LiftByRay(const Vec2d& pixel_px,
                               const Lens& lens,
                               const RigidTransform& world_from_camera,
                               const RayScene& scene,
                               double max_distance_m);

}  // namespace pfseq
