// SPDX-License-Identifier: Apache-2.0
// All that a lens does to the light of a realistic frame, in the order in which light meets it.
#pragma once

#include "renderer/core/image.h"
#include "renderer/film/cell_film.h"
#include "renderer/film/falloff.h"
#include "renderer/film/flare.h"
#include "renderer/film/glare.h"
#include "renderer/film/point_spread.h"

#include <vector>

namespace pfseq {

class Optics {
 public:
  /// The lens must outlive this.
  Optics(const OpticsSpec& spec, const Lens& lens, int width_px)
      : spec_(ScaledOptics(spec, width_px)),
        point_spread_(spec_, lens),
        falloff_(spec_, lens),
        flare_(spec_, lens),
        glare_(spec_.glare, lens) {}

  const OpticsSpec& Spec() const { return spec_; }

  /// The radiance of the pixels, spread over the film.
  Image<float> Spread(const CellFilm& film, int num_threads) const {
    return point_spread_.Apply(film, num_threads);
  }

  /// The light of star and ghosts alone.
  Image<float> FlareAlone(const std::vector<SunImage>& sun,
                          int width_px,
                          int height_px,
                          int num_threads) const {
    Image<float> flare(width_px, height_px, 3);
    flare_.Add(sun, flare, num_threads);
    return flare;
  }

  /// The light that reaches the sensor, from the radiance of the pixels: vignetting and rim, flare,
  /// glare.
  void Finish(const std::vector<SunImage>& sun, Image<float>& radiance, int num_threads) const {
    if (spec_.HasFalloff()) {
      falloff_.Apply(radiance, num_threads);
    }
    flare_.Add(sun, radiance, num_threads);
    if (spec_.HasGlare()) {
      glare_.Apply(radiance, num_threads);
    }
  }

 private:
  OpticsSpec spec_;
  PointSpread point_spread_;
  Falloff falloff_;
  Flare flare_;
  Glare glare_;
};

}  // namespace pfseq
