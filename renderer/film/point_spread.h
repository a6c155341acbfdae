// SPDX-License-Identifier: Apache-2.0
// How a lens spreads the light of a point over the film: lateral and axial colour, dispersion, blur
// and defocus. None of them depends on distance, so they act on the light collected in the film's
// cells, for each colour and place with the exact integral of the spread over cell and pixel.
#pragma once

#include "renderer/core/image.h"
#include "renderer/film/cell_film.h"
#include "renderer/film/kernel_grid.h"
#include "renderer/film/spread_kernel.h"
#include "renderer/lens/lateral_color.h"
#include "renderer/lens/lens.h"
#include "renderer/lens/spectrum.h"
#include "renderer/sequence/camera_spec.h"

#include <memory>
#include <mutex>
#include <vector>

namespace pfseq {

/// The spread is a sum over the spectrum of Gaussians: a wavelength w has the middle of
/// LateralColor and the variances, along and across the radius at rho = r / R,
///   radial      (c + (b_r - c) rho^2)^2 + a(w)^2 + d^2 / 16 + (e rho^2)^2
///   tangential  (c + (b_t - c) rho^2)^2 + a(w)^2 + d^2 / 16
/// with c, b_r, b_t of BlurSpec, d the diameter of the circle of confusion (a disc's variance is
/// d^2 / 16), e the dispersion blur, a(w) = A ((w - 550 nm) / 110 nm)^2 the axial colour (the
/// secondary spectrum of an achromat is a parabola about its focus). Where the two differ, the
/// excess of one is made of several Gaussians on a line. Per channel and pixel the weights add up
/// to 1, so an even surface keeps its radiance.
class PointSpread {
 public:
  /// Pixel figures of the spec are taken as they are. The lens must outlive this.
  PointSpread(const OpticsSpec& spec, const Lens& lens);

  /// The pixels of an image. Beyond the film's edges the light at the edge goes on. The first film
  /// takes longer than others of its size.
  Image<float> Apply(const CellFilm& film, int num_threads) const;

 private:
  /// A Gaussian of the light that a pixel collects: where it comes from against the pixel's centre
  /// and how much of it each channel takes.
  struct Node {
    Vec2d offset_px;
    double sigma_px;
    Vec3d weights;
  };

  std::vector<Node> NodesAt(const Vec2d& place_px) const;
  SpreadKernel KernelAt(const Vec2d& place_px) const;
  /// The kernels of an image of this size.
  std::shared_ptr<KernelGrid> KernelsFor(int width_px, int height_px) const;

  OpticsSpec spec_;
  Vec2d principal_point_px_;
  double circle_radius_px_;
  LateralColor lateral_color_;
  std::vector<SpectralSample> spectrum_;
  mutable std::mutex kernels_mutex_;
  mutable std::shared_ptr<KernelGrid> kernels_;
};

/// The optics at an image width: its pixel figures scaled and image_width_px 0.
OpticsSpec ScaledOptics(OpticsSpec spec, int width_px);

}  // namespace pfseq
