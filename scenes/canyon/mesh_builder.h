// SPDX-License-Identifier: Apache-2.0
// Collects polygons into one mesh for each pair of group and material, with texture coordinates in
// metres.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/scene.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace pfseq {

/// A right-handed frame for building on a surface: right x up = out. On a facade `right` runs along
/// the wall as seen from the street, `up` is the world's Z and `out` points into the street.
struct SurfaceFrame {
  Vec3d origin_m = Vec3d::Zero();
  Vec3d right = Vec3d::UnitX();
  Vec3d up = Vec3d::UnitZ();
  Vec3d out = -Vec3d::UnitY();

  /// The world's point at (u, v, w) along right, up and out.
  Vec3d At(double u_m, double v_m, double w_m) const {
    return origin_m + u_m * right + v_m * up + w_m * out;
  }

  /// The same axes with the origin at (u, v, w).
  SurfaceFrame MovedTo(double u_m, double v_m, double w_m) const {
    return {At(u_m, v_m, w_m), right, up, out};
  }
};

/// A rectangle in texture coordinates: (u0, v0) is the texture's upper left corner of it.
struct TextureWindow {
  double u0 = 0.0;
  double v0 = 0.0;
  double u1 = 1.0;
  double v1 = 1.0;

  /// The part of it between the shares [x0, x1] from the left and [y0, y1] from the top.
  TextureWindow Part(double x0, double y0, double x1, double y1) const {
    const double width = u1 - u0;
    const double height = v1 - v0;
    return {u0 + x0 * width, v0 + y0 * height, u0 + x1 * width, v0 + y1 * height};
  }
};

/// Where the unit square of a material's textures lies on a surface: its size along the horizontal
/// and up the face, and its lower left corner there.
struct TexturePlacement {
  Vec2d size_m = Vec2d::Ones();
  Vec2d low_m = Vec2d::Zero();
  /// Not shifted by SetTextureOffset.
  bool is_fixed = false;
};

/// Polygons are counter-clockwise seen from outside; each has vertices of its own (flat shading).
class MeshBuilder {
 public:
  /// `texture_size_m[i]`: the edge of the square that one repetition of material i's textures
  /// covers.
  explicit MeshBuilder(const std::vector<double>& texture_size_m);

  /// A further material; returns its index.
  int AddMaterial(const TexturePlacement& placement);

  /// What follows goes into the meshes of this group; a group may be taken up again.
  void BeginGroup(const std::string& name);

  /// Shifts the texture coordinates of what follows, so that no two buildings align.
  void SetTextureOffset(const Vec2d& offset_m) { texture_offset_m_ = offset_m; }

  /// A flat convex polygon; degenerate ones are left out. Textures lie upright: u runs horizontally
  /// along the face.
  void Polygon(int material_idx, std::span<const Vec3d> corners_m);

  void Quad(int material_idx, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

  /// A rectangle in the plane w of a frame, facing out.
  void Rectangle(int material_idx,
                 const SurfaceFrame& frame,
                 const Vec2d& low_m,
                 const Vec2d& high_m,
                 double w_m);

  /// A quad (lower left, lower right, upper right, upper left seen from outside) that shows a part
  /// of its texture.
  void PictureQuad(int material_idx,
                   const Vec3d& a,
                   const Vec3d& b,
                   const Vec3d& c,
                   const Vec3d& d,
                   const TextureWindow& window);

  /// All meshes in order of group name and material, named "group/material"; the builder is empty
  /// afterwards.
  std::vector<Mesh> TakeMeshes(std::span<const Material> materials);

 private:
  Mesh& MeshOf(int material_idx);

  std::vector<TexturePlacement> placements_;
  std::map<std::string, std::vector<Mesh>> groups_;
  std::vector<Mesh>* group_ = nullptr;
  Vec2d texture_offset_m_ = Vec2d::Zero();
};

}  // namespace pfseq
