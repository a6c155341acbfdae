// SPDX-License-Identifier: Apache-2.0
// Blurred pictures of a small lamp, measured against the closed form of its way over the image.
#include "tests/renderer/two_boxes.h"
#include "tests/support/driving.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kSizePx = 160;
constexpr double kFocalPx = 50.0;
constexpr double kExposureS = 0.1;
constexpr double kHeightM = 4.0;

/// A lamp of 50 cm above the camera and nothing else.
Scene Lamp(const Vec2f& place_m) {
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb::Zero())};
  scene.materials[0].emission = Rgb::Constant(1000.0F);
  constexpr float kHalfM = 0.25F;
  const auto z = static_cast<float>(kHeightM);
  // Seen from below.
  Mesh lamp;
  lamp.positions_m = {{place_m.x() - kHalfM, place_m.y() - kHalfM, z},
                      {place_m.x() - kHalfM, place_m.y() + kHalfM, z},
                      {place_m.x() + kHalfM, place_m.y() + kHalfM, z},
                      {place_m.x() + kHalfM, place_m.y() - kHalfM, z}};
  lamp.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes = {lamp};
  return scene;
}

/// A camera at the origin that looks up, with the image's x along the world's and y along it too.
struct Stage {
  Stage(const Vec2f& lamp_m, const Trajectory& trajectory, const ShutterSpec& shutter)
      : two_boxes(Lamp(lamp_m), ConstantSkyLight(Rgb::Zero())),
        lens(Equidistant{},
             Vec2d::Constant(kFocalPx),
             Vec2d::Constant(0.5 * kSizePx),
             RadFromDeg(85.0)),
        raster(lens, kSizePx, kSizePx, 2),
        exposure(Shutter(shutter), trajectory, RigidTransform{}, 0.0) {
    view.lens = &lens;
    view.width_px = kSizePx;
    view.height_px = kSizePx;
    view.exposure = &exposure;
  }

  Image<float> Render(int num_threads = 2) const {
    const auto light = two_boxes.MakeCachedLight();
    const PixelSampling sampling{.num_samples = 128, .max_samples = 128};
    return RenderCachedRadiance(light->Tracer(), raster, view, sampling, num_threads, nullptr, {});
  }

  TwoBoxesStage two_boxes;
  Lens lens;
  LensRaster raster;
  ExposurePoses exposure;
  View view;
};

