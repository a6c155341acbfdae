// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/sky_map.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/image_io.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/trace/directions.h"

#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr int kWidthPx = 512;

void SetPixel(Image<float>& image, int x, int y, const Rgb& color) {
  for (int channel = 0; channel < 3; ++channel) {
    image.At(x, y, channel) = color[channel];
  }
}

/// A map whose colour is 2 plus the direction, by the documented convention.
Image<float> DirectionMap() {
  Image<float> image(kWidthPx, kWidthPx / 2, 3);
  for (int y = 0; y < image.HeightPx(); ++y) {
    for (int x = 0; x < image.WidthPx(); ++x) {
      const double azimuth_deg = 180.0 - 360.0 * (x + 0.5) / kWidthPx;
      const double elevation_deg = 90.0 - 180.0 * (y + 0.5) / image.HeightPx();
      const Vec3d direction = DirectionAt(elevation_deg, azimuth_deg);
      SetPixel(image, x, y, Rgb(2.0F + direction.cast<float>().array()));
    }
  }
  return image;
}

TEST(SkyMap, CentreIsPlusXLeftIsPlusYTopIsUp) {
  const SkyMap map(DirectionMap(), 0.0);
  for (int elevation_deg = -90; elevation_deg <= 90; elevation_deg += 6) {
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 11) {
      const Vec3d direction = DirectionAt(elevation_deg, azimuth_deg);
      ASSERT_LT((map.Radiance(direction) - 2.0F - direction.cast<float>().array()).abs().maxCoeff(),
                0.01F)
          << elevation_deg << " " << azimuth_deg;
    }
  }
}

TEST(SkyMap, RotationTurnsItCounterClockwise) {
  const SkyMap map(DirectionMap(), RadFromDeg(90.0));
  // What was toward +X is toward +Y now.
  EXPECT_NEAR(map.Radiance(Vec3d::UnitY())[0], 3.0F, 0.01F);
  EXPECT_NEAR(map.Radiance(-Vec3d::UnitX())[1], 3.0F, 0.01F);
}

TEST(SkyMap, ALargeMapBecomesCoarserWithTheSameLight) {
  Image<float> image(8192, 4096, 3, 1.0F);
  for (int y = 0; y < image.HeightPx(); ++y) {
    for (int x = 0; x < image.WidthPx(); x += 2) {
      image.At(x, y, 1) = 3.0F;
    }
  }
  const SkyMap map(image, 0.0);
  for (int i = 0; i < 50; ++i) {
    EXPECT_NEAR(map.Radiance(DirectionAt(3.0 * i - 70.0, 31.7 * i))[1], 2.0F, 1e-5F);
  }
}

/// A sky of the luminance 4 and a sun of some pixels, three times as much red as blue.
struct SunnyMap {
  Image<float> image = Image<float>(kWidthPx, kWidthPx / 2, 3, 4.0F);
  Eigen::Array3d irradiance = Eigen::Array3d::Zero();
  Vec3d centre = Vec3d::Zero();

  SunnyMap(double elevation_deg, double azimuth_deg, double radius_deg) {
    const Vec3d to_sun = DirectionAt(elevation_deg, azimuth_deg);
    const Rgb sun(30000.0F, 20000.0F, 10000.0F);
    for (int y = 0; y < image.HeightPx(); ++y) {
      for (int x = 0; x < kWidthPx; ++x) {
        const Vec3d direction = DirectionAt(90.0 - 180.0 * (y + 0.5) / image.HeightPx(),
                                            180.0 - 360.0 * (x + 0.5) / kWidthPx);
        if (direction.dot(to_sun) > std::cos(RadFromDeg(radius_deg))) {
          SetPixel(image, x, y, sun);
          // Solid angle of a pixel at its middle, not as the map has it.
          const double solid_angle = 2.0 * kPi / kWidthPx * kPi / image.HeightPx() *
                                     std::hypot(direction.x(), direction.y());
          irradiance += solid_angle * (sun - 4.0F).cast<double>();
          centre += solid_angle * direction;
        }
      }
    }
    centre.normalize();
  }
};

