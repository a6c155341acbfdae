// SPDX-License-Identifier: Apache-2.0
#include "validator/features/polar_image.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// 182 degrees; R is the radius at which the lens shows 90.
Lens FisheyeOf(double radius_px) {
  return {Equisolid{},
          Vec2d::Constant(radius_px / std::sqrt(2.0)),
          Vec2d(radius_px + 10.0, radius_px + 10.0),
          91.0 * std::numbers::pi / 180.0};
}

TEST(PolarMap, HasTheSizeOfTheReportsExample) {
  // 7431 x 1859 from a circle of about 2310 px.
  const Lens lens = FisheyeOf(1155.0);
  const PolarMap polar(lens, 1.0239);
  EXPECT_EQ(polar.CoreWidthPx(), 7431);
  EXPECT_EQ(polar.HeightPx(), 1859);
}

TEST(PolarMap, AzimuthRunsToTheRightAndIncidenceDown) {
  const Lens lens = FisheyeOf(100.0);
  const PolarMap polar(lens);
  const double margin = PolarMap::kSeamMarginPx;
  EXPECT_LT((polar.DirectionCamera(margin, 0.0) - Vec3d::UnitZ()).norm(), 1e-12);
  const double quarter = 0.25 * polar.CoreWidthPx();
  const double rim = 0.5 * std::numbers::pi * 100.0;
  EXPECT_LT((polar.DirectionCamera(margin, rim) - Vec3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((polar.DirectionCamera(margin + quarter, rim) - Vec3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((*polar.ToFisheye(margin, rim) - Vec2d(210.0, 110.0)).norm(), 1e-9);
}

TEST(PolarMap, PixelsShowTheNearestOfTheFisheyeImage) {
  const Lens lens = FisheyeOf(60.0);
  Image<uint8_t> fisheye(140, 140, 1);
  for (int y = 0; y < 140; ++y) {
    for (int x = 0; x < 140; ++x) {
      fisheye.At(x, y) = static_cast<uint8_t>((x * 7 + y * 13) % 251);
    }
  }
  const PolarMap polar(lens);
  const Image<uint8_t> image = polar.Rectify(fisheye);
  ASSERT_EQ(image.WidthPx(), polar.WidthPx());
  for (int y = 0; y < image.HeightPx() - 1; y += 3) {
    for (int x = 0; x < image.WidthPx(); x += 7) {
      const Vec2d pixel_px = *lens.Project(polar.DirectionCamera(x, y));
      const auto from_x = static_cast<int>(pixel_px.x()), from_y = static_cast<int>(pixel_px.y());
      const double to_edge = std::min({pixel_px.x() - from_x,
                                       pixel_px.y() - from_y,
                                       from_x + 1.0 - pixel_px.x(),
                                       from_y + 1.0 - pixel_px.y()});
      if (to_edge > 1e-9) {
        ASSERT_EQ(image.At(x, y), fisheye.At(from_x, from_y)) << x << " " << y;
      }
    }
  }
}

TEST(PolarMap, BeyondTheSeamTheImageGoesOn) {
  const Lens lens = FisheyeOf(60.0);
  Image<uint8_t> fisheye(140, 140, 1);
  for (int y = 0; y < 140; ++y) {
    for (int x = 0; x < 140; ++x) {
      fisheye.At(x, y) = static_cast<uint8_t>(x + y);
    }
  }
  const PolarMap polar(lens);
  const Image<uint8_t> image = polar.Rectify(fisheye);
  for (int x = 0; x + polar.CoreWidthPx() < image.WidthPx(); ++x) {
    ASSERT_EQ(image.At(x, 50), image.At(x + polar.CoreWidthPx(), 50));
    // Each azimuth counts once.
    ASSERT_NE(polar.IsInCore(x), polar.IsInCore(x + polar.CoreWidthPx()));
  }
}

TEST(PolarMap, RefusesALensThatDoesNotReachTheHorizon) {
  const Lens narrow(Equidistant{}, Vec2d::Constant(50.0), Vec2d(50.0, 50.0), 1.5);
  EXPECT_THAT(MessageOf<InputError>([&] { PolarMap{narrow}; }), testing::HasSubstr("180 degrees"));
}

}  // namespace
}  // namespace pfseq
