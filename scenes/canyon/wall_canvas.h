// SPDX-License-Identifier: Apache-2.0
// A part of a front while it is being painted.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"
#include "renderer/trace/scene.h"

#include <string>
#include <vector>

namespace pfseq {

/// sRGB-encoded colour, relief above the wall's plane, and how soiled the place is (0 to 1).
struct WallTexel {
  Rgb color = Rgb::Ones();
  float height_m = 0.0F;
  float dirt = 0.0F;
  float roughness = 0.9F;
  /// What the normal leans to the right and up beside what the relief makes it lean.
  Vec2f tilt = Vec2f::Zero();
};

/// The textures of a painted wall, one square each of texture coordinates.
struct PaintedWall {
  Texture color;
  Texture normal;
  Texture roughness;
};

/// Covers [low, high] of a facade: (metres along the wall, metres above the carriageway).
class WallCanvas {
 public:
  WallCanvas(const Vec2d& low_m, const Vec2d& high_m, double texel_m);

  /// Its texels by columns and rows, before there is any.
  static Vec2d SizeTexels(const Vec2d& low_m, const Vec2d& high_m, double texel_m);

  int WidthPx() const { return width_px_; }
  int HeightPx() const { return height_px_; }
  double TexelM() const { return texel_m_; }
  const Vec2d& LowM() const { return low_m_; }
  const Vec2d& HighM() const { return high_m_; }

  WallTexel& At(int x, int y) {
    return texels_[static_cast<size_t>(y) * static_cast<size_t>(width_px_) +
                   static_cast<size_t>(x)];
  }

  /// Where a texel's centre lies on the facade.
  Vec2d PointOf(int x, int y) const {
    return {low_m_.x() + (x + 0.5) * step_m_.x(), high_m_.y() - (y + 0.5) * step_m_.y()};
  }

  /// Calls paint(texel, point_m) for all texels whose centres lie in a rectangle.
  template <typename PaintTexel>
  void ForEach(const Vec2d& low_m, const Vec2d& high_m, const PaintTexel& paint) {
    const int left = ColumnOf(low_m.x());
    const int right = ColumnOf(high_m.x());
    const int top = RowOf(high_m.y());
    const int bottom = RowOf(low_m.y());
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        paint(At(x, y), PointOf(x, y));
      }
    }
  }

  /// Lays a colour over a rectangle and lifts it.
  void Rect(
      const Vec2d& low_m, const Vec2d& high_m, const Rgb& color, double alpha, double lift_m = 0.0);

  /// A straight stroke with round ends; where it is thinner than a texel it is paler instead.
  void Line(const Vec2d& from_m,
            const Vec2d& to_m,
            double width_m,
            const Rgb& color,
            double alpha,
            double lift_m = 0.0);

  /// The textures; dirt darkens here. The normal map has one texel for `normal_step` of the
  /// colour's, the roughness map for four.
  PaintedWall Finish(const std::string& name, int normal_step) const;

 private:
  int ColumnOf(double u_m) const;
  int RowOf(double v_m) const;

  Vec2d low_m_;
  Vec2d high_m_;
  double texel_m_;
  Vec2d step_m_;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<WallTexel> texels_;
};

/// a and b mixed, t held to [0, 1].
inline Rgb MixColor(const Rgb& a, const Rgb& b, double t) {
  return a + (b - a) * static_cast<float>(t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t);
}

/// 0 up to `from`, 1 beyond `to`, linear between.
inline double Ramp(double from, double to, double value) {
  const double t = (value - from) / (to - from);
  return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

}  // namespace pfseq
