// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/random.h"
#include "scenes/canyon/lettering.h"
#include "scenes/canyon/wall_painting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace pfseq {
namespace {

constexpr std::array<uint32_t, 10> kInks = {0x1A1A1E,
                                            0x20305A,
                                            0x7A1B22,
                                            0xE9E6DC,
                                            0xC9A227,
                                            0x2F6B3C,
                                            0xB0481E,
                                            0x5B2A66,
                                            0x0E6A78,
                                            0xD8D2C0};

Rgb Ink(RandomStream& random) {
  const uint32_t hex = kInks[static_cast<size_t>(random.Integer(0, 9))];
  return Rgb(static_cast<float>(hex >> 16 & 0xFF),
             static_cast<float>(hex >> 8 & 0xFF),
             static_cast<float>(hex & 0xFF)) /
         255.0F;
}

/// Free stretches of wall between openings, at least `least_m` wide, at street level.
std::vector<WallRect> FreeWall(const WallPainting& painting, double least_m) {
  std::vector<WallRect> openings = painting.openings;
  std::sort(openings.begin(), openings.end(), [](const WallRect& a, const WallRect& b) {
    return a.low_m.x() < b.low_m.x();
  });
  std::vector<WallRect> free;
  double left_m = painting.area.low_m.x() + 0.1;
  const auto add = [&](double right_m) {
    if (right_m - left_m >= least_m) {
      free.push_back({{left_m, painting.pavement_m + 0.4}, {right_m, painting.pavement_m + 2.4}});
    }
  };
  for (const WallRect& opening : openings) {
    add(opening.low_m.x() - 0.05);
    left_m = std::max(left_m, opening.high_m.x() + 0.05);
  }
  add(painting.area.high_m.x() - 0.1);
  return free;
}

/// A bill: a picture above, lines of print, sometimes torn at a corner.
void PaintPoster(const Vec2d& low_m, const Vec2d& size_m, uint64_t seed, WallCanvas& canvas) {
  RandomStream random(seed);
  const Vec2d high_m = low_m + size_m;
  const Rgb paper =
      MixColor(Rgb(0.90F, 0.88F, 0.82F), Ink(random), random.Chance(0.4) ? 0.85 : 0.1);
  const bool is_torn = random.Chance(0.4);
  const double tear = random.Uniform(0.2, 0.7);
  canvas.ForEach(low_m, high_m, [&](WallTexel& texel, const Vec2d& point_m) {
    const Vec2d at = (point_m - low_m).cwiseQuotient(size_m);
    const double jag = 0.05 * std::sin(37.0 * at.x()) + 0.03 * std::sin(91.0 * at.x());
    if (is_torn && at.x() + at.y() < tear + jag) {
      return;
    }
    texel.color = paper;
    texel.dirt *= 0.5F;
    texel.roughness = 0.6F;
    texel.height_m = 0.001F;
  });
  if (is_torn) {
    return;
  }
  const Rgb ink = paper.mean() > 0.5F ? Rgb(0.12F, 0.11F, 0.12F) : Rgb(0.93F, 0.90F, 0.82F);
  const auto at = [&](double x, double y) {
    return Vec2d(low_m + size_m.cwiseProduct(Vec2d(x, y)));
  };
  canvas.Rect(at(0.08, 0.42), at(0.92, 0.93), Ink(random), 0.9);
  for (int i = 0; i < 5; ++i) {
    const double x = random.Uniform(0.1, 0.7);
    const double y = random.Uniform(0.44, 0.8);
    canvas.Rect(at(x, y),
                at(x + random.Uniform(0.05, 0.22), y + random.Uniform(0.04, 0.12)),
                Ink(random),
                0.85);
  }
  constexpr std::array<std::string_view, 8> kTitles = {
      "CIRCUS", "JAZZ", "VOTE", "OPERA", "SALE", "CINEMA", "RAVE", "MARCH"};
  const std::string_view title = kTitles[static_cast<size_t>(random.Integer(0, 7))];
  DrawText(title, at(0.1, 0.26), {0.8 * size_m.x(), 0.12 * size_m.y()}, 0.22, ink, canvas);
  for (int line = 0; line < 4; ++line) {
    const double y = 0.2 - 0.05 * line;
    canvas.Rect(at(0.1, y - 0.015), at(0.1 + random.Uniform(0.3, 0.8), y), ink, 0.7);
  }
}

/// A name sprayed in one go: loops of one pen, a fat outline now and then.
void PaintTag(const WallRect& room, uint64_t seed, WallCanvas& canvas) {
  RandomStream random(seed);
  const double height_m = random.Uniform(0.2, 0.55);
  const double pen_m = random.Uniform(0.014, 0.04);
  const double slant = random.Uniform(-0.1, 0.5);
  const Rgb ink = Ink(random);
  const double width_m =
      std::min(room.high_m.x() - room.low_m.x() - 0.1, random.Uniform(1.5, 4.5) * height_m);
  Vec2d at_m(room.low_m.x() +
                 random.Uniform(0.0, std::max(0.01, room.high_m.x() - room.low_m.x() - width_m)),
             random.Uniform(room.low_m.y() + 0.2, room.high_m.y() - height_m));
  const double foot_m = at_m.y();
  const double end_m = at_m.x() + width_m;
  const double rise_rad = random.Uniform(-0.15, 0.2);
  const double start_m = at_m.x();
  while (at_m.x() < end_m) {
    // One letter: an up-stroke, a loop, a down-stroke.
    const double letter_m = height_m * random.Uniform(0.4, 0.75);
    const double drift_m = (at_m.x() - start_m) * rise_rad;
    Vec2d before_m = at_m;
    const double a = random.Uniform(0.5, 1.0);
    const double b = random.Uniform(1.0, 3.0);
    const double c = random.Uniform(0.0, 6.0);
    for (int k = 1; k <= 10; ++k) {
      const double t = k / 10.0;
      const double y = 0.5 + 0.5 * a * std::sin(6.28 * t * b * 0.5 + c);
      const Vec2d next_m(
          at_m.x() + letter_m * (t + 0.25 * std::sin(6.28 * b * t)) + slant * y * height_m,
          foot_m + drift_m + height_m * y);
      if (k > 1) {
        canvas.Line(before_m, next_m, pen_m, ink, 0.9);
      }
      before_m = next_m;
    }
    at_m.x() += letter_m;
  }
  if (random.Chance(0.4)) {
    canvas.Line(
        {start_m, foot_m - 0.05}, {end_m, foot_m - 0.02 + width_m * rise_rad}, pen_m, ink, 0.8);
  }
}

/// A cable along the wall with its clips, sagging a little, and a drop here and there.
void PaintCable(const WallPainting& painting,
                double level_m,
                RandomStream& random,
                WallCanvas& canvas) {
  const double width_m = random.Uniform(0.008, 0.02);
  const Rgb sheath =
      Rgb::Constant(static_cast<float>(random.Chance(0.7) ? random.Uniform(0.08, 0.2) : 0.75));
  double left_m = painting.area.low_m.x();
  double from_level_m = level_m;
  while (left_m < painting.area.high_m.x()) {
    const double right_m = left_m + random.Uniform(0.5, 1.6);
    const double to_level_m = level_m + random.Uniform(-0.02, 0.01);
    const auto stroke = [&](double shift_m, const Rgb& color, double alpha) {
      canvas.Line(
          {left_m, from_level_m + shift_m}, {right_m, to_level_m + shift_m}, width_m, color, alpha);
    };
    stroke(-0.9 * width_m, Rgb::Constant(0.1F), 0.35);
    stroke(0.0, sheath, 0.95);
    canvas.Rect({right_m - 0.012, to_level_m - 0.015},
                {right_m + 0.012, to_level_m + 0.015},
                Rgb::Constant(0.25F),
                0.9,
                0.004);
    left_m = right_m;
    from_level_m = to_level_m;
  }
}

/// Vents, boxes and the crosses of wall anchors.
void PaintFittings(const WallPainting& painting, RandomStream& random, WallCanvas& canvas) {
  const Vec2d low_m = painting.area.low_m;
  const Vec2d size_m = painting.area.high_m - low_m;
  const int count = static_cast<int>(0.05 * size_m.x() * size_m.y() * random.Uniform(0.3, 1.0));
  for (int i = 0; i < count; ++i) {
    const double u = random.Uniform();
    const Vec2d at_m =
        low_m + Vec2d(0.2 + u * (size_m.x() - 0.4), random.Uniform(0.3, 0.95) * size_m.y());
    const double draw = random.Uniform();
    if (draw < 0.5) {
      const double half_m = random.Uniform(0.06, 0.12);
      canvas.Rect(at_m - Vec2d(half_m, half_m),
                  at_m + Vec2d(half_m, half_m),
                  Rgb::Constant(0.45F),
                  0.9,
                  0.006);
      for (int slot = -2; slot <= 2; ++slot) {
        const double y = at_m.y() + 0.36 * slot * half_m;
        canvas.Line({at_m.x() - 0.8 * half_m, y},
                    {at_m.x() + 0.8 * half_m, y},
                    0.2 * half_m,
                    Rgb::Constant(0.08F),
                    0.9,
                    -0.01);
      }
    } else if (draw < 0.75 && painting.look.surface != WallSurface::kConcrete) {
      const double half_m = random.Uniform(0.12, 0.22);
      const Rgb iron(0.14F, 0.11F, 0.10F);
      canvas.Line(
          at_m + Vec2d(-half_m, -half_m), at_m + Vec2d(half_m, half_m), 0.035, iron, 0.95, 0.012);
      canvas.Line(
          at_m + Vec2d(-half_m, half_m), at_m + Vec2d(half_m, -half_m), 0.035, iron, 0.95, 0.012);
    } else {
      canvas.Rect(at_m,
                  at_m + Vec2d(random.Uniform(0.08, 0.2), random.Uniform(0.1, 0.26)),
                  Rgb::Constant(static_cast<float>(random.Uniform(0.5, 0.85))),
                  0.95,
                  0.03);
    }
  }
}

void PaintStreetLevel(const WallPainting& painting, RandomStream& random, WallCanvas& canvas) {
  for (const WallRect& room : FreeWall(painting, 0.45)) {
    const double width_m = room.high_m.x() - room.low_m.x();
    if (random.Chance(0.3 * painting.marks)) {
      double left_m = room.low_m.x() + random.Uniform(0.0, 0.1);
      const Vec2d size_m = random.Chance(0.5) ? Vec2d(0.42, 0.6) : Vec2d(0.6, 0.84);
      const double level_m = room.low_m.y() + random.Uniform(0.6, 0.9);
      const int most = random.Integer(1, 4);
      for (int i = 0; i < most && left_m + size_m.x() < room.high_m.x(); ++i) {
        PaintPoster({left_m, level_m + random.Uniform(-0.03, 0.03)}, size_m, random.Bits(), canvas);
        left_m += size_m.x() + random.Uniform(-0.02, 0.06);
      }
    }
    for (int i = static_cast<int>(painting.marks * random.Uniform(0.0, 0.55) * width_m + 0.3);
         i > 0;
         --i) {
      PaintTag(room, random.Bits(), canvas);
    }
    if (random.Chance(0.25)) {
      const Vec2d at_m(room.low_m.x() + 0.1, room.low_m.y() + 1.35);
      canvas.Rect(at_m, at_m + Vec2d(0.2, 0.15), Rgb(0.10F, 0.16F, 0.42F), 0.95, 0.004);
      DrawText(std::to_string(random.Integer(1, 98)),
               at_m + Vec2d(0.05, 0.035),
               {0.1, 0.08},
               0.2,
               Rgb::Constant(0.92F),
               canvas);
    }
  }
}

}  // namespace

void PaintMarks(const WallPainting& painting, WallCanvas& canvas) {
  RandomStream random({painting.look.seed, 60, static_cast<uint64_t>(painting.marks > 0.0)});
  PaintFittings(painting, random, canvas);
  if (painting.marks <= 0.0) {
    return;
  }
  if (random.Chance(0.6)) {
    PaintCable(painting, painting.area.high_m.y() - random.Uniform(0.25, 0.5), random, canvas);
  }
  PaintStreetLevel(painting, random, canvas);
}

}  // namespace pfseq
