// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/point_spread.h"

#include "renderer/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

/// The spread is taken as the same within blocks of pixels of this side: over four pixels from its
/// middle a shift of 3 px at the rim of a circle of 1200 px changes by 0.02 px.
constexpr int kBlockPx = 8;
/// Between Gaussians that make a longer one.
constexpr double kCombStepPx = 0.75;
constexpr int kCells = CellFilm::kCells;
/// A cell counts as evenly lit, which spreads its light already by this variance.
constexpr double kCellVariancePx2 = 1.0 / (12.0 * kCells * kCells);
/// Neighbouring wavelengths fall at most so far apart.
constexpr double kSpectralStepPx = 0.4;
constexpr int kMinSpectralSamples = 12;
constexpr int kMaxSpectralSamples = 96;

int NumSpectralSamples(const OpticsSpec& spec) {
  const double range_px = std::abs(spec.lateral_color.rim_px) *
                          (LateralColor::Dispersion(700.0) - LateralColor::Dispersion(400.0));
  return std::clamp(static_cast<int>(std::ceil(range_px / kSpectralStepPx)),
                    kMinSpectralSamples,
                    kMaxSpectralSamples);
}

/// Where Gaussians of a common width along a line make a wider one.
struct Comb {
  std::vector<double> places;
  std::vector<double> weights;
};

/// A Gaussian of the standard deviation `sigma` made of others `own_sigma` wide.
Comb MakeComb(double sigma, double own_sigma) {
  const double step = std::max(kCombStepPx, 1.2 * own_sigma);
  if (std::sqrt(3.0) * sigma <= step) {
    // Gauss-Hermite quadrature, exact up to the fifth moment.
    return {{-std::sqrt(3.0) * sigma, 0.0, std::sqrt(3.0) * sigma}, {1.0 / 6, 2.0 / 3, 1.0 / 6}};
  }
  Comb comb;
  constexpr double kEndSigmas = 3.0;
  const int num_steps =
      static_cast<int>(std::ceil(kEndSigmas * sigma / std::min(step, 0.8 * sigma)));
  double sum = 0.0;
  for (int i = -num_steps; i <= num_steps; ++i) {
    const double place = kEndSigmas * sigma * i / num_steps;
    comb.places.push_back(place);
    comb.weights.push_back(std::exp(-0.5 * place * place / (sigma * sigma)));
    sum += comb.weights.back();
  }
  for (double& weight : comb.weights) {
    weight /= sum;
  }
  return comb;
}

/// The film's cells by their place in the pixel and channel, with a margin that repeats the edge:
/// neighbouring pixels lie side by side.
class Planes {
 public:
  Planes(const CellFilm& film, int margin_px, int num_threads)
      : margin_px_(margin_px),
        stride_(static_cast<size_t>(film.WidthPx() + 2 * margin_px + kBlockPx)),
        rows_(static_cast<size_t>(film.HeightPx() + 2 * margin_px + kBlockPx)) {
    for (std::vector<float>& plane : planes_) {
      plane.resize(stride_ * rows_);
    }
    ParallelFor(rows_, num_threads, [&](size_t row) {
      const int y = std::clamp(static_cast<int>(row) - margin_px, 0, film.HeightPx() - 1);
      for (size_t column = 0; column < stride_; ++column) {
        const int x = std::clamp(static_cast<int>(column) - margin_px, 0, film.WidthPx() - 1);
        for (int cell = 0; cell < kCells * kCells; ++cell) {
          const Rgb mean = film.Mean(x, y, cell % kCells, cell / kCells);
          for (int channel = 0; channel < 3; ++channel) {
            planes_[static_cast<size_t>(cell * 3 + channel)][row * stride_ + column] =
                mean[channel];
          }
        }
      }
    });
  }

  /// The row of cells that starts with the pixel (x, y); kBlockPx pixels on.
  const float* Row(int x, int y, int cell_x, int cell_y, int channel) const {
    return planes_[static_cast<size_t>((cell_y * kCells + cell_x) * 3 + channel)].data() +
           static_cast<size_t>(y + margin_px_) * stride_ + static_cast<size_t>(x + margin_px_);
  }

