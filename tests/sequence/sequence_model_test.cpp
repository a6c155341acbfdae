// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sequence_model.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "renderer/sequence/sequence_schema.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

SequenceSpec Shipped(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return ReadSequenceSpec(std::filesystem::path(PFSEQ_SOURCE_DIR) / "data" / "sequences" / name,
                          overrides);
}

TEST(MakeLenses, OfTheShippedSequenceAreThoseOfPfseq) {
  const std::vector<Named<Lens>> lenses = MakeLenses(Shipped("pfseq.yaml"));
  ASSERT_EQ(lenses.size(), 2U);
  EXPECT_EQ(lenses[0].name, "equidistant");
  EXPECT_EQ(lenses[0].value.ModelName(), "equidistant");
  EXPECT_NEAR(lenses[0].value.FocalPx().x(), 378.19, 0.005);
  EXPECT_EQ(lenses[0].value.PrincipalPointPx(), Vec2d(600.0, 600.0));
  EXPECT_NEAR(DegFromRad(lenses[0].value.MaxAngleRad()), 90.9, 1e-12);
  EXPECT_EQ(lenses[1].name, "equisolid");
  EXPECT_EQ(lenses[1].value.ModelName(), "equisolid");
  EXPECT_NEAR(lenses[1].value.FocalPx().x(), 394.31, 0.005);
  EXPECT_EQ(lenses[1].value.FocalPx().x(), lenses[1].value.FocalPx().y());
}

TEST(MakeLenses, ScaleWithTheImage) {
  const std::vector<Named<Lens>> large = MakeLenses(Shipped("pfseq.yaml"));
  const std::vector<Named<Lens>> small = MakeLenses(Shipped("pfseq.yaml", {"image.size_px=300"}));
  for (size_t i = 0; i < large.size(); ++i) {
    EXPECT_NEAR(small[i].value.FocalPx().x(), 0.25 * large[i].value.FocalPx().x(), 1e-12);
    EXPECT_NEAR(small[i].value.CirclePx(), 0.25 * large[i].value.CirclePx(), 1e-12);
    EXPECT_EQ(small[i].value.PrincipalPointPx(), Vec2d(150.0, 150.0));
  }
}

TEST(MakeLens, TakesFocalLengthsAndPrincipalPointAndScalesThem) {
  LensSpec spec;
  spec.model = "kannala_brandt";
  spec.fov_deg = 180.0;
  spec.focal_px = {300.0, 310.0};
  spec.principal_point_px = {320.5, 241.0};
  spec.coefficients = {0.01, 0.0, 0.0, 0.0};
  const Lens as_it_is = MakeLens(spec, {1000, 700});
  EXPECT_EQ(as_it_is.FocalPx(), Vec2d(300.0, 310.0));
  EXPECT_EQ(as_it_is.PrincipalPointPx(), Vec2d(320.5, 241.0));
  EXPECT_EQ(std::get<KannalaBrandt>(as_it_is.Model()).Coefficients()[0], 0.01);
  spec.image_width_px = 640;
  const Lens doubled = MakeLens(spec, {1280, 960});
  EXPECT_EQ(doubled.FocalPx(), Vec2d(600.0, 620.0));
  EXPECT_EQ(doubled.PrincipalPointPx(), Vec2d(641.0, 482.0));
}

TEST(MakeLens, PutsThePrincipalPointInTheMiddleOfTheImage) {
  LensSpec spec;
  spec.circle_px = 100.0;
  EXPECT_EQ(MakeLens(spec, {641, 480}).PrincipalPointPx(), Vec2d(320.5, 240.0));
}

TEST(MakeLensModel, KnowsEveryName) {
  for (const std::string& name : LensModelNames()) {
    LensSpec spec;
    spec.model = name;
    spec.fov_deg = 120.0;
    spec.circle_px = 100.0;
    EXPECT_EQ(MakeLens(spec, {100, 100}).ModelName(), name);
  }
  LensSpec spec;
  spec.model = "fisheye";
  EXPECT_THROW(MakeLensModel(spec), InputError);
}

TEST(ImageSizePxOfLens, IsTheLensesOwnWidthOrHoldsItsCircle) {
  LensSpec spec;
  spec.circle_px = 99.5;
  EXPECT_EQ(ImageSizePxOfLens(spec), (std::array{100, 100}));
  spec.image_width_px = 640;
  EXPECT_EQ(ImageSizePxOfLens(spec), (std::array{640, 640}));
  LensSpec focal;
  focal.fov_deg = 180.0;
  focal.focal_px = {100.0, 100.0};
  // The circle's diameter is 100 pi.
  EXPECT_EQ(ImageSizePxOfLens(focal), (std::array{315, 315}));
}

TEST(MakeCameras, PutTheRearCameraTwoMetresBehindAndTilted) {
  const std::vector<RigCamera> cameras = MakeCameras(Shipped("pfseq.yaml"));
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].name, "front");
  EXPECT_EQ(cameras[0].rig_from_camera.translation_m, Vec3d::Zero());
  EXPECT_EQ(cameras[0].rig_from_camera.Direction(Vec3d::UnitZ()), Vec3d::UnitZ());
  EXPECT_EQ(cameras[1].name, "rear");
  EXPECT_EQ(cameras[1].rig_from_camera.translation_m, Vec3d(-2.0, 0.0, 0.0));
  const Vec3d axis = cameras[1].rig_from_camera.Direction(Vec3d::UnitZ());
  EXPECT_LT((axis - Vec3d(0.1203792201087654, 0.1381357257699021, 0.9830703762356121)).norm(),
            1e-14);
}

