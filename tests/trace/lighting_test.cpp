// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/lighting.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/sequence_schema.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/trace/directions.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

SunSpec SunAt(double elevation_deg, double azimuth_deg) {
  SunSpec spec;
  spec.elevation_deg = elevation_deg;
  spec.azimuth_deg = azimuth_deg;
  return spec;
}

TEST(MakeSun, AzimuthTurnsCounterClockwiseFromXAndElevationUp) {
  EXPECT_TRUE(MakeSun(SunAt(0.0, 0.0), 3.0).direction_to_sun.isApprox(Vec3f::UnitX(), 1e-6F));
  EXPECT_TRUE((MakeSun(SunAt(0.0, 90.0), 3.0).direction_to_sun - Vec3f::UnitY()).norm() < 1e-6F);
  EXPECT_TRUE((MakeSun(SunAt(90.0, 12.0), 3.0).direction_to_sun - Vec3f::UnitZ()).norm() < 1e-6F);
  const Vec3f expected(std::cos(RadFromDeg(40.0)) * std::cos(RadFromDeg(130.0)),
                       std::cos(RadFromDeg(40.0)) * std::sin(RadFromDeg(130.0)),
                       std::sin(RadFromDeg(40.0)));
  EXPECT_TRUE(MakeSun(SunSpec{}, 3.0).direction_to_sun.isApprox(expected, 1e-6F));
}

TEST(MakeSun, IrradianceIsNearThatOfThreeWavelengthsByHand) {
  // Turbidity 3, 50 degrees from the zenith: optical mass 1.5525; transmittance 0.644 at 610 nm,
  // 0.594 at 545 nm and 0.496 at 465 nm, each for one channel; a black body of 5778 K (x 0.3263,
  // y 0.3357) has red and blue 1.138 and 0.937 times its green.
  const Rgb irradiance = MakeSun(SunSpec{}, 3.0).irradiance;
  EXPECT_NEAR(Luminance(irradiance), 133.0F * 0.597F, 2.0F);
  EXPECT_NEAR(irradiance[0] / irradiance[1], 1.138F * 0.644F / 0.594F, 0.08F);
  EXPECT_NEAR(irradiance[2] / irradiance[1], 0.937F * 0.496F / 0.594F, 0.09F);
}

TEST(MakeSun, WeakensAndReddensTowardTheHorizonAndWithHaze) {
  const Rgb high = MakeSun(SunAt(60.0, 0.0), 3.0).irradiance;
  const Rgb low = MakeSun(SunAt(10.0, 0.0), 3.0).irradiance;
  const Rgb hazy = MakeSun(SunAt(60.0, 0.0), 6.0).irradiance;
  EXPECT_GT(Luminance(high), 1.5F * Luminance(low));
  EXPECT_GT(Luminance(high), 1.2F * Luminance(hazy));
  EXPECT_LT(low[2] / low[0], 0.7F * high[2] / high[0]);
  EXPECT_LT(hazy[2] / hazy[0], high[2] / high[0]);
}

TEST(MakeSun, GivesNoLightFromBelowTheHorizonOrWithoutStrength) {
  EXPECT_EQ(MakeSun(SunAt(-1.0, 0.0), 3.0).irradiance.maxCoeff(), 0.0F);
  SunSpec spec;
  spec.strength = 0.0;
  EXPECT_EQ(MakeSun(spec, 3.0).irradiance.maxCoeff(), 0.0F);
  spec.strength = 2.0;
  EXPECT_TRUE(
      MakeSun(spec, 3.0).irradiance.isApprox(2.0F * MakeSun(SunSpec{}, 3.0).irradiance, 1e-6F));
}

TEST(SunDisc, FacingIrradianceIsExactForAnyDiameter) {
  const Vec3d direction = Vec3d(0.3, -0.5, 0.8).normalized();
  const Rgb irradiance(80.0F, 70.0F, 50.0F);
  for (const double diameter_deg : {0.1, 0.53, 20.0, 90.0}) {
    const SunDisc sun(direction, irradiance, RadFromDeg(diameter_deg));
    constexpr int kNumSide = 256;
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (int i = 0; i < kNumSide; ++i) {
      for (int j = 0; j < kNumSide; ++j) {
        const Vec3d sample = sun.SampleDirection(Vec2d(i + 0.5, j + 0.5) / kNumSide);
        ASSERT_NEAR(sample.norm(), 1.0, 1e-12);
        ASSERT_TRUE(sun.Contains(sample));
        sum += sun.Radiance().cast<double>() * (sample.dot(direction) / sun.Pdf());
      }
    }
    EXPECT_TRUE((sum / (kNumSide * kNumSide)).cast<float>().isApprox(irradiance, 1e-4F))
        << diameter_deg;
  }
}