 private:
  int margin_px_;
  size_t stride_;
  size_t rows_;
  std::array<std::vector<float>, static_cast<size_t>(kCells) * kCells * 3> planes_;
};

}  // namespace

PointSpread::PointSpread(const OpticsSpec& spec, const Lens& lens)
    : spec_(spec),
      principal_point_px_(lens.PrincipalPointPx()),
      circle_radius_px_(0.5 * lens.CirclePx()),
      lateral_color_(spec.lateral_color.rim_px, spec.lateral_color.cubic, circle_radius_px_) {
  if (spec.lateral_color.rim_px != 0.0 || spec.axial_color_sigma_px > 0.0) {
    spectrum_ = VisibleSpectrum(NumSpectralSamples(spec));
  } else {
    spectrum_ = {{LateralColor::kReferenceNm, Vec3d::Ones()}};
  }
}

std::vector<PointSpread::Node> PointSpread::NodesAt(const Vec2d& place_px) const {
  const Vec2d from_axis_px = place_px - principal_point_px_;
  const double height_px = from_axis_px.norm();
  const Vec2d radial = height_px > 1e-9 ? Vec2d(from_axis_px / height_px) : Vec2d::UnitX();
  const Vec2d tangential(-radial.y(), radial.x());
  const double rho = height_px / circle_radius_px_;
  const auto square = [](double value) { return value * value; };
  const BlurSpec& blur = spec_.blur;
  const auto blur_sigma_px = [&](double rim_px) {
    return blur.center_sigma_px + (rim_px - blur.center_sigma_px) * std::min(rho * rho, 1.0);
  };
  std::vector<Node> nodes;
  for (const SpectralSample& sample : spectrum_) {
    constexpr double kAxialScaleNm = 110.0;
    const double axial_px =
        spec_.axial_color_sigma_px *
        square((sample.wavelength_nm - LateralColor::kReferenceNm) / kAxialScaleNm);
    const double common_px2 = square(axial_px) + square(spec_.defocus_px) / 16.0;
    const double radial_px2 = common_px2 + square(blur_sigma_px(blur.rim_sigma_px[0])) +
                              square(spec_.dispersion_sigma_px * rho * rho);
    const double tangential_px2 = common_px2 + square(blur_sigma_px(blur.rim_sigma_px[1]));
    const Vec2d middle_px =
        radial * (lateral_color_.ReferenceHeightPx(sample.wavelength_nm, height_px) - height_px);
    const double sigma_px =
        std::sqrt(std::max(0.0, std::min(radial_px2, tangential_px2) - kCellVariancePx2));
    const double excess_px2 = std::abs(radial_px2 - tangential_px2);
    if (excess_px2 < 1e-6) {
      nodes.push_back({middle_px, sigma_px, sample.weights});
      continue;
    }
    const Vec2d axis = radial_px2 > tangential_px2 ? radial : tangential;
    const Comb comb = MakeComb(std::sqrt(excess_px2), sigma_px);
    for (size_t i = 0; i < comb.places.size(); ++i) {
      nodes.push_back(
          {middle_px + comb.places[i] * axis, sigma_px, sample.weights * comb.weights[i]});
    }
  }
  return nodes;
}

SpreadKernel PointSpread::KernelAt(const Vec2d& place_px) const {
  const std::vector<Node> nodes = NodesAt(place_px);
  double reach_px = 0.0;
  for (const Node& node : nodes) {
    reach_px = std::max(
        reach_px,
        node.offset_px.cwiseAbs().maxCoeff() + SpreadKernel::kCutoffSigmas * node.sigma_px);
  }
  // A Gaussian about the pixel's centre reaches half a pixel beyond its cutoff, which the pixel
  // itself has.
  SpreadKernel kernel(static_cast<int>(std::ceil(reach_px)));
  for (const Node& node : nodes) {
    kernel.AddGaussian(node.offset_px, node.sigma_px, node.weights);
  }
  return kernel.Trimmed();
}