TEST(FramePoses, OfTheShippedSequenceStandTurnAndGoStraightWhereTheyShould) {
  const SequenceSpec spec = Shipped("pfseq.yaml");
  const std::vector<StampedPose> poses = FramePoses(spec.trajectory);
  const std::unique_ptr<Trajectory> trajectory = MakeTrajectory(spec.trajectory);
  ASSERT_EQ(poses.size(), 64U);
  const auto yaw_deg = [&](int frame, double later_s) {
    return DegFromRad(YawRad(trajectory->WorldFromRig(poses[frame].time_s + later_s)));
  };
  const auto speed_mps = [&](int frame) {
    const double t_s = poses[frame].time_s;
    return (trajectory->WorldFromRig(t_s + 0.05).translation_m -
            trajectory->WorldFromRig(t_s - 0.05).translation_m)
               .norm() /
           0.1;
  };
  // Frame 0 stands at the start, also while a shutter is open.
  EXPECT_EQ(poses[0].time_s, 0.0);
  EXPECT_EQ(poses[0].world_from_rig.translation_m, Vec3d(0.0, 0.0, 1.6));
  EXPECT_EQ(speed_mps(0), 0.0);
  // Frame 24 is in the middle of the first corner and turns to the left at 4.5 m/s on a radius of
  // 4.5 m.
  EXPECT_NEAR(yaw_deg(24, 0.0), 45.0, 5.0);
  EXPECT_NEAR((yaw_deg(24, 0.1) - yaw_deg(24, -0.1)) / 0.2, DegFromRad(1.0), 1e-6);
  // Frame 40 drives straight across, five metres and more from either corner.
  for (const double later_s : {-0.6, 0.0, 0.6}) {
    EXPECT_NEAR(yaw_deg(40, later_s), 90.0, 1e-9);
  }
  EXPECT_NEAR(speed_mps(40), 5.5, 1e-9);
  EXPECT_NEAR(poses[40].world_from_rig.translation_m.x(), 42.5, 1e-9);
  // Frame 63 drives back, well into the last street.
  EXPECT_NEAR(std::abs(yaw_deg(63, -3.0)), 180.0, 1e-9);
  EXPECT_NEAR(speed_mps(63), 5.5, 1e-9);
  EXPECT_NEAR(poses[63].world_from_rig.translation_m.y(), 55.0, 1e-9);
}

TEST(FramePoses, OfADriveComeAtTheFrameRate) {
  const SequenceSpec spec =
      Shipped("pfseq.yaml", {"trajectory.frame_rate_hz=8", "trajectory.height_m=2.5"});
  const std::vector<StampedPose> poses = FramePoses(spec.trajectory);
  const std::unique_ptr<Trajectory> trajectory = MakeTrajectory(spec.trajectory);
  for (size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].time_s, static_cast<double>(i) / 8.0);
    EXPECT_EQ(poses[i].world_from_rig.translation_m,
              trajectory->WorldFromRig(poses[i].time_s).translation_m);
    EXPECT_EQ(poses[i].world_from_rig.translation_m.z(), 2.5);
  }
}

TEST(FramePoses, OfARightTurnGoToTheRight) {
  const SequenceSpec spec = Shipped("pfseq.yaml", {"trajectory.drive.turn=right"});
  EXPECT_LT(FramePoses(spec.trajectory)[40].world_from_rig.translation_m.y(), -8.0);
}

TEST(FramePoses, OfAFileAreItsOwn) {
  const TempFolder folder;
  WriteFileAtomically(folder / "a.txt",
                      std::string_view("0.5 1 2 3 0 0 0 1\n2 4 5 6 0 0 1 0\n7 7 8 9 0 0 0 1\n"));
  TrajectorySpec spec;
  spec.tum = folder / "a.txt";
  spec.num_frames = 0;
  EXPECT_EQ(FramePoses(spec).size(), 3U);
  spec.num_frames = 2;
  const std::vector<StampedPose> poses = FramePoses(spec);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].time_s, 0.5);
  EXPECT_EQ(poses[1].time_s, 2.0);
  EXPECT_EQ(poses[1].world_from_rig.translation_m, Vec3d(4.0, 5.0, 6.0));
  // The path goes on to the pose that has no frame.
  EXPECT_EQ(MakeTrajectory(spec)->WorldFromRig(7.0).translation_m, Vec3d(7.0, 8.0, 9.0));
  spec.num_frames = 4;
  EXPECT_EQ(MessageOf<InputError>([&] { FramePoses(spec); }),
            spec.tum + ": expected at least num_frames (4) poses, got 3");
}

TEST(FramePoses, OfACsvFileUseFrameRateAndHeight) {
  const TempFolder folder;
  WriteFileAtomically(folder / "a.csv",
                      std::string_view("frame,x_m,y_m,yaw_deg\n0,1,2,90\n3,4,5,180\n"));
  TrajectorySpec spec;
  spec.csv = folder / "a.csv";
  spec.num_frames = 0;
  spec.frame_rate_hz = 6.0;
  spec.height_m = 2.0;
  const std::vector<StampedPose> poses = FramePoses(spec);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[1].time_s, 0.5);
  EXPECT_EQ(poses[1].world_from_rig.translation_m, Vec3d(4.0, 5.0, 2.0));
  EXPECT_NEAR(YawRad(MakeTrajectory(spec)->WorldFromRig(0.25)), RadFromDeg(135.0), 1e-12);
}

}  // namespace
}  // namespace pfseq
