// SPDX-License-Identifier: Apache-2.0
#include "renderer/blur_vectors.h"

#include "tests/renderer/two_boxes.h"
#include "tests/support/simple_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kSizePx = 80;
constexpr double kFocalPx = 25.0;
constexpr double kExposureS = 0.1;

/// An equidistant lens of 170 degrees that looks up from the origin, the image's x along the
/// world's and y along it too.
struct Fisheye {
  Lens lens{
      Equidistant{}, Vec2d::Constant(kFocalPx), Vec2d::Constant(0.5 * kSizePx), RadFromDeg(85.0)};
  LensRaster raster{lens, kSizePx, kSizePx, 1};
};

RigidTransform Turned(double angle_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Vec3d::UnitZ())), Vec3d::Zero()};
}

RigidTransform Moved(double along_x_m) {
  return {Eigen::Quaterniond::Identity(), Vec3d(along_x_m, 0.0, 0.0)};
}

Vec2d VectorAt(const Image<float>& vectors, int x, int y) {
  return {vectors.At(x, y, 0), vectors.At(x, y, 1)};
}

/// A ceiling of 200 m at this height and nothing else.
std::shared_ptr<const Scene> Ceiling(float height_m) {
  return SceneOfMesh(Quad(
      {-100, -100, height_m}, {-100, 100, height_m}, {100, 100, height_m}, {100, -100, height_m}));
}

TEST(RenderBlurVectors, ATurnMovesPixelsRoundTheMiddle) {
  const Fisheye fisheye;
  const RayScene rays(Ceiling(3.0F));
  constexpr double kRateRadps = 0.8;
  const Image<float> vectors = RenderBlurVectors(
      rays, fisheye.raster, [](double t) { return Turned(kRateRadps * t); }, kExposureS, 2);
  for (const auto& [x, y] : {std::pair(60, 40), std::pair(30, 65), std::pair(40, 40)}) {
    // What stands still turns against the camera.
    const Vec2d from_middle(x + 0.5 - 0.5 * kSizePx, y + 0.5 - 0.5 * kSizePx);
    const Vec2d expected = -kRateRadps * kExposureS * Vec2d(-from_middle.y(), from_middle.x());
    EXPECT_LT((VectorAt(vectors, x, y) - expected).norm(), 1e-3) << x << ' ' << y;
  }
}

TEST(RenderBlurVectors, ACeilingMovesByItsAngle) {
  const Fisheye fisheye;
  constexpr double kHeightM = 3.0;
  constexpr double kSpeedMps = 5.0;
  const RayScene rays(Ceiling(kHeightM));
  const Image<float> vectors = RenderBlurVectors(
      rays, fisheye.raster, [](double t) { return Moved(kSpeedMps * t); }, kExposureS, 1);
  // Along the row through the middle: theta = atan(x / h), so f dtheta = -f v t cos^2(theta) / h;
  // half a pixel off it, the row's height over the middle adds a little.
  for (const int x : {40, 50, 65}) {
    const double theta_rad = (x + 0.5 - 0.5 * kSizePx) / kFocalPx;
    const double expected =
        -kFocalPx * kSpeedMps * kExposureS / kHeightM * std::pow(std::cos(theta_rad), 2);
    EXPECT_NEAR(VectorAt(vectors, x, 40).x(), expected, 0.01) << x;
  }
}

TEST(RenderBlurVectors, TheSkyStandsWhereItIs) {
  const Fisheye fisheye;
  const RayScene rays(SceneOfMesh(Quad({50, 0, -9}, {51, 0, -9}, {51, 1, -9}, {50, 1, -9})));
  const Image<float> vectors = RenderBlurVectors(
      rays, fisheye.raster, [](double t) { return Moved(20.0 * t); }, kExposureS, 1);
  for (const auto& [x, y] : {std::pair(60, 40), std::pair(30, 65), std::pair(2, 40)}) {
    EXPECT_LT(VectorAt(vectors, x, y).norm(), 1e-9) << x << ' ' << y;
  }
}

TEST(RenderBlurVectors, NothingMovesWithoutAnExposureAndOutsideTheCircle) {
  const Fisheye fisheye;
  const RayScene rays(Ceiling(3.0F));
  const auto drive = [](double t) { return Moved(5.0 * t); };
  const Image<float> still = RenderBlurVectors(rays, fisheye.raster, drive, 0.0, 1);
  EXPECT_EQ(VectorAt(still, 60, 40), Vec2d(Vec2d::Zero()));
  const Image<float> moving = RenderBlurVectors(rays, fisheye.raster, drive, kExposureS, 1);
  EXPECT_EQ(VectorAt(moving, 1, 1), Vec2d(Vec2d::Zero()));
  EXPECT_GT(VectorAt(moving, 60, 40).norm(), 0.1);
}

TEST(RenderBlurVectors, WhatLeavesTheViewCountsByItsOtherHalf) {
  const Fisheye fisheye;
  const RayScene rays(Ceiling(3.0F));
  // A tilt about y carries the rim in +x out of the view.
  const auto tilted = [](double angle_rad) {
    return RigidTransform{Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Vec3d::UnitY())),
                          Vec3d::Zero()};
  };
  const int rim_x = static_cast<int>(0.5 * kSizePx + kFocalPx * RadFromDeg(85.0) - 0.6);
  constexpr double kHalfTurnRad = 0.05;
  const ImageMotion motion(
      rays, fisheye.raster, tilted(0.0), tilted(-kHalfTurnRad), tilted(kHalfTurnRad));
  const double expected = -2.0 * kFocalPx * kHalfTurnRad;
  EXPECT_NEAR(motion.AtPx(rim_x, 40).x(), expected, 0.02);
  EXPECT_NEAR(motion.AtPx(40, 40).x(), expected, 0.02);
}

}  // namespace
}  // namespace pfseq
