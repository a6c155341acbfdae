// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/lens_raster.h"

#include "renderer/core/random.h"
#include "renderer/core/units.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kWidthPx = 300;
constexpr int kHeightPx = 290;

struct Case {
  std::string name;
  Lens lens;
};

/// The lenses of the default sequence, off the centre and with pixels that are not square.
std::vector<Case> Cases() {
  std::vector<Case> cases;
  const double max_angle_rad = RadFromDeg(0.5 * 181.8);
  const auto add = [&](const std::string& name, const LensModel& model, double circle_px) {
    const double focal_px = Lens::FocalFromCirclePx(model, circle_px, max_angle_rad);
    cases.push_back({name,
                     Lens(model,
                          Vec2d(focal_px, 0.97 * focal_px),
                          Vec2d(0.5 * kWidthPx + 0.3, 0.5 * kHeightPx - 0.7),
                          max_angle_rad)});
  };
  add("equidistant", Equidistant{}, 300.0);
  add("equisolid", Equisolid{}, 281.0);
  add("equidistant_small_circle", Equidistant{}, 40.0);
  return cases;
}

class LensRasterOf : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Lenses,
                         LensRasterOf,
                         testing::ValuesIn(Cases()),
                         [](const testing::TestParamInfo<Case>& param_info) {
                           return param_info.param.name;
                         });

TEST_P(LensRasterOf, CentresAreTheLensesOwnToTheLastBit) {
  const Lens& lens = GetParam().lens;
  const LensRaster raster(lens, kWidthPx, kHeightPx, 2);
  int num_inside = 0;
  for (int y = 0; y < kHeightPx; ++y) {
    for (int x = 0; x < kWidthPx; ++x) {
      const std::optional<Vec3d> expected = lens.Unproject({x + 0.5, y + 0.5});
      ASSERT_EQ(raster.CentreDirection(x, y), expected) << x << "," << y;
      num_inside += expected.has_value() ? 1 : 0;
    }
  }
  EXPECT_GT(num_inside, 1000);
}

TEST_P(LensRasterOf, BetweenCornersTheLensIsBilinear) {
  const Lens& lens = GetParam().lens;
  const LensRaster raster(lens, kWidthPx, kHeightPx, 1);
  // The angle of a pixel squared over 8, for the sagitta of one turn about the axis and one along
  // it; in pixels.
  const double tolerance_px = 2.0 / 8.0 / lens.FocalPx().minCoeff();
  RandomStream random({5});
  double worst_px = 0.0;
  for (int y = 0; y < kHeightPx; ++y) {
    for (int x = 0; x < kWidthPx; ++x) {
      if (!raster.IsInside(x, y)) {
        continue;
      }
      const std::array<Vec3f, 4> corners = raster.CornerDirections(x, y);
      const auto u = static_cast<float>(random.Uniform());
      const auto v = static_cast<float>(random.Uniform());
      const Vec3f direction = (1.0F - v) * ((1.0F - u) * corners[0] + u * corners[1]) +
                              v * ((1.0F - u) * corners[2] + u * corners[3]);
      const std::optional<Vec2d> pixel_px = lens.Project(direction.cast<double>());
      ASSERT_TRUE(pixel_px.has_value()) << x << "," << y;
      worst_px = std::max(worst_px, (*pixel_px - Vec2d(x + u, y + v)).norm());
    }
  }
  EXPECT_LT(worst_px, tolerance_px);
  RecordProperty("worst_px", std::to_string(worst_px));
}

TEST_P(LensRasterOf, StatesAgreeWithManyPlacesInEachPixel) {
  const Lens& lens = GetParam().lens;
  const LensRaster raster(lens, kWidthPx, kHeightPx, 2);
  RandomStream random({6});
  int num_rim = 0;
  int num_inside = 0;
  int num_outside = 0;
  for (int y = 0; y < kHeightPx; ++y) {
    for (int x = 0; x < kWidthPx; ++x) {
      const bool is_inside = raster.IsInside(x, y);
      const bool is_outside = raster.IsOutside(x, y);
      ASSERT_FALSE(is_inside && is_outside);
      num_inside += is_inside ? 1 : 0;
      num_outside += is_outside ? 1 : 0;
      num_rim += !is_inside && !is_outside ? 1 : 0;
      for (int k = 0; k < 12; ++k) {
        const Vec2d place_px(x + random.Uniform(), y + random.Uniform());
        const bool is_seen = lens.Unproject(place_px).has_value();
        ASSERT_FALSE(is_inside && !is_seen) << place_px.transpose();
        ASSERT_FALSE(is_outside && is_seen) << place_px.transpose();
      }
    }
  }
  // A rim is some pixels wide: nearly all are told apart.
  EXPECT_GT(num_inside, 900);
  EXPECT_GT(num_outside, 1000);
  EXPECT_LT(num_rim, 8 * kWidthPx);
}

TEST(LensRaster, DoesNotDependOnThreads) {
  const Lens lens = Cases()[1].lens;
  const LensRaster one(lens, 61, 47, 1);
  const LensRaster three(lens, 61, 47, 3);
  for (int y = 0; y < 47; ++y) {
    for (int x = 0; x < 61; ++x) {
      ASSERT_EQ(one.CentreDirection(x, y), three.CentreDirection(x, y));
      ASSERT_EQ(one.IsInside(x, y), three.IsInside(x, y));
      ASSERT_EQ(one.IsOutside(x, y), three.IsOutside(x, y));
      if (one.IsInside(x, y)) {
        ASSERT_EQ(one.CornerDirections(x, y), three.CornerDirections(x, y));
      }
    }
  }
}

}  // namespace
}  // namespace pfseq
