// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/lettering.h"

#include "scenes/canyon/stroke_font.h"

#include <algorithm>

namespace pfseq {

void DrawText(std::string_view text,
              const Vec2d& low_m,
              const Vec2d& size_m,
              double weight,
              const Rgb& color,
              WallCanvas& canvas) {
  const double width = TextWidth(text);
  if (width <= 0.0) {
    return;
  }
  // Letters of long lines are narrower, to two thirds of their width.
  const double height_m = std::min(size_m.y(), 1.5 * size_m.x() / width);
  const double across_m = std::min(height_m, size_m.x() / width);
  const double pen_m = weight * height_m;
  Vec2d origin_m = low_m + 0.5 * (size_m - Vec2d(across_m * width, height_m));
  for (const char letter : text) {
    for (const Stroke& stroke : StrokesOf(letter)) {
      for (size_t i = 0; i + 1 < stroke.size(); ++i) {
        // The pen's own width stays inside the box.
        const auto at = [&](const Vec2d& point) {
          return Vec2d(origin_m.x() + across_m * point.x(),
                       origin_m.y() + 0.5 * pen_m + (height_m - pen_m) * point.y());
        };
        canvas.Line(at(stroke[i]), at(stroke[i + 1]), pen_m, color, 1.0);
      }
    }
    origin_m.x() += kLetterAdvance * across_m;
  }
}

}  // namespace pfseq
