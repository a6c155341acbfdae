// SPDX-License-Identifier: Apache-2.0
#include "renderer/blur_vectors.h"

#include "renderer/core/units.h"
#include "tests/support/driving.h"
#include "tests/support/simple_scenes.h"

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kSizePx = 81;
/// The principal point is the centre of a pixel.
constexpr int kMiddle = kSizePx / 2;
constexpr double kFocalPx = 25.0;
constexpr double kMaxAngleRad = 1.5;
constexpr double kExposureS = 0.1;
constexpr double kHeightM = 4.0;

/// A camera with an equidistant lens.
struct Stage {
  explicit Stage(std::shared_ptr<const Scene> scene)
      : rays(std::move(scene)),
        lens(
            Equidistant{}, Vec2d::Constant(kFocalPx), Vec2d::Constant(0.5 * kSizePx), kMaxAngleRad),
        raster(lens, kSizePx, kSizePx, 2) {}

  Image<float> Render(const std::function<RigidTransform(double)>& world_from_camera_at,
                      double exposure_s = kExposureS,
                      int num_threads = 2) const {
    return RenderBlurVectors(rays, raster, world_from_camera_at, exposure_s, num_threads);
  }

  Image<float> Render(const Trajectory& trajectory) const {
    return Render([&](double time_s) { return trajectory.WorldFromRig(time_s); });
  }

  RayScene rays;
  Lens lens;
  LensRaster raster;
};

/// A ceiling above a camera that looks up, as far as the eye reaches: it is seen up to 89 degrees.
std::shared_ptr<const Scene> Ceiling(const RigidTransform& world_from_local = {}) {
  constexpr double kHalfM = 1000.0;
  const auto corner = [&](double x, double y) {
    return Vec3f(world_from_local.Point(Vec3d(x, y, kHeightM)).cast<float>());
  };
  return SceneOfMesh(Quad(corner(-kHalfM, -kHalfM),
                          corner(-kHalfM, kHalfM),
                          corner(kHalfM, kHalfM),
                          corner(kHalfM, -kHalfM)));
}

/// A speck of a scene, too far behind the camera to be seen: all is sky.
std::shared_ptr<const Scene> Sky() {
  return SceneOfMesh(Quad({0, 0, -9}, {0, 1e-3F, -9}, {1e-3F, 1e-3F, -9}, {1e-3F, 0, -9}));
}

Vec2d At(const Image<float>& vectors, int x, int y) {
  return {vectors.At(x, y, 0), vectors.At(x, y, 1)};
}

/// Of the pixel's centre from the principal point.
Vec2d OffsetPx(int x, int y) { return {x - kMiddle, y - kMiddle}; }

/// Calls body(x, y) for every sixth pixel whose centre is further than `margin_px` inside the image
/// circle, and returns their number.
template <typename Body>
int ForPixelsInside(double margin_px, const Body& body) {
  int num = 0;
  for (int y = 0; y < kSizePx; y += 3) {
    for (int x = 0; x < kSizePx; x += 2) {
      if (OffsetPx(x, y).norm() < kFocalPx * kMaxAngleRad - margin_px) {
        body(x, y);
        ++num;
      }
    }
  }
  return num;
}

/// How an equidistant image of the ceiling moves when the camera goes by `way_m`: derivatives of
/// f atan(rho / h) along the radius and of the azimuth across it.
Vec2d CeilingVectorPx(const Vec2d& offset_px, const Vec3d& way_m) {
  const double theta_rad = offset_px.norm() / kFocalPx;
  const Vec2d moved_m = -way_m.head<2>();
  if (theta_rad == 0.0) {
    return kFocalPx / kHeightM * moved_m;
  }
  const Vec2d along = offset_px.normalized();
  const Vec2d across(-along.y(), along.x());
  const double cosine = std::cos(theta_rad);
  const double radial_px =
      kFocalPx / kHeightM *
      (cosine * cosine * along.dot(moved_m) + std::sin(theta_rad) * cosine * way_m.z());
  const double tangential_px =
      kFocalPx * theta_rad / (kHeightM * std::tan(theta_rad)) * across.dot(moved_m);
  return radial_px * along + tangential_px * across;
}

TEST(BlurVectors, OfATurnAboutTheOpticalAxisAreTangents) {
  // 0.2 rad: the image turns the other way.
  const Image<float> vectors = Stage(Sky()).Render(Driving(0.0, 2.0));
  const int num = ForPixelsInside(0.0, [&](int x, int y) {
    const Vec2d offset_px = OffsetPx(x, y);
    const Vec2d expected_px = 0.2 * Vec2d(offset_px.y(), -offset_px.x());
    EXPECT_LT((At(vectors, x, y) - expected_px).norm(), 1e-3) << x << "," << y;
  });
  EXPECT_GT(num, 600);
}

TEST(BlurVectors, UnderACeilingAreThoseOfTheLens) {
  // 1.2 m sideways and 0.3 m up while the shutter is open.
  const Vec3d way_m(1.2, -0.5, 0.3);
  const auto moving = [&](double time_s) {
    return RigidTransform{Eigen::Quaterniond::Identity(), time_s / kExposureS * way_m};
  };
  const Image<float> vectors = Stage(Ceiling()).Render(moving);
  const int num = ForPixelsInside(1.0, [&](int x, int y) {
    EXPECT_LT((At(vectors, x, y) - CeilingVectorPx(OffsetPx(x, y), way_m)).norm(), 2e-3)
        << x << "," << y << ": " << At(vectors, x, y).transpose() << ", expected "
        << CeilingVectorPx(OffsetPx(x, y), way_m).transpose();
  });
  EXPECT_GT(num, 600);
}