std::shared_ptr<KernelGrid> PointSpread::KernelsFor(int width_px, int height_px) const {
  const std::lock_guard lock(kernels_mutex_);
  if (kernels_ == nullptr || kernels_->WidthPx() != width_px ||
      kernels_->HeightPx() != height_px) {
    kernels_ = std::make_shared<KernelGrid>(
        width_px, height_px, kBlockPx, principal_point_px_, [this](const Vec2d& middle_px) {
          return KernelAt(middle_px);
        });
  }
  return kernels_;
}

Image<float> PointSpread::Apply(const CellFilm& film, int num_threads) const {
  const int width_px = film.WidthPx();
  const int height_px = film.HeightPx();
  // The spread is widest in a corner.
  int margin_px = 0;
  for (const Vec2d& corner_px : {Vec2d(0, 0),
                                 Vec2d(width_px, 0),
                                 Vec2d(0, height_px),
                                 Vec2d(width_px, height_px),
                                 Vec2d(principal_point_px_)}) {
    margin_px = std::max(margin_px, KernelAt(corner_px).ReachPx());
  }
  ++margin_px;
  const Planes planes(film, margin_px, num_threads);
  const std::shared_ptr<KernelGrid> kernels = KernelsFor(width_px, height_px);
  Image<float> image(width_px, height_px, 3);
  const auto num_rows = static_cast<size_t>((height_px + kBlockPx - 1) / kBlockPx);
  ParallelFor(num_rows, num_threads, [&](size_t block_row) {
    const int y0 = static_cast<int>(block_row) * kBlockPx;
    for (int x0 = 0; x0 < width_px; x0 += kBlockPx) {
      const KernelGrid::Oriented kernel =
          kernels->Of(x0 / kBlockPx, static_cast<int>(block_row));
      const int reach_px = kernel.kernel->ReachPx();
      const int side = kernel.kernel->Side();
      const int skipped = std::max(0, reach_px - margin_px) * kCells;
      for (int y = y0; y < std::min(y0 + kBlockPx, height_px); ++y) {
        std::array<std::array<float, kBlockPx>, 3> sums{};
        for (size_t channel = 0; channel < 3; ++channel) {
          std::array<float, kBlockPx> sum{};
          for (int j = skipped; j < side - skipped; ++j) {
            for (int i = skipped; i < side - skipped; ++i) {
              const float weight = kernel.At(channel, i, j);
              const float* cells = planes.Row(x0 - reach_px + i / kCells,
                                              y - reach_px + j / kCells,
                                              i % kCells,
                                              j % kCells,
                                              static_cast<int>(channel));
              for (size_t k = 0; k < kBlockPx; ++k) {
                sum[k] += weight * cells[k];
              }
            }
          }
          sums[channel] = sum;
        }
        const int x1 = std::min(x0 + kBlockPx, width_px);
        for (int x = x0; x < x1; ++x) {
          for (int channel = 0; channel < 3; ++channel) {
            image.At(x, y, channel) =
                sums[static_cast<size_t>(channel)][static_cast<size_t>(x - x0)];
          }
        }
      }
    }
  });
  return image;
}

OpticsSpec ScaledOptics(OpticsSpec spec, int width_px) {
  if (spec.image_width_px == 0) {
    return spec;
  }
  const double scale = static_cast<double>(width_px) / spec.image_width_px;
  spec.image_width_px = 0;
  for (double* figure_px : {&spec.lateral_color.rim_px,
                            &spec.axial_color_sigma_px,
                            &spec.dispersion_sigma_px,
                            &spec.blur.center_sigma_px,
                            &spec.blur.rim_sigma_px[0],
                            &spec.blur.rim_sigma_px[1],
                            &spec.defocus_px,
                            &spec.rim.width_px,
                            &spec.glare.bloom_radius_px,
                            &spec.sun_star.length_px,
                            &spec.sun_star.width_px}) {
    *figure_px *= scale;
  }
  for (Named<GhostSpec>& ghost : spec.ghosts) {
    ghost.value.radius_px *= scale;
  }
  return spec;
}

}  // namespace pfseq