TEST(SunDisc, EndsAtItsAngularRadius) {
  const SunDisc sun(Vec3d::UnitX(), Rgb::Ones(), RadFromDeg(0.53));
  EXPECT_TRUE(sun.Contains({std::cos(RadFromDeg(0.264)), 0.0, std::sin(RadFromDeg(0.264))}));
  EXPECT_FALSE(sun.Contains({std::cos(RadFromDeg(0.266)), 0.0, std::sin(RadFromDeg(0.266))}));
  EXPECT_FALSE(sun.Contains(-Vec3d::UnitX()));
}

TEST(MakeLighting, TakesTheDescriptionsSunThenTheScenesThenTheDefault) {
  Sun scene_sun;
  scene_sun.direction_to_sun = Vec3f(0.0F, 0.6F, 0.8F);
  scene_sun.irradiance = Rgb(10.0F, 20.0F, 30.0F);
  LightSpec spec;
  spec.sun.reset();
  EXPECT_TRUE(
      MakeLighting(spec, scene_sun).sun->DirectionToSun().isApprox(Vec3d(0.0, 0.6, 0.8), 1e-6));
  const Vec3d default_direction = MakeSun(SunSpec{}, 3.0).direction_to_sun.cast<double>();
  EXPECT_TRUE(
      MakeLighting(spec, std::nullopt).sun->DirectionToSun().isApprox(default_direction, 1e-6));
  spec.sun = SunAt(90.0, 0.0);
  EXPECT_TRUE(MakeLighting(spec, scene_sun).sun->DirectionToSun().isApprox(Vec3d::UnitZ(), 1e-6));
}

TEST(MakeLighting, ClearSkyFollowsTheSunThatIsTaken) {
  Sun scene_sun;
  scene_sun.direction_to_sun = Vec3f(0.6F, 0.0F, 0.8F);
  const Lighting lighting = MakeLighting(LightSpec{}, scene_sun);
  EXPECT_GT(Luminance(lighting.sky.Radiance(Vec3d(0.6, 0.0, 0.8))),
            1.5F * Luminance(lighting.sky.Radiance(Vec3d(-0.6, 0.0, 0.8))));
}

TEST(MakeLighting, StrengthsSwitchSunAndSkyOff) {
  LightSpec spec;
  spec.sun = SunSpec{};
  spec.sun->strength = 0.0;
  EXPECT_FALSE(MakeLighting(spec, std::nullopt).sun.has_value());
  EXPECT_FALSE(MakeLighting(spec, std::nullopt).sky.IsBlack());
  spec.sky.strength = 0.0;
  EXPECT_TRUE(MakeLighting(spec, std::nullopt).sky.IsBlack());
}

TEST(MakeLighting, ConstantSkyHasTheGivenRadianceTimesItsStrength) {
  LightSpec spec;
  spec.sky.model = "constant";
  spec.sky.radiance = {1.0, 2.0, 3.0};
  spec.sky.strength = 0.5;
  EXPECT_TRUE(MakeLighting(spec, std::nullopt)
                  .sky.Radiance(Vec3d::UnitY())
                  .isApprox(Rgb(0.5F, 1.0F, 1.5F), 1e-6F));
}

TEST(MakeLighting, CloudsCoverTheClearSkyAndDimTheSunBehindThem) {
  LightSpec spec;
  spec.sun = SunSpec{};
  const Lighting clear = MakeLighting(spec, std::nullopt);
  spec.sky.clouds.share = 1.0;
  const Lighting overcast = MakeLighting(spec, std::nullopt);
  const float clear_klx = Luminance(clear.sun->Irradiance());
  EXPECT_TRUE(!overcast.sun.has_value() ||
              Luminance(overcast.sun->Irradiance()) < 0.05F * clear_klx);
  // Grey, where the clear sky is blue.
  const Rgb before = clear.sky.Radiance(Vec3d::UnitZ());
  const Rgb after = overcast.sky.Radiance(Vec3d::UnitZ());
  EXPECT_GT(before[2] / before[0], 1.5F);
  EXPECT_LT(after[2] / after[0], 1.15F);
  // Other models have no clouds.
  spec.sky.model = "constant";
  EXPECT_FLOAT_EQ(Luminance(MakeLighting(spec, std::nullopt).sun->Irradiance()), clear_klx);
}

