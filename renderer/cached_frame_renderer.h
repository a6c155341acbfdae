// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/progress.h"
#include "renderer/film/cell_film.h"
#include "renderer/frame_renderer.h"
#include "renderer/lens/lens_raster.h"
#include "renderer/trace/cached_light_tracer.h"

#include <functional>
#include <string>
#include <vector>

namespace pfseq {

/// How many samples a pixel gets.
struct PixelSampling {
  /// Of every pixel.
  int num_samples = 8;
  /// Of a pixel whose samples differ, at most.
  int max_samples = 64;
  /// Standard error of the first samples' mean luminance above which there are more, relative to
  /// that luminance or, in the dark, to reference_radiance / 10.
  float tolerance = 0.03F;
  float reference_radiance = 1.0F;
};

/// Mean radiance over the pixels (box filter), linear Rec. 709, three channels, as RenderRadiance
/// but by stored light. Every pixel gets its first samples; from these alone it follows how many
/// more it and its neighbours get, so that the image does not depend on the number of threads. Of
/// each first sample's stratum of the pixel, textures are looked up in the middle, over the
/// stratum; samples of a view that moves in its exposure have a time in it, as TrailSampling says,
/// and stand for the whole pixel. `progress`, when given, is advanced by one for each pixel.
/// `film`, when given, collects all samples in its cells.
Image<float> RenderCachedRadiance(const CachedLightTracer& tracer,
                                  const LensRaster& raster,
                                  const View& view,
                                  const PixelSampling& sampling,
                                  int num_threads,
                                  Progress* progress,
                                  const std::function<std::string(int x, int y)>& describe_pixel,
                                  CellFilm* film = nullptr);

/// Most of the records that the view looks up and nobody has wanted before: those that one sample
/// in every other column and row finds.
std::vector<LightStore::RecordId> WantedRecords(const CachedLightTracer& tracer,
                                                const LensRaster& raster,
                                                const View& view,
                                                const PixelSampling& sampling,
                                                int num_threads);

}  // namespace pfseq