/// Light, mean place and standard deviations of the picture.
struct Trail {
  double light = 0.0;
  Vec2d mean_px = Vec2d::Zero();
  /// Along and across the direction of the greatest spread.
  Vec2d sigma_px = Vec2d::Zero();
  Vec2d along = Vec2d::Zero();
};
Trail Measure(const Image<float>& image) {
  Trail trail;
  for (int y = 0; y < kSizePx; ++y) {
    for (int x = 0; x < kSizePx; ++x) {
      trail.light += image.At(x, y, 1);
      trail.mean_px += image.At(x, y, 1) * Vec2d(x + 0.5, y + 0.5);
    }
  }
  trail.mean_px /= trail.light;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (int y = 0; y < kSizePx; ++y) {
    for (int x = 0; x < kSizePx; ++x) {
      const Vec2d d = Vec2d(x + 0.5, y + 0.5) - trail.mean_px;
      covariance += image.At(x, y, 1) / trail.light * d * d.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  trail.sigma_px = {std::sqrt(solver.eigenvalues()[1]), std::sqrt(solver.eigenvalues()[0])};
  trail.along = solver.eigenvectors().col(1);
  return trail;
}

/// A box of this length has this standard deviation; the lamp and the pixel, as the sharp picture
/// shows them, are taken off.
double BoxLengthPx(double sigma_px, double sharp_sigma_px) {
  return std::sqrt(12.0 * (sigma_px * sigma_px - sharp_sigma_px * sharp_sigma_px));
}

/// Where the lamp's middle is seen from a place on the way.
double HeightPx(double offset_m) { return kFocalPx * std::atan2(offset_m, kHeightM); }

/// The box of the same standard deviation as a drive past the lamp at an even rate: places weighted
/// by the area of the lamp's picture, which is (f / d)^2 cos(t)^3 t / sin(t) of its own at an angle
/// t.
double DriveLengthPx(double first_m, double last_m) {
  double sum = 0.0;
  double mean_px = 0.0;
  double squares_px2 = 0.0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const double height_px = HeightPx(first_m + (i + 0.5) / kSteps * (last_m - first_m));
    const double theta_rad = std::abs(height_px) / kFocalPx;
    const double area = std::pow(std::cos(theta_rad), 3) * theta_rad / std::sin(theta_rad);
    sum += area;
    mean_px += area * height_px;
    squares_px2 += area * height_px * height_px;
  }
  mean_px /= sum;
  return std::sqrt(12.0 * (squares_px2 / sum - mean_px * mean_px));
}

TEST(MotionBlur, OfADriveHasTheLengthOfTheWay) {
  // 12 m/s: 1.2 m while the shutter is open.
  const Driving drive(12.0, 0.0);
  const Stage sharp({0.3F, 0.0F}, drive, {});
  const Stage blurred({0.3F, 0.0F}, drive, {.exposure_s = kExposureS});
  const Trail point = Measure(sharp.Render());
  const Trail trail = Measure(blurred.Render());
  const double expected_px = DriveLengthPx(-0.3, 0.9);
  EXPECT_NEAR(expected_px, HeightPx(0.9) - HeightPx(-0.3), 0.5);
  EXPECT_NEAR(BoxLengthPx(trail.sigma_px.x(), point.sigma_px.x()) / expected_px, 1.0, 0.02);
  EXPECT_NEAR(std::abs(trail.along.x()), 1.0, 1e-3);
  EXPECT_NEAR(trail.sigma_px.y(), point.sigma_px.y(), 0.05);
  EXPECT_NEAR(trail.light / point.light, 1.0, 0.02);
}

TEST(MotionBlur, OfATurnHasTheLengthOfTheArc) {
  // 0.2 rad about the optical axis, the lamp 50 px from it.
  const double offset_m = kHeightM * std::tan(1.0);
  const Driving turn(0.0, 2.0);
  const Vec2f lamp_m(static_cast<float>(offset_m), 0.0F);
  const Trail point = Measure(Stage(lamp_m, turn, {}).Render());
  const Trail trail = Measure(Stage(lamp_m, turn, {.exposure_s = kExposureS}).Render());
  EXPECT_NEAR(point.mean_px.x(), 0.5 * kSizePx + kFocalPx, 0.1);
  // The chord of a uniform arc has the variance of sin(a), a uniform in [-0.1, 0.1].
  const double variance_px2 = kFocalPx * kFocalPx * (0.5 - std::sin(0.2) / 0.4);
  // The lamp is seen from the side: it is longer across the radius.
  EXPECT_NEAR(std::abs(point.along.y()), 1.0, 1e-2);
  EXPECT_NEAR(BoxLengthPx(trail.sigma_px.x(), point.sigma_px.x()),
              std::sqrt(12.0 * variance_px2),
              0.02 * std::sqrt(12.0 * variance_px2));
  EXPECT_NEAR(std::abs(trail.along.y()), 1.0, 1e-3);
}

TEST(MotionBlur, OffsetAndRollingShutterMoveThePicture) {
  const Driving drive(10.0, 0.0);
  // The lamp is 0.5 m behind the camera's place 50 ms later.
  const Trail late = Measure(Stage({0.0F, 0.0F}, drive, {.offset_s = 0.05}).Render());
  EXPECT_NEAR(late.mean_px.x(), 0.5 * kSizePx + HeightPx(-0.5), 0.1);
  // To the right: 20 px right of the middle a column is read 1/8 of the time later.
  const Trail rolled =
      Measure(Stage({1.8F, 0.0F}, drive, {.readout_s = 0.4, .readout = "right"}).Render());
  double x_px = 20.0;
  for (int i = 0; i < 50; ++i) {
    x_px = HeightPx(1.8 - 10.0 * 0.4 * x_px / kSizePx);
  }
  EXPECT_NEAR(rolled.mean_px.x(), 0.5 * kSizePx + x_px, 0.15);
}

TEST(MotionBlur, DoesNotDependOnThreads) {
  const Driving drive(12.0, 1.0);
  const Stage stage({0.3F, 0.5F}, drive, {.exposure_s = kExposureS, .ramp = 0.3});
  EXPECT_EQ(stage.Render(1), stage.Render(3));
}

TEST(MotionBlur, OfTheReferenceTracerIsTheSame) {
  const Driving drive(12.0, 1.0);
  const Stage stage({0.3F, 0.5F}, drive, {.exposure_s = kExposureS});
  const PathTracer tracer(
      stage.two_boxes.Rays(), stage.two_boxes.Textures(), stage.two_boxes.Light(), {});
  const Trail reference = Measure(RenderRadiance(tracer, stage.view, 128, 2, nullptr, {}));
  const Trail trail = Measure(stage.Render());
  EXPECT_NEAR(trail.sigma_px.x() / reference.sigma_px.x(), 1.0, 0.02);
  EXPECT_LT((trail.mean_px - reference.mean_px).norm(), 0.1);
  EXPECT_NEAR(trail.light / reference.light, 1.0, 0.02);
}

}  // namespace
}  // namespace pfseq