TEST(BlurVectors, DoNotDependOnWhereInTheWorldTheCameraIs) {
  const RigidTransform world_from_local{
      Eigen::Quaterniond(Eigen::AngleAxisd(2.5, Vec3d(0.3, -0.6, 0.5).normalized())),
      Vec3d(10.0, -7.0, 3.0)};
  const Vec3d way_m(0.4, 1.1, -0.2);
  const auto moving = [&](double time_s) {
    return world_from_local *
           RigidTransform{Eigen::Quaterniond::Identity(), time_s / kExposureS * way_m};
  };
  const Image<float> vectors = Stage(Ceiling(world_from_local)).Render(moving);
  ForPixelsInside(6.0, [&](int x, int y) {
    EXPECT_LT((At(vectors, x, y) - CeilingVectorPx(OffsetPx(x, y), way_m)).norm(), 5e-3)
        << x << "," << y;
  });
}

TEST(BlurVectors, AreTheVelocityInTheMiddleOfTheExposure) {
  // The way of the whole exposure would be 1.0 m + 1.0 m.
  const auto speeding = [](double time_s) {
    const double share = time_s / kExposureS;
    return RigidTransform{Eigen::Quaterniond::Identity(),
                          Vec3d(share + 4.0 * share * share * share, 0.0, 0.0)};
  };
  const Image<float> vectors = Stage(Ceiling()).Render(speeding);
  EXPECT_NEAR(vectors.At(kMiddle, kMiddle, 0), -kFocalPx / kHeightM, 1e-3);
  EXPECT_NEAR(vectors.At(kMiddle, kMiddle, 1), 0.0, 1e-6);
}

TEST(BlurVectors, OfTheSkyAreNoneWhileTheCameraOnlyMoves) {
  const Image<float> vectors = Stage(Sky()).Render(Driving(30.0, 0.0));
  for (const float value : vectors.Values()) {
    ASSERT_NEAR(value, 0.0F, 1e-6F);
  }
}

TEST(BlurVectors, AreNothingWithoutAnExposure) {
  const Driving driving(10.0, 1.0);
  const auto at = [&](double time_s) { return driving.WorldFromRig(time_s); };
  EXPECT_EQ(Stage(Ceiling()).Render(at, 0.0), Image<float>(kSizePx, kSizePx, 2));
}

TEST(BlurVectors, AreNothingOutsideTheImageCircle) {
  const Image<float> vectors = Stage(Ceiling()).Render(Driving(10.0, 2.0));
  int num_outside = 0;
  for (int y = 0; y < kSizePx; ++y) {
    for (int x = 0; x < kSizePx; ++x) {
      if (OffsetPx(x, y).norm() > kFocalPx * kMaxAngleRad) {
        ++num_outside;
        ASSERT_EQ(At(vectors, x, y), Vec2d(0.0, 0.0)) << x << "," << y;
      } else {
        ASSERT_NE(At(vectors, x, y), Vec2d(0.0, 0.0)) << x << "," << y;
      }
    }
  }
  EXPECT_GT(num_outside, 1500);
}

TEST(BlurVectors, DoNotDependOnThreads) {
  const Stage stage(Ceiling());
  const Driving driving(10.0, 2.0);
  const auto at = [&](double time_s) { return driving.WorldFromRig(time_s); };
  EXPECT_EQ(stage.Render(at, kExposureS, 1), stage.Render(at, kExposureS, 3));
}

TEST(ImageMotion, IsTheWayFromTheFirstPoseToTheLast) {
  const Stage stage(Ceiling());
  const auto at = [](double x_m) {
    return RigidTransform{Eigen::Quaterniond::Identity(), Vec3d(x_m, 0.0, 0.0)};
  };
  const auto height_px = [](double place_m) { return kFocalPx * std::atan(place_m / kHeightM); };
  // What is above the camera in the middle is 1 m before it at first and 3 m behind it at last.
  const ImageMotion motion(stage.rays, stage.raster, at(0.0), at(-1.0), at(3.0));
  EXPECT_NEAR(motion.AtPx(kMiddle, kMiddle).x(), height_px(-3.0) - height_px(1.0), 1e-9);
  EXPECT_NEAR(motion.AtPx(kMiddle, kMiddle).y(), 0.0, 1e-9);
}

TEST(ImageMotion, OfAnEndBeyondTheRimIsTwiceThatOfTheOther) {
  const Stage stage(Sky());
  constexpr double kTurnRad = 0.1;
  const auto turned = [](double angle_rad) {
    return RigidTransform{Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Vec3d::UnitY())),
                          Vec3d::Zero()};
  };
  // Along the row through the middle, an equidistant image shifts as it is. A turn about y, from z
  // towards x, shifts it to the left; at the right rim the first end, at the left one the last end
  // is beyond.
  const ImageMotion motion(
      stage.rays, stage.raster, turned(0.0), turned(-kTurnRad), turned(kTurnRad));
  for (const int x : {kMiddle - 37, kMiddle - 36, kMiddle - 20, kMiddle + 20, kMiddle + 37}) {
    const Vec2d moved_px = motion.AtPx(x, kMiddle);
    EXPECT_NEAR(moved_px.x(), -2.0 * kTurnRad * kFocalPx, 1e-6) << x;
    EXPECT_NEAR(moved_px.y(), 0.0, 1e-6) << x;
  }
  const Vec2d at_the_rim(kSizePx / 2.0 + 37.0, kSizePx / 2.0);
  const Vec3d direction = *stage.lens.Unproject(at_the_rim);
  EXPECT_FALSE(stage.lens.Project(turned(-kTurnRad).Inverse().Direction(direction)).has_value());
}

}  // namespace
}  // namespace pfseq
