// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/point_spread.h"

#include "tests/film/small_lens.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Image<float> Spread(const OpticsSpec& spec, const CellFilm& film, int num_threads = 2) {
  const Lens lens = SmallLens();
  return PointSpread(spec, lens).Apply(film, num_threads);
}

/// All effects at once.
OpticsSpec AllEffects() {
  OpticsSpec spec;
  spec.lateral_color = {3.0, 0.5};
  spec.axial_color_sigma_px = 1.0;
  spec.dispersion_sigma_px = 1.5;
  spec.blur = {0.5, {1.0, 0.7}};
  spec.defocus_px = 2.0;
  return spec;
}

/// A point light: the cell right below a pixel's corner.
CellFilm PointAt(const Vec2d& corner_px) {
  return FilmOf([&](const Vec2d& place_px) {
    const Vec2d d = place_px - corner_px;
    return d.minCoeff() > 0.0 && d.maxCoeff() < 0.5 ? 1.0 : 0.0;
  });
}

/// Sum, mean place and covariance of a channel's light.
struct Moments {
  double sum = 0.0;
  Vec2d mean_px = Vec2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
};
Moments MomentsOf(const Image<float>& image, int channel) {
  Moments moments;
  for (int y = 0; y < image.HeightPx(); ++y) {
    for (int x = 0; x < image.WidthPx(); ++x) {
      moments.sum += image.At(x, y, channel);
      moments.mean_px += image.At(x, y, channel) * Vec2d(x + 0.5, y + 0.5);
    }
  }
  moments.mean_px /= moments.sum;
  for (int y = 0; y < image.HeightPx(); ++y) {
    for (int x = 0; x < image.WidthPx(); ++x) {
      const Vec2d d = Vec2d(x + 0.5, y + 0.5) - moments.mean_px;
      moments.covariance_px2 += image.At(x, y, channel) / moments.sum * d * d.transpose();
    }
  }
  return moments;
}

/// The pixel itself.
constexpr double kPixelVariancePx2 = 1.0 / 12.0;

TEST(PointSpread, WhiteStaysWhite) {
  const Image<float> image = Spread(AllEffects(), FilmOf([](const Vec2d&) { return 0.7; }));
  for (const float value : image.Values()) {
    ASSERT_NEAR(value, 0.7F, 2e-5F);
  }
}

TEST(PointSpread, EdgesFallWhereTheChannelsPolynomialsHaveThem) {
  OpticsSpec spec;
  spec.lateral_color = {4.0, 0.5};
  const auto polynomials = LateralColor(4.0, 0.5, kSmallCircleRadiusPx).ChannelPolynomials();
  for (const double height_px : {25.0, 52.0, 79.0, 106.0, 133.0}) {
    const auto disc = [&](const Vec2d& place_px) {
      return (place_px - kSmallMiddlePx).norm() < height_px ? 1.0 : 0.0;
    };
    const CellFilm film = FilmOf(disc);
    const Image<float> image = Spread(spec, film);
    for (int channel = 0; channel < 3; ++channel) {
      const auto& c = polynomials[static_cast<size_t>(channel)];
      // Along the two middle rows, to both sides; and as far without lateral colour.
      double edge_px = 0.0;
      double reference_px = 0.0;
      for (int y = 149; y <= 150; ++y) {
        for (int x = 0; x < kSmallSizePx; ++x) {
          edge_px += 0.25 * image.At(x, y, channel);
          for (int cell = 0; cell < 4; ++cell) {
            reference_px += 0.25 * 0.25 * film.Mean(x, y, cell % 2, cell / 2)[channel];
          }
        }
      }
      EXPECT_NEAR(edge_px - reference_px, c[0] * height_px + c[1] * std::pow(height_px, 3), 0.03)
          << height_px << " " << channel;
    }
  }
}

TEST(PointSpread, BlurHasTheEncircledEnergyOfAGaussian) {
  OpticsSpec spec;
  spec.blur = {1.6, {1.6, 1.6}};
  const Image<float> image = Spread(spec, PointAt(kSmallMiddlePx));
  const Vec2d middle_px = kSmallMiddlePx + Vec2d(0.25, 0.25);
  for (const double radius_px : {1.0, 2.0, 3.0, 5.0}) {
    double inside = 0.0;
    constexpr int kFine = 16;
    for (int y = 130; y < 170; ++y) {
      for (int x = 130; x < 170; ++x) {
        int count = 0;
        for (int i = 0; i < kFine * kFine; ++i) {
          const Vec2d place_px(x + (i % kFine + 0.5) / kFine, y + (i / kFine + 0.5) / kFine);
          count += (place_px - middle_px).norm() < radius_px ? 1 : 0;
        }
        inside += image.At(x, y, 1) * count / (kFine * kFine);
      }
    }
    // The pixels' squares, once when they collect light and once when they show it, widen it.
    const double variance_px2 = 1.6 * 1.6 + 2.0 * kPixelVariancePx2;
    const double expected = 1.0 - std::exp(-radius_px * radius_px / (2.0 * variance_px2));
    EXPECT_NEAR(inside / 0.25, expected, 0.01) << radius_px;
  }
}

