// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/rig_file.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

RigFile SampleRig() {
  const Eigen::Quaterniond rotation =
      RotationFromXzy({RadFromDeg(-8.0), RadFromDeg(6.0), RadFromDeg(-7.0)});
  RigFile rig{
      1200, 800, 500.0, {{"front", {}}, {"rear", {rotation, Vec3d(-2.0, 0.1, 1.0 / 3.0)}}}, {}};
  const Vec2d center_px(600.0, 400.25);
  rig.lenses.push_back({"a", Lens(Equisolid{}, Vec2d(394.3, 394.3), center_px, RadFromDeg(90.9))});
  rig.lenses.push_back(
      {"b", Lens(KannalaBrandt({0.01, -0.002, 1e-4, -1e-6}), Vec2d(300.1, 299.7), center_px, 1.4)});
  return rig;
}

TEST(RigFile, ReadsBackToTheSameBits) {
  const TempFolder folder;
  WriteFileAtomically(folder / "rig.yaml", SampleRig().ToYaml());
  const RigFile read = RigFile::Read(folder / "rig.yaml");
  EXPECT_EQ(read.width_px, 1200);
  EXPECT_EQ(read.height_px, 800);
  EXPECT_EQ(read.max_distance_m, 500.0);
  ASSERT_EQ(read.cameras.size(), 2U);
  EXPECT_EQ(read.cameras[0].name, "front");
  EXPECT_EQ(read.cameras[1].rig_from_camera.rotation.coeffs(),
            SampleRig().cameras[1].rig_from_camera.rotation.coeffs());
  EXPECT_EQ(read.cameras[1].rig_from_camera.translation_m,
            SampleRig().cameras[1].rig_from_camera.translation_m);
  ASSERT_EQ(read.lenses.size(), 2U);
  for (size_t i = 0; i < 2; ++i) {
    const Lens& expected = SampleRig().lenses[i].value;
    const Lens& lens = read.lenses[i].value;
    EXPECT_EQ(lens.ModelName(), expected.ModelName());
    EXPECT_EQ(lens.FocalPx(), expected.FocalPx());
    EXPECT_EQ(lens.PrincipalPointPx(), expected.PrincipalPointPx());
    EXPECT_EQ(lens.MaxAngleRad(), expected.MaxAngleRad());
    EXPECT_EQ(*lens.Project(Vec3d(0.3, -0.2, 0.4)), *expected.Project(Vec3d(0.3, -0.2, 0.4)));
  }
  EXPECT_EQ(read.ToYaml(), SampleRig().ToYaml());
}

TEST(RigFile, FaultsNameFileLineAndKey) {
  const TempFolder folder;
  const auto message = [&](const std::string& from, const std::string& to) {
    std::string text = SampleRig().ToYaml();
    const size_t position = text.find(from);
    EXPECT_NE(position, std::string::npos) << from;
    text.replace(position, from.size(), to);
    WriteFileAtomically(folder / "rig.yaml", text);
    return MessageOf<InputError>([&] { RigFile::Read(folder / "rig.yaml"); });
  };
  EXPECT_THAT(message("max_distance_m: 500", "max_distance_m: far"),
              HasSubstr("max_distance_m: expected a number"));
  EXPECT_THAT(message("max_distance_m", "max_depth_m"), HasSubstr("max_distance_m: missing"));
  EXPECT_THAT(message("[1200, 800]", "[1200]"), HasSubstr("image_size_px: expected 2 numbers"));
  EXPECT_THAT(message("[1200, 800]", "[1200, 0.5]"),
              HasSubstr("image_size_px: expected whole numbers"));
  EXPECT_THAT(message("model: equisolid", "model: equi"), HasSubstr("unknown lens model 'equi'"));
  EXPECT_THAT(message("rotation_xyzw: [", "rotation_xyzw: [1, 1, 1, 1]  # ["),
              HasSubstr("expected a unit quaternion"));
  EXPECT_THAT(message("lenses:", "lenses: ]"), HasSubstr("expected YAML"));
}

}  // namespace
}  // namespace pfseq
