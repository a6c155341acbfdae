// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/wall_painting.h"

#include "scenes/canyon/fractal_tile.h"

#include <algorithm>
#include <cmath>

namespace pfseq {
namespace {

/// Bilinear, the photograph repeating sideways and ending above and below.
Rgb PhotoColor(const Image<uint8_t>& image, double x_px, double y_px) {
  const int width = image.WidthPx();
  const int height = image.HeightPx();
  const double left = std::floor(x_px - 0.5);
  const double top = std::floor(y_px - 0.5);
  const auto a = static_cast<float>(x_px - 0.5 - left);
  const auto b = static_cast<float>(y_px - 0.5 - top);
  const auto texel = [&](double column, double row) -> Rgb {
    const int x = ((static_cast<int>(column) % width) + width) % width;
    const int y = std::clamp(static_cast<int>(row), 0, height - 1);
    return Rgb(image.At(x, y, 0), image.At(x, y, 1), image.At(x, y, 2)) / 255.0F;
  };
  return (1.0F - b) * ((1.0F - a) * texel(left, top) + a * texel(left + 1.0, top)) +
         b * ((1.0F - a) * texel(left, top + 1.0) + a * texel(left + 1.0, top + 1.0));
}

}  // namespace

void PaintPhoto(const WallPainting& painting, WallCanvas& canvas) {
  const WallPhoto& photo = painting.photo;
  const Image<uint8_t>& image = *photo.image;
  const FractalTile& fractal = SharedFractal();
  const Vec2d px_per_m(image.WidthPx() / photo.size_m.x(), image.HeightPx() / photo.size_m.y());
  canvas.ForEach(canvas.LowM(), canvas.HighM(), [&](WallTexel& texel, const Vec2d& point_m) {
    const Vec2d from_low_m = point_m - photo.low_m;
    const double along_px = from_low_m.x() * px_per_m.x();
    const double x_px = photo.is_mirrored ? image.WidthPx() - along_px : along_px;
    const double y_px = image.HeightPx() - from_low_m.y() * px_per_m.y();
    const Rgb color = PhotoColor(image, x_px, y_px);
    // Edges of the photograph are sharpened, and grain below its resolution is added.
    const Rgb around =
        0.25F * (PhotoColor(image, x_px - 1.2, y_px) + PhotoColor(image, x_px + 1.2, y_px) +
                 PhotoColor(image, x_px, y_px - 1.2) + PhotoColor(image, x_px, y_px + 1.2));
    const float fine =
        fractal.At(point_m.x(), point_m.y(), canvas.TexelM(), painting.look.seed % 89 + 100);
    texel.color = ((color + 0.8F * (color - around)) * (1.0F + 0.035F * fine)).max(0.0F).min(1.0F);
    texel.height_m = 0.0008F * fine;
    if (photo.normal) {
      const Rgb normal = 2.0F * PhotoColor(*photo.normal, x_px, y_px) - 1.0F;
      const float up = normal[1] / std::max(0.1F, normal[2]);
      const float right = normal[0] / std::max(0.1F, normal[2]);
      texel.tilt = {photo.is_mirrored ? -right : right, up};
    } else {
      // Mortar, frames and shade lie deeper than what is bright beside them.
      texel.height_m += 0.012F * (color.mean() - around.mean());
    }
    if (photo.roughness) {
      texel.roughness = PhotoColor(*photo.roughness, x_px, y_px)[1];
    }
  });
}

PaintedWall Paint(const WallPainting& painting) {
  WallCanvas canvas(painting.area.low_m, painting.area.high_m, painting.texel_m);
  if (painting.photo.image) {
    PaintPhoto(painting, canvas);
  } else {
    PaintSurface(painting.look, canvas);
    PaintDressings(painting, canvas);
    PaintSpots(painting, canvas);
    PaintWeather(painting, canvas);
    PaintMarks(painting, canvas);
  }
  return canvas.Finish(painting.name, painting.normal_step);
}

}  // namespace pfseq
