// SPDX-License-Identifier: Apache-2.0
// What stands on roofs and stands out against the sky.
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/build_context.h"
#include "scenes/canyon/building.h"

#include <vector>

namespace pfseq {

/// The upright frame with the world's axes at a point: right is +X, out is -Y.
SurfaceFrame WorldFrame(const Vec3d& origin_m);

/// A box over a rectangle of the plane, [low, high] in z, without its bottom.
void AddBlock(MeshBuilder& builder,
              int material_idx,
              const Vec2d& center_m,
              const Vec2d& size_m,
              double low_m,
              double high_m);

/// A brick stack with a slab and pots; `foot_m` lies under the roof.
void BuildChimney(const BuildContext& context,
                  int wall,
                  const Vec2d& center_m,
                  const Vec2d& size_m,
                  double foot_m,
                  double top_m,
                  RandomStream& random);

/// A mast with one or two aerials.
void BuildAntenna(const BuildContext& context, const Vec3d& foot_m, RandomStream& random);

/// Stacks at the party walls, aerials, dishes, railings and finials along the street fronts; `lods`
/// has one entry for each edge.
void BuildRoofline(const BuildContext& context,
                   const Building& building,
                   const std::vector<Lod>& lods);

}  // namespace pfseq
