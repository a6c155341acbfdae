// SPDX-License-Identifier: Apache-2.0
// A lens and pictures for the tests of optics.
#pragma once

#include "renderer/core/units.h"
#include "renderer/film/cell_film.h"
#include "renderer/lens/lens.h"

#include <functional>

namespace pfseq {

inline constexpr int kSmallSizePx = 300;
inline constexpr double kSmallCircleRadiusPx = 140.0;
inline const Vec2d kSmallMiddlePx(150.0, 150.0);

/// Equidistant to 90 degrees.
inline Lens SmallLens() {
  return Lens(Equidistant{},
              Vec2d::Constant(Lens::FocalFromCirclePx(
                  Equidistant{}, 2.0 * kSmallCircleRadiusPx, RadFromDeg(90.0))),
              kSmallMiddlePx,
              RadFromDeg(90.0));
}

/// The film under a light that is given by place, with one sample for each cell: the mean over 4 x
/// 4 places in it.
inline CellFilm FilmOf(const std::function<double(const Vec2d& place_px)>& light) {
  CellFilm film(kSmallSizePx, kSmallSizePx);
  constexpr int kFine = 4;
  for (int y = 0; y < kSmallSizePx; ++y) {
    for (int x = 0; x < kSmallSizePx; ++x) {
      for (int cell = 0; cell < CellFilm::kCells * CellFilm::kCells; ++cell) {
        const Vec2d corner(0.5 * (cell % 2), 0.5 * (cell / 2));
        double sum = 0.0;
        for (int i = 0; i < kFine * kFine; ++i) {
          const Vec2d inside((i % kFine + 0.5) / kFine, (i / kFine + 0.5) / kFine);
          sum += light(Vec2d(x, y) + corner + 0.5 * inside);
        }
        CellFilm::Cell& target = film.At(x, y, corner.cast<float>());
        target.sum = Rgb::Constant(static_cast<float>(sum / (kFine * kFine)));
        target.num_samples = 1.0F;
      }
    }
  }
  return film;
}

}  // namespace pfseq