TEST(PointSpread, BlurGrowsToTheRimAlongAndAcrossTheRadius) {
  OpticsSpec spec;
  spec.blur = {0.6, {2.2, 1.2}};
  // rho = 0.8 on the diagonal: 0.64 of the way from the middle to the rim.
  const double height_px = 0.8 * kSmallCircleRadiusPx;
  const Vec2d place_px =
      (kSmallMiddlePx + Vec2d::Constant(height_px / std::sqrt(2.0))).array().round();
  const Moments moments = MomentsOf(Spread(spec, PointAt(place_px)), 0);
  const Vec2d radial = Vec2d(1.0, 1.0).normalized();
  const Vec2d tangential = Vec2d(1.0, -1.0).normalized();
  const double radial_px = 0.6 + 0.64 * 1.6;
  const double tangential_px = 0.6 + 0.64 * 0.6;
  EXPECT_NEAR(radial.dot(moments.covariance_px2 * radial) - kPixelVariancePx2,
              radial_px * radial_px,
              0.04 * radial_px * radial_px);
  EXPECT_NEAR(tangential.dot(moments.covariance_px2 * tangential) - kPixelVariancePx2,
              tangential_px * tangential_px,
              0.04 * tangential_px * tangential_px);
  // The blur grows within its own width in so small an image: outside it takes more of the point.
  EXPECT_NEAR(moments.sum, 0.25, 0.01);
}

TEST(PointSpread, DispersionSpreadsAlongTheRadiusAlone) {
  OpticsSpec spec;
  spec.dispersion_sigma_px = 2.0;
  const Moments moments = MomentsOf(Spread(spec, PointAt(kSmallMiddlePx + Vec2d(112.0, 0.0))), 1);
  EXPECT_NEAR(moments.covariance_px2(0, 0) - kPixelVariancePx2, 4.0 * std::pow(0.8, 4), 0.1);
  // Across the radius the light stays in its row of pixels.
  EXPECT_LT(moments.covariance_px2(1, 1), 0.03);
}

TEST(PointSpread, DefocusHasTheVarianceOfADisc) {
  OpticsSpec spec;
  spec.defocus_px = 8.0;
  const Moments moments = MomentsOf(Spread(spec, PointAt(kSmallMiddlePx)), 2);
  EXPECT_NEAR(moments.covariance_px2(0, 0) - kPixelVariancePx2, 4.0, 0.05);
}

TEST(PointSpread, AxialColorGivesBrightEdgesAPurpleFringe) {
  OpticsSpec spec;
  spec.axial_color_sigma_px = 3.0;
  const auto half = [](const Vec2d& place_px) { return place_px.x() < 150.0 ? 20.0 : 0.0; };
  const Image<float> image = Spread(spec, FilmOf(half));
  // Two to four pixels off the edge green is dark, red and blue are not.
  for (int x = 152; x < 154; ++x) {
    EXPECT_GT(image.At(x, 150, 0), 1.3F * image.At(x, 150, 1));
    EXPECT_GT(image.At(x, 150, 2), 2.0F * image.At(x, 150, 1));
  }
}

TEST(PointSpread, DoesNotDependOnThreads) {
  const CellFilm film = FilmOf([](const Vec2d& place_px) {
    return std::abs(std::sin(0.3 * place_px.x()) + std::cos(0.2 * place_px.y()));
  });
  EXPECT_EQ(Spread(AllEffects(), film, 1), Spread(AllEffects(), film, 3));
}

TEST(ScaledOptics, ScalesPixelFiguresWithTheImage) {
  OpticsSpec spec = AllEffects();
  spec.image_width_px = 1200;
  spec.ghosts = {{"one", GhostSpec{.position = -0.5, .radius_px = 40.0}}};
  const OpticsSpec scaled = ScaledOptics(spec, 300);
  EXPECT_DOUBLE_EQ(scaled.lateral_color.rim_px, 0.75);
  EXPECT_DOUBLE_EQ(scaled.blur.rim_sigma_px[1], 0.175);
  EXPECT_DOUBLE_EQ(scaled.ghosts[0].value.radius_px, 10.0);
  EXPECT_DOUBLE_EQ(scaled.ghosts[0].value.position, -0.5);
  spec.image_width_px = 0;
  EXPECT_EQ(ScaledOptics(spec, 300), spec);
}

}  // namespace
}  // namespace pfseq
