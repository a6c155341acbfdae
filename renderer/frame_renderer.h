// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/progress.h"
#include "renderer/core/rigid_transform.h"
#include "renderer/film/cell_film.h"
#include "renderer/film/shutter.h"
#include "renderer/lens/lens.h"
#include "renderer/trace/path_tracer.h"

#include <cstdint>
#include <functional>
#include <string>

namespace pfseq {

/// One camera with one lens at one time, or during an exposure about it.
struct View {
  const Lens* lens = nullptr;
  RigidTransform world_from_camera;
  int width_px = 0;
  int height_px = 0;
  /// What the random numbers of the view are keyed by: two views of one sequence differ in frame or
  /// index.
  uint64_t seed = 0;
  uint64_t frame = 0;
  uint64_t view_idx = 0;
  /// Null: all light falls at once.
  const ExposurePoses* exposure = nullptr;
};

/// Mean radiance over a pixel (box filter), linear Rec. 709. Samples that fall outside the image
/// circle are black, so the circle's edge is smooth. `film`, when given, collects the samples.
Rgb RenderPixel(const PathTracer& tracer,
                const View& view,
                int num_samples,
                int x,
                int y,
                CellFilm* film = nullptr);

/// All pixels, three channels. `progress`, when given, is advanced by one for each pixel.
/// `describe_pixel` tells in a crash how to repeat the pixel alone.
Image<float> RenderRadiance(const PathTracer& tracer,
                            const View& view,
                            int num_samples,
                            int num_threads,
                            Progress* progress,
                            const std::function<std::string(int x, int y)>& describe_pixel,
                            CellFilm* film = nullptr);

}  // namespace pfseq
