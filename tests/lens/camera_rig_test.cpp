// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/camera_rig.h"

#include "renderer/core/units.h"
#include "renderer/lens/lens.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Ry * Rz * Rx multiplied out by hand.
Eigen::Matrix3d MultipliedOut(double x_rad, double y_rad, double z_rad) {
  const double cx = std::cos(x_rad);
  const double sx = std::sin(x_rad);
  const double cy = std::cos(y_rad);
  const double sy = std::sin(y_rad);
  const double cz = std::cos(z_rad);
  const double sz = std::sin(z_rad);
  Eigen::Matrix3d m;
  m << cy * cz, -cy * sz * cx + sy * sx, cy * sz * sx + sy * cx,  //
      sz, cz * cx, -cz * sx,                                      //
      -sy * cz, sy * sz * cx + cy * sx, -sy * sz * sx + cy * cx;
  return m;
}

TEST(RotationFromXzy, AppliesXThenZThenY) {
  const double x_rad = RadFromDeg(-8.0);
  const double y_rad = RadFromDeg(6.0);
  const double z_rad = RadFromDeg(-7.0);
  const Eigen::Matrix3d rotation = RotationFromXzy({x_rad, y_rad, z_rad}).toRotationMatrix();
  EXPECT_LT((rotation - MultipliedOut(x_rad, y_rad, z_rad)).norm(), 1e-15);
  // Where PFSeq's rear camera looks, in numbers: the third column.
  const Vec3d axis = rotation * Vec3d::UnitZ();
  EXPECT_NEAR(axis.x(), 0.12037922, 1e-8);
  EXPECT_NEAR(axis.y(), 0.13813573, 1e-8);
  EXPECT_NEAR(axis.z(), 0.98307038, 1e-8);
}

TEST(RotationFromXzy, IsRightHandedAboutEachAxis) {
  const double quarter_rad = RadFromDeg(90.0);
  EXPECT_LT((RotationFromXzy({quarter_rad, 0.0, 0.0}) * Vec3d::UnitY() - Vec3d::UnitZ()).norm(),
            1e-15);
  EXPECT_LT((RotationFromXzy({0.0, quarter_rad, 0.0}) * Vec3d::UnitZ() - Vec3d::UnitX()).norm(),
            1e-15);
  EXPECT_LT((RotationFromXzy({0.0, 0.0, quarter_rad}) * Vec3d::UnitX() - Vec3d::UnitY()).norm(),
            1e-15);
}

TEST(RotationFromXzy, WithZerosTheCameraLooksUpWithForwardToTheRightAndLeftDown) {
  const Lens lens(Equidistant{}, Vec2d::Constant(378.19), Vec2d(600.0, 600.0), RadFromDeg(90.9));
  const RigCamera camera{"front", {RotationFromXzy({0.0, 0.0, 0.0}), Vec3d::Zero()}};
  const auto seen_at = [&](const Vec3d& direction_rig) {
    return *lens.Project(camera.rig_from_camera.Inverse().Direction(direction_rig));
  };
  const Vec3d zenith = Vec3d::UnitZ();
  EXPECT_EQ(seen_at(zenith), Vec2d(600.0, 600.0));
  EXPECT_GT(seen_at(zenith + Vec3d::UnitX()).x(), 600.0);
  EXPECT_EQ(seen_at(zenith + Vec3d::UnitX()).y(), 600.0);
  EXPECT_GT(seen_at(zenith + Vec3d::UnitY()).y(), 600.0);
  EXPECT_EQ(seen_at(zenith + Vec3d::UnitY()).x(), 600.0);
}

}  // namespace
}  // namespace pfseq