TEST(MakeLighting, AFreeSunKeepsItsLightUnderClouds) {
  // The sky of the shipped sequence.
  LightSpec spec =
      ReadSequenceSpec(std::filesystem::path(PFSEQ_SOURCE_DIR) / "data/sequences/pfseq.yaml").light;
  EXPECT_GT(spec.sky.clouds.share, 0.2);
  const Lighting lighting = MakeLighting(spec, std::nullopt);
  spec.sky.clouds.share = 0.0;
  const Lighting clear = MakeLighting(spec, std::nullopt);
  ASSERT_TRUE(lighting.sun.has_value());
  EXPECT_TRUE(lighting.sun->Irradiance().isApprox(clear.sun->Irradiance(), 0.01F));
}

TEST(MakeLighting, TheSkysStrengthIsThatOfItsCloudsToo) {
  LightSpec spec;
  spec.sky.clouds.share = 0.7;
  const Rgb one = MakeLighting(spec, std::nullopt).sky.HorizontalIrradiance();
  spec.sky.strength = 0.25;
  EXPECT_TRUE(
      MakeLighting(spec, std::nullopt).sky.HorizontalIrradiance().isApprox(0.25F * one, 1e-3F));
  spec.sky.strength = 0.0;
  EXPECT_TRUE(MakeLighting(spec, std::nullopt).sky.IsBlack());
}

TEST(MakeLighting, AMapBringsItsOwnSunAndItsStrengthIsThatOfBoth) {
  const TempFolder folder;
  Image<float> map(512, 256, 3, 2.0F);
  // A sun of 3 x 3 pixels at the column 192: azimuth 180 - 360 * 192.5 / 512 = 44.65 degrees; row
  // 85: elevation 90 - 180 * 85.5 / 256 = 29.88 degrees.
  for (int i = 0; i < 9; ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      map.At(191 + i % 3, 84 + i / 3, channel) = 1e5F;
    }
  }
  WriteFileAtomically(folder / "map.exr", EncodeExrFloat(map));
  LightSpec spec;
  spec.sky.model = "map";
  spec.sky.map = (folder / "map.exr").string();
  spec.sky.strength = 0.5;
  Sun scene_sun;
  scene_sun.direction_to_sun = Vec3f::UnitZ();
  const Lighting lighting = MakeLighting(spec, scene_sun);
  ASSERT_TRUE(lighting.sun.has_value());
  EXPECT_LT((lighting.sun->DirectionToSun() - DirectionAt(29.88, 44.65)).norm(), 1e-3);
  // 9 pixels of (360 / 512 degrees)^2 cos(29.88 degrees).
  const double expected_klx = 0.5 * (1e5 - 2.0) * 9.0 * std::pow(RadFromDeg(360.0 / 512.0), 2.0) *
                              std::cos(RadFromDeg(29.88));
  EXPECT_NEAR(Luminance(lighting.sun->Irradiance()), expected_klx, 2e-3 * expected_klx);
  EXPECT_NEAR(lighting.sky.Radiance(DirectionAt(29.88, 44.65))[0], 1.0F, 1e-3F);
  EXPECT_NEAR(lighting.sky.Radiance(DirectionAt(-40.0, 200.0))[2], 1.0F, 1e-5F);
  // Turned with the map; and none, without a sun in the map.
  spec.sky.map_rotation_deg = 90.0;
  EXPECT_LT(
      (MakeLighting(spec, std::nullopt).sun->DirectionToSun() - DirectionAt(29.88, 134.65)).norm(),
      1e-3);
  WriteFileAtomically(folder / "map.exr", EncodeExrFloat(Image<float>(64, 32, 3, 2.0F)));
  EXPECT_FALSE(MakeLighting(spec, scene_sun).sun.has_value());
}

TEST(MakeLighting, RefusesWhatTheSkyCannotDo) {
  LightSpec spec;
  spec.sky.model = "overcast";
  EXPECT_THAT(MessageOf<InputError>([&] { MakeLighting(spec, std::nullopt); }),
              HasSubstr("got 'overcast'"));
  spec.sky.model = "clear";
  spec.sky.turbidity = 1.0;
  EXPECT_THAT(MessageOf<InputError>([&] { MakeLighting(spec, std::nullopt); }),
              HasSubstr("expected 1.8 to 10, got 1"));
}

}  // namespace
}  // namespace pfseq
