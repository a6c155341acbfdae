// SPDX-License-Identifier: Apache-2.0
#include "tools/scene_map.h"

#include "renderer/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfseq {
namespace {

struct MapFrame {
  Vec3d low_m = Vec3d::Constant(std::numeric_limits<double>::infinity());
  Vec3d high_m = -low_m;
  double m_per_px = 1.0;
  int width_px = 1;
  int height_px = 1;

  Vec2d PixelOf(const Vec3d& point_m) const {
    return {(point_m.x() - low_m.x()) / m_per_px, (high_m.y() - point_m.y()) / m_per_px};
  }
};

MapFrame FrameOf(const Scene& scene, int size_px) {
  MapFrame frame;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3f& position_m : mesh.positions_m) {
      frame.low_m = frame.low_m.cwiseMin(position_m.cast<double>());
      frame.high_m = frame.high_m.cwiseMax(position_m.cast<double>());
    }
  }
  const Vec3d size_m = frame.high_m - frame.low_m;
  frame.m_per_px = std::max(1e-9, std::max(size_m.x(), size_m.y()) / size_px);
  frame.width_px = std::max(1, static_cast<int>(std::ceil(size_m.x() / frame.m_per_px)));
  frame.height_px = std::max(1, static_cast<int>(std::ceil(size_m.y() / frame.m_per_px)));
  return frame;
}

/// sRGB-encoded grey or colour of what a ray from above meets.
Rgb ColorOf(const RayScene& rays, const MapFrame& frame, const RayHit& hit, double height_m) {
  const Scene& scene = rays.PlainScene();
  const Mesh& mesh = scene.meshes[hit.mesh_idx];
  const Material& material = scene.materials[static_cast<size_t>(mesh.material_idx)];
  const Vec3d to_light = Vec3d(-0.5, 0.6, 0.9).normalized();
  const double slope = std::abs(hit.geometric_normal.z()) * 0.4 +
                       0.6 * std::max(0.0, hit.geometric_normal.dot(to_light));
  const double rise = height_m / std::max(1.0, frame.high_m.z() - frame.low_m.z());
  return material.base_color.max(0.0F).sqrt() *
         static_cast<float>((0.45 + 0.55 * rise) * (0.35 + 0.75 * slope));
}

void PaintDot(const Vec2d& at_px, double radius_px, const Rgb& color, Image<uint8_t>& map) {
  const int left = std::max(0, static_cast<int>(at_px.x() - radius_px));
  const int right = std::min(map.WidthPx() - 1, static_cast<int>(at_px.x() + radius_px));
  const int top = std::max(0, static_cast<int>(at_px.y() - radius_px));
  const int bottom = std::min(map.HeightPx() - 1, static_cast<int>(at_px.y() + radius_px));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      if ((Vec2d(x + 0.5, y + 0.5) - at_px).norm() <= radius_px) {
        for (int channel = 0; channel < 3; ++channel) {
          map.At(x, y, channel) = static_cast<uint8_t>(255.0F * color[channel]);
        }
      }
    }
  }
}

}  // namespace

Image<uint8_t> DrawSceneMap(const RayScene& rays,
                            const std::vector<Vec3d>& way_m,
                            int size_px,
                            int num_threads) {
  const MapFrame frame = FrameOf(rays.PlainScene(), size_px);
  Image<uint8_t> map(frame.width_px, frame.height_px, 3);
  ParallelFor(static_cast<size_t>(frame.height_px), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < frame.width_px; ++x) {
      const Vec3d origin_m(frame.low_m.x() + (x + 0.5) * frame.m_per_px,
                           frame.high_m.y() - (y + 0.5) * frame.m_per_px,
                           frame.high_m.z() + 1.0);
      const auto hit = rays.Intersect(origin_m, -Vec3d::UnitZ());
      const double height_m = hit ? origin_m.z() - hit->distance_m - frame.low_m.z() : 0.0;
      const Rgb color = hit ? ColorOf(rays, frame, *hit, height_m) : Rgb(Rgb::Ones());
      for (int channel = 0; channel < 3; ++channel) {
        map.At(x, y, channel) =
            static_cast<uint8_t>(255.0F * std::clamp(color[channel], 0.0F, 1.0F));
      }
    }
  });
  const Rgb red(0.9F, 0.1F, 0.1F);
  const double radius_px = 0.004 * size_px;
  for (size_t i = 0; i < way_m.size(); ++i) {
    PaintDot(frame.PixelOf(way_m[i]), i == 0 ? 2.0 * radius_px : radius_px, red, map);
  }
  return map;
}

}  // namespace pfseq