TEST(SkyMap, TheSunIsTakenOutWithItsEnergyAndDirection) {
  // High, low, and across the seam of the map.
  for (const auto& [elevation_deg, azimuth_deg] :
       {std::pair{50.0, 20.0}, {8.0, 300.0}, {30.0, 180.0}}) {
    const SunnyMap sunny(elevation_deg, azimuth_deg, 1.2);
    const SkyMap map(sunny.image, 0.0);
    ASSERT_TRUE(map.Sun().has_value());
    EXPECT_TRUE(map.Sun()->irradiance.isApprox(sunny.irradiance.cast<float>(), 1e-3F))
        << map.Sun()->irradiance.transpose() << " for " << sunny.irradiance.transpose();
    EXPECT_LT(DegFromRad(std::acos(map.Sun()->direction_to_sun.dot(sunny.centre))), 0.02);
    EXPECT_LT(DegFromRad(std::acos(
                  map.Sun()->direction_to_sun.dot(DirectionAt(elevation_deg, azimuth_deg)))),
              0.35);
    // The surroundings are in its place.
    EXPECT_NEAR(Luminance(map.Radiance(map.Sun()->direction_to_sun)), 4.0F, 1e-3F);
  }
}

TEST(SkyMap, TheSunTurnsWithTheMap) {
  const SkyMap map(SunnyMap(50.0, 20.0, 1.2).image, RadFromDeg(60.0));
  ASSERT_TRUE(map.Sun().has_value());
  EXPECT_LT((map.Sun()->direction_to_sun - DirectionAt(50.0, 80.0)).norm(), 0.006);
}

TEST(SkyMap, WithoutASunThereIsNone) {
  EXPECT_FALSE(SkyMap(DirectionMap(), 0.0).Sun().has_value());
  // A bright cloud, thirty times as bright as the rest.
  Image<float> cloudy(kWidthPx, kWidthPx / 2, 3, 4.0F);
  for (int y = 60; y < 90; ++y) {
    for (int x = 100; x < 160; ++x) {
      SetPixel(cloudy, x, y, Rgb::Constant(120.0F));
    }
  }
  EXPECT_FALSE(SkyMap(cloudy, 0.0).Sun().has_value());
  // A lamp below the horizon.
  Image<float> lamp(kWidthPx, kWidthPx / 2, 3, 4.0F);
  SetPixel(lamp, 100, 200, Rgb::Constant(1e6F));
  EXPECT_FALSE(SkyMap(lamp, 0.0).Sun().has_value());
}

class SkyMapFile : public testing::Test {
 protected:
  std::string ErrorOf(const Image<float>& image) {
    WriteFileAtomically(path_, EncodeExrFloat(image));
    return MessageOf<InputError>([&] { SkyMap::Read(path_, 0.0); });
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_.Path() / "map.exr";
};

TEST_F(SkyMapFile, IsReadAsItIs) {
  WriteFileAtomically(path_, EncodeExrFloat(DirectionMap()));
  const SkyMap map = SkyMap::Read(path_, 0.0);
  EXPECT_NEAR(map.Radiance(Vec3d::UnitX())[0], 3.0F, 0.01F);
}

TEST_F(SkyMapFile, NegativeValuesCountAsZero) {
  WriteFileAtomically(path_, EncodeExrFloat(Image<float>(64, 32, 3, -1.0F)));
  EXPECT_EQ(SkyMap::Read(path_, 0.0).Radiance(Vec3d::UnitZ()).maxCoeff(), 0.0F);
}

TEST_F(SkyMapFile, RefusesOtherShapesAndValues) {
  EXPECT_THAT(
      ErrorOf(Image<float>(64, 64, 3)),
      AllOf(HasSubstr("map.exr"), HasSubstr("twice as wide as high"), HasSubstr("64 x 64")));
  Image<float> image(64, 32, 3, 1.0F);
  image.At(7, 5, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(ErrorOf(image), AllOf(HasSubstr("map.exr"), HasSubstr("got nan at pixel 7,5")));
  image.At(7, 5, 2) = std::numeric_limits<float>::infinity();
  EXPECT_THAT(ErrorOf(image), HasSubstr("got inf at pixel 7,5"));
}

}  // namespace
}  // namespace pfseq
