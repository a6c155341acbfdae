// SPDX-License-Identifier: Apache-2.0
// The few solids that facades and roofs are put together from.
#pragma once

#include "scenes/canyon/mesh_builder.h"

#include <span>
#include <vector>

namespace pfseq {

/// Faces of a box in a frame, to be combined.
enum BoxFace : unsigned {
  kFaceFront = 1,  ///< towards +out
  kFaceBack = 2,
  kFaceLeft = 4,  ///< towards -right
  kFaceRight = 8,
  kFaceTop = 16,
  kFaceBottom = 32,
  kFacesSides = kFaceFront | kFaceBack | kFaceLeft | kFaceRight,
  kFacesAll = 63,
  /// All but the back: a part that sits on a wall.
  kFacesOnWall = 61,
};

/// The box [low, high] in a frame's (u, v, w), with the named faces.
void AddBox(MeshBuilder& builder,
            int material_idx,
            const SurfaceFrame& frame,
            const Vec3d& low_m,
            const Vec3d& high_m,
            unsigned faces);

/// An upright prism over a regular polygon: pipes, pots, poles; without its bottom, unless that is
/// to be seen.
void AddPillar(MeshBuilder& builder,
               int material_idx,
               const Vec3d& foot_m,
               double radius_m,
               double height_m,
               int num_sides,
               bool has_bottom = false);

/// A run of walls seen from outside, left to right; closed when last and first point are joined.
struct WallPath {
  std::vector<Vec2d> points_m;
  bool is_closed = false;
};

/// Sweeps a moulding along walls, mitred at the corners. Profile points are (out, z), z never
/// falling, from the lower edge on the wall to the upper edge on the wall (out = 0 at both). Ends
/// of an open path are capped.
void AddMoulding(MeshBuilder& builder,
                 int material_idx,
                 const WallPath& path,
                 std::span<const Vec2d> profile_m);

/// Convex polygon, counter-clockwise, with edge i (from point i to i + 1) moved inwards by
/// inset_m[i].
std::vector<Vec2d> InsetPolygon(std::span<const Vec2d> points_m, std::span<const double> inset_m);

/// A level polygon facing up.
void AddLevelPolygon(MeshBuilder& builder,
                     int material_idx,
                     std::span<const Vec2d> points_m,
                     double z_m);

/// The unit vector to the right of a direction in the plane: outwards from a counter-clockwise
/// polygon's edge.
inline Vec2d RightOf(const Vec2d& direction) { return {direction.y(), -direction.x()}; }

inline Vec3d Lift(const Vec2d& point_m, double z_m) { return {point_m.x(), point_m.y(), z_m}; }

}  // namespace pfseq
