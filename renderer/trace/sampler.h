// SPDX-License-Identifier: Apache-2.0
// Sample points without state: Owen-scrambled Sobol points, after Burley 2020, "Practical
// Hash-based Owen Scrambling" (JCGT 9(4)). Every draw of a path is a two-dimensional Sobol sequence
// of its own ("padding"), with its own order and its own scrambling, so any number of draws and of
// samples is well stratified pair by pair.
#pragma once

#include "renderer/core/random.h"
#include "renderer/core/vector.h"

#include <cstdint>

namespace pfseq {

/// The `index`-th point of the Sobol sequence of two dimensions, as 32-bit fractions. Dimension 0
/// is the van der Corput sequence, dimension 1 the Pascal matrix (Sobol 1967). Each block of 2^m
/// points that starts at a multiple of 2^m is a (0, m, 2)-net in base 2.
struct SobolPoint {
  uint32_t x = 0;
  uint32_t y = 0;
};
SobolPoint Sobol2D(uint32_t index);

/// Dimension 2 of the Sobol sequence, of the polynomial x^2 + x + 1 with the initial numbers 1 and
/// 3 of Joe and Kuo 2008, "Constructing Sobol sequences with better two-dimensional projections".
uint32_t SobolThird(uint32_t index);

/// Owen's nested uniform scrambling of a 32-bit fraction, chosen by `seed`: each bit is flipped or
/// not depending on the seed and all bits above it.
uint32_t NestedUniformScramble(uint32_t bits, uint32_t seed);

/// The sample points of one path. A point depends on the key, the sample's index and the number of
/// the draw alone, so it is the same for any number of threads and any order of work. All values
/// are in [0, 1).
class PixelSampler {
 public:
  /// Draws that the camera may take before the first surface, and draws of each surface after it.
  static constexpr int kCameraDraws = 8;
  static constexpr int kDrawsPerVertex = 8;

  PixelSampler(
      uint64_t seed, uint64_t frame, uint64_t camera_idx, uint64_t pixel_idx, uint32_t sample_idx)
      : key_(HashKey({seed, frame, camera_idx, pixel_idx})), sample_idx_(sample_idx) {}

  /// Makes the next draw the first of the given surface (0 is the one that the camera sees),
  /// whatever was drawn before: a path that takes fewer draws at one surface does not change those
  /// at the next.
  void StartVertex(int vertex_idx) {
    draw_idx_ =
        static_cast<uint64_t>(kCameraDraws) + static_cast<uint64_t>(vertex_idx) * kDrawsPerVertex;
  }

  /// Leaves out draws.
  void Skip(int num_draws) { draw_idx_ += static_cast<uint64_t>(num_draws); }

  /// The same pixel's numbers for another sample, from the first draw.
  PixelSampler ForSample(uint32_t sample_idx) const {
    PixelSampler sampler = *this;
    sampler.sample_idx_ = sample_idx;
    sampler.draw_idx_ = 0;
    return sampler;
  }

  double Get1D();
  Vec2d Get2D();
  /// Its first two are what Get2D would give; all three together are a Sobol sequence.
  Vec3d Get3D();

 private:
  uint64_t key_;
  uint64_t draw_idx_ = 0;
  uint32_t sample_idx_;
};

}  // namespace pfseq
