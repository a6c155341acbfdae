// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/shapes.h"

#include "renderer/core/check.h"

#include <array>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

/// Offset of a path's points per metre of projection: the mitre at corners, the wall's normal at
/// open ends.
std::vector<Vec2d> MitreVectors(const WallPath& path) {
  const size_t count = path.points_m.size();
  std::vector<Vec2d> mitres(count);
  for (size_t i = 0; i < count; ++i) {
    const bool has_before = i > 0 || path.is_closed;
    const bool has_after = i + 1 < count || path.is_closed;
    const Vec2d& here = path.points_m[i];
    Vec2d before = Vec2d::Zero();
    Vec2d after = Vec2d::Zero();
    if (has_before) {
      before = RightOf((here - path.points_m[(i + count - 1) % count]).normalized());
    }
    if (has_after) {
      after = RightOf((path.points_m[(i + 1) % count] - here).normalized());
    }
    if (has_before && has_after) {
      mitres[i] = (before + after) / (1.0 + before.dot(after));
    } else {
      mitres[i] = before + after;
    }
  }
  return mitres;
}

}  // namespace

void AddBox(MeshBuilder& builder,
            int material_idx,
            const SurfaceFrame& frame,
            const Vec3d& low_m,
            const Vec3d& high_m,
            unsigned faces) {
  const auto corner = [&](int u, int v, int w) {
    return frame.At(u != 0 ? high_m.x() : low_m.x(),
                    v != 0 ? high_m.y() : low_m.y(),
                    w != 0 ? high_m.z() : low_m.z());
  };
  const auto add =
      [&](unsigned face, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
        if ((faces & face) != 0) {
          builder.Quad(material_idx, a, b, c, d);
        }
      };
  add(kFaceFront, corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
  add(kFaceBack, corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0));
  add(kFaceLeft, corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
  add(kFaceRight, corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1));
  add(kFaceTop, corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0));
  add(kFaceBottom, corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
}

void AddPillar(MeshBuilder& builder,
               int material_idx,
               const Vec3d& foot_m,
               double radius_m,
               double height_m,
               int num_sides,
               bool has_bottom) {
  std::vector<Vec3d> top_m;
  for (int i = 0; i < num_sides; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / num_sides;
    top_m.push_back(
        foot_m + Vec3d(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), height_m));
  }
  const Vec3d down_m(0.0, 0.0, -height_m);
  for (size_t i = 0; i < top_m.size(); ++i) {
    const Vec3d& left = top_m[i];
    const Vec3d& right = top_m[(i + 1) % top_m.size()];
    builder.Quad(material_idx, left + down_m, right + down_m, right, left);
  }
  builder.Polygon(material_idx, top_m);
  if (has_bottom) {
    std::vector<Vec3d> bottom_m(top_m.rbegin(), top_m.rend());
    for (Vec3d& corner_m : bottom_m) {
      corner_m += down_m;
    }
    builder.Polygon(material_idx, bottom_m);
  }
}

void AddMoulding(MeshBuilder& builder,
                 int material_idx,
                 const WallPath& path,
                 std::span<const Vec2d> profile_m) {
  const size_t count = path.points_m.size();
  if (count < 2) {
    return;
  }
  const std::vector<Vec2d> mitres = MitreVectors(path);
  const auto at = [&](size_t point, const Vec2d& profile) {
    return Lift(path.points_m[point] + profile.x() * mitres[point], profile.y());
  };
  const size_t num_segments = path.is_closed ? count : count - 1;
  for (size_t j = 0; j + 1 < profile_m.size(); ++j) {
    const Vec2d& low = profile_m[j];
    const Vec2d& high = profile_m[j + 1];
    for (size_t i = 0; i < num_segments; ++i) {
      const size_t next = (i + 1) % count;
      builder.Quad(material_idx, at(i, low), at(next, low), at(next, high), at(i, high));
    }
    if (!path.is_closed) {
      const Vec2d low_wall(0.0, low.y());
      const Vec2d high_wall(0.0, high.y());
      builder.Quad(material_idx, at(0, low_wall), at(0, low), at(0, high), at(0, high_wall));
      const size_t last = count - 1;
      builder.Quad(
          material_idx, at(last, low), at(last, low_wall), at(last, high_wall), at(last, high));
    }
  }
}

std::vector<Vec2d> InsetPolygon(std::span<const Vec2d> points_m, std::span<const double> inset_m) {
  const size_t count = points_m.size();
  PFSEQ_CHECK(inset_m.size() == count);
  std::vector<Vec2d> result(count);
  for (size_t i = 0; i < count; ++i) {
    const size_t before = (i + count - 1) % count;
    const Vec2d direction_a = (points_m[i] - points_m[before]).normalized();
    const Vec2d direction_b = (points_m[(i + 1) % count] - points_m[i]).normalized();
    const Vec2d normal_a = -RightOf(direction_a);
    const Vec2d normal_b = -RightOf(direction_b);
    // The point p with normal_a . p = inset_a and normal_b . p = inset_b, relative to the corner.
    const double determinant = normal_a.x() * normal_b.y() - normal_a.y() * normal_b.x();
    PFSEQ_CHECK(std::abs(determinant) > 1e-9, "parallel neighbouring edges at point {}", i);
    const double a = inset_m[before];
    const double b = inset_m[i];
    result[i] = points_m[i] +
                Vec2d(a * normal_b.y() - b * normal_a.y(), b * normal_a.x() - a * normal_b.x()) /
                    determinant;
  }
  return result;
}

void AddLevelPolygon(MeshBuilder& builder,
                     int material_idx,
                     std::span<const Vec2d> points_m,
                     double z_m) {
  std::vector<Vec3d> corners_m;
  corners_m.reserve(points_m.size());
  for (const Vec2d& point_m : points_m) {
    corners_m.push_back(Lift(point_m, z_m));
  }
  builder.Polygon(material_idx, corners_m);
}

}  // namespace pfseq
