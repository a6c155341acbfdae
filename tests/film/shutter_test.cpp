// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/shutter.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

const Vec2d kMiddle(0.5, 0.5);

/// Share of the samples of a fine grid at times below `time_s`.
double ShareBefore(const Shutter& shutter, double time_s) {
  constexpr int kSteps = 400;
  int count = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const Vec2d sample((i % kSteps + 0.5) / kSteps, (i / kSteps + 0.5) / kSteps);
    count += shutter.TimeS(sample, kMiddle) < time_s ? 1 : 0;
  }
  return static_cast<double>(count) / (kSteps * kSteps);
}

TEST(Shutter, BoxIsUniformOverTheExposure) {
  const Shutter shutter({.exposure_s = 0.04, .offset_s = 0.01});
  EXPECT_NEAR(ShareBefore(shutter, -0.01), 0.0, 1e-9);
  EXPECT_NEAR(ShareBefore(shutter, 0.0), 0.25, 0.003);
  EXPECT_NEAR(ShareBefore(shutter, 0.01), 0.5, 0.003);
  EXPECT_NEAR(ShareBefore(shutter, 0.0300001), 1.0, 1e-9);
}

TEST(Shutter, TrapezoidHasItsFullWidthAtHalfHeight) {
  // Opens from -0.03 to -0.01, closes from 0.01 to 0.03: area 0.04 of height 1.
  const Shutter shutter({.exposure_s = 0.04, .ramp = 0.5});
  EXPECT_EQ(shutter.SpanS(), Vec2d(-0.03, 0.03));
  // The triangle up to half height holds a quarter of the 0.02 x 1 / 2 of the whole ramp.
  EXPECT_NEAR(ShareBefore(shutter, -0.02), 0.0025 / 0.04, 0.003);
  EXPECT_NEAR(ShareBefore(shutter, -0.01), 0.01 / 0.04, 0.003);
  EXPECT_NEAR(ShareBefore(shutter, 0.0), 0.5, 0.003);
}

TEST(Shutter, RollsInItsDirectionWithTheMiddleLineAtTheFramesTime) {
  const auto middle = [](const char* readout, const Vec2d& place) {
    return Shutter({.readout_s = 0.02, .readout = readout}).MiddleS(place);
  };
  const Vec2d upper_right(1.0, 0.25);
  EXPECT_DOUBLE_EQ(middle("down", upper_right), -0.005);
  EXPECT_DOUBLE_EQ(middle("up", upper_right), 0.005);
  EXPECT_DOUBLE_EQ(middle("right", upper_right), 0.01);
  EXPECT_DOUBLE_EQ(middle("left", upper_right), -0.01);
  EXPECT_DOUBLE_EQ(middle("down", kMiddle), 0.0);
}

/// Turns about Z while it drives along X.
class Spiral : public Trajectory {
 public:
  RigidTransform WorldFromRig(double time_s) const override {
    return PoseFromYaw(Vec3d(3.0 * time_s, 0.0, 1.0), 2.0 * time_s);
  }
};

class Standing : public Trajectory {
 public:
  RigidTransform WorldFromRig(double /*time_s*/) const override {
    return PoseFromYaw(Vec3d(1.0, 2.0, 3.0), 0.7);
  }
};

TEST(ExposurePoses, AreThoseOfTheTrajectory) {
  const RigidTransform rig_from_camera{
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vec3d(1.0, 2.0, 2.0) / 3.0)), Vec3d(-2.0, 0, 0)};
  const ExposurePoses poses(
      Shutter({.exposure_s = 0.08, .ramp = 0.25}), Spiral(), rig_from_camera, 5.0);
  EXPECT_FALSE(poses.IsStill());
  for (const double time_s : {-0.05, -0.0333, 0.0, 0.0123, 0.05}) {
    const RigidTransform exact = Spiral().WorldFromRig(5.0 + time_s) * rig_from_camera;
    const ExposurePoses::Pose pose = poses.At(time_s);
    EXPECT_LT((pose.origin_m.cast<double>() - exact.translation_m).norm(), 3e-6) << time_s;
    EXPECT_LT((pose.world_from_camera.cast<double>() - exact.rotation.toRotationMatrix()).norm(),
              1e-6)
        << time_s;
  }
}

/// Is moved aside and back between multiples of 0.02 s.
class Shake : public Trajectory {
 public:
  RigidTransform WorldFromRig(double time_s) const override {
    const double phase = time_s / 0.02 - std::round(time_s / 0.02);
    return PoseFromYaw(Vec3d(std::abs(phase) < 0.01 ? 0.0 : phase, 0.0, 1.0), 0.0);
  }
};

TEST(ExposurePoses, AShakeWithinTheExposureIsNoRest) {
  EXPECT_FALSE(ExposurePoses(Shutter({.exposure_s = 0.04}), Shake(), {}, 1.0).IsStill());
}

TEST(ExposurePoses, KnowACameraAtRest) {
  const Shutter shutter({.exposure_s = 0.1});
  EXPECT_TRUE(ExposurePoses(shutter, Standing(), {}, 1.0).IsStill());
  EXPECT_TRUE(ExposurePoses(Shutter({}), Spiral(), {}, 1.0).IsStill());
  // The exposure may be an instant and still not that of the frame's pose.
  EXPECT_FALSE(ExposurePoses(Shutter({.offset_s = 0.1}), Spiral(), {}, 1.0).IsStill());
}

}  // namespace
}  // namespace pfseq
