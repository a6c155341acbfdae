// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/lens.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kFocalPx = 400.0;
const Vec2d kCentrePx(600.0, 500.0);

/// A lens model with its formula written independently, in extended precision.
struct ModelCase {
  std::string name;
  LensModel model;
  /// Half field of view for round trips.
  double max_angle_deg;
  std::function<long double(long double)> image_height;
};

void PrintTo(const ModelCase& model_case, std::ostream* out) { *out << model_case.name; }

std::vector<ModelCase> ModelCases() {
  return {
      {"equidistant", Equidistant{}, 170.0, [](long double t) { return t; }},
      {"equisolid",
       Equisolid{},
       170.0,
       [](long double t) { return std::sqrt(2.0L) * std::sin(t) / std::sqrt(1.0L + std::cos(t)); }},
      {"stereographic",
       Stereographic{},
       170.0,
       [](long double t) { return 2.0L * std::sin(t) / (1.0L + std::cos(t)); }},
      {"orthographic", Orthographic{}, 89.0, [](long double t) { return std::sin(t); }},
      {"perspective", Perspective{}, 89.0, [](long double t) { return std::sin(t) / std::cos(t); }},
      {"kannala_brandt",
       KannalaBrandt({-0.04, 0.006, -0.002, 0.0001}),
       95.0,
       [](long double t) {
         return t - 0.04L * std::pow(t, 3.0L) + 0.006L * std::pow(t, 5.0L) -
                0.002L * std::pow(t, 7.0L) + 0.0001L * std::pow(t, 9.0L);
       }},
  };
}

class EveryLens : public testing::TestWithParam<ModelCase> {
 protected:
  Lens MakeLens() const {
    return Lens(GetParam().model,
                Vec2d::Constant(kFocalPx),
                kCentrePx,
                RadFromDeg(GetParam().max_angle_deg));
  }
};

Vec3d DirectionAt(double theta_rad, double azimuth_rad) {
  return {std::sin(theta_rad) * std::cos(azimuth_rad),
          std::sin(theta_rad) * std::sin(azimuth_rad),
          std::cos(theta_rad)};
}

TEST_P(EveryLens, ProjectsToTheFormulasImageHeightAtTheDirectionsAzimuth) {
  const Lens lens = MakeLens();
  for (double theta_deg = 1e-6; theta_deg < GetParam().max_angle_deg; theta_deg += 0.5) {
    const double azimuth_rad = RadFromDeg(7.0 * theta_deg);
    const long double theta_rad = static_cast<long double>(RadFromDeg(theta_deg));
    const double radius_px = static_cast<double>(kFocalPx * GetParam().image_height(theta_rad));
    // Any length of the direction will do.
    const auto pixel_px = lens.Project(3.5 * DirectionAt(RadFromDeg(theta_deg), azimuth_rad));
    ASSERT_TRUE(pixel_px.has_value()) << theta_deg;
    const double tolerance_px = 1e-11 * (1.0 + radius_px);
    EXPECT_NEAR(pixel_px->x(), kCentrePx.x() + radius_px * std::cos(azimuth_rad), tolerance_px)
        << theta_deg;
    EXPECT_NEAR(pixel_px->y(), kCentrePx.y() + radius_px * std::sin(azimuth_rad), tolerance_px)
        << theta_deg;
  }
}

TEST_P(EveryLens, UnprojectIsInverseOfProjectOverTheWholeField) {
  const Lens lens = MakeLens();
  const double radius_px = 0.5 * lens.CirclePx();
  double worst_px = 0.0;
  double worst_norm = 0.0;
  for (int i = 0; i <= 400; ++i) {
    for (int j = 0; j < 36; ++j) {
      const double height_px = radius_px * i / 400.0 * (1.0 - 1e-12);
      const double azimuth_rad = RadFromDeg(10.0 * j);
      const Vec2d pixel_px =
          kCentrePx + height_px * Vec2d(std::cos(azimuth_rad), std::sin(azimuth_rad));
      const auto direction = lens.Unproject(pixel_px);
      ASSERT_TRUE(direction.has_value()) << pixel_px.transpose();
      const auto again_px = lens.Project(*direction);
      ASSERT_TRUE(again_px.has_value()) << pixel_px.transpose();
      worst_px = std::max(worst_px, (*again_px - pixel_px).norm());
      worst_norm = std::max(worst_norm, std::abs(direction->norm() - 1.0));
    }
  }
  EXPECT_LE(worst_px, 1e-9);
  EXPECT_LE(worst_norm, 1e-15);
}

TEST_P(EveryLens, IsExactNearTheAxis) {
  const Lens lens = MakeLens();
  // Two picoradians off the axis: an arc cosine would round to 0.
  const Vec3d direction(2e-12, 0.0, 1.0);
  const double expected_px = kFocalPx * 2e-12;
  const Vec2d offset_px =
      *Lens(GetParam().model, Vec2d::Constant(kFocalPx), Vec2d::Zero(), 1.0).Project(direction);
  EXPECT_NEAR(offset_px.x(), expected_px, 1e-12 * expected_px);
  EXPECT_EQ(offset_px.y(), 0.0);
  EXPECT_EQ(*lens.Unproject(kCentrePx), Vec3d(0.0, 0.0, 1.0));
  EXPECT_EQ(*lens.Project({0.0, 0.0, 2.0}), kCentrePx);
}

TEST_P(EveryLens, ShowsNothingBeyondItsField) {
  const Lens lens = MakeLens();
  const double max_angle_rad = RadFromDeg(GetParam().max_angle_deg);
  for (double azimuth_rad = 0.1; azimuth_rad < 6.2; azimuth_rad += 0.5) {
    EXPECT_TRUE(lens.Project(DirectionAt(max_angle_rad - 1e-9, azimuth_rad)));
    EXPECT_FALSE(lens.Project(DirectionAt(max_angle_rad + 1e-9, azimuth_rad)));
    const Vec2d outwards(std::cos(azimuth_rad), std::sin(azimuth_rad));
    const double radius_px = 0.5 * lens.CirclePx();
    EXPECT_TRUE(lens.Unproject(kCentrePx + (radius_px - 1e-6) * outwards));
    EXPECT_FALSE(lens.Unproject(kCentrePx + (radius_px + 1e-6) * outwards));
    EXPECT_FALSE(lens.Unproject(kCentrePx + 1e4 * radius_px * outwards));
  }
  EXPECT_FALSE(lens.Project({0.0, 0.0, -1.0}));
}

INSTANTIATE_TEST_SUITE_P(Models, EveryLens, testing::ValuesIn(ModelCases()), [](const auto& test) {
  return test.param.name;
});

Lens PfseqLens(const LensModel& model, double circle_px) {
  const double max_angle_rad = RadFromDeg(90.9);
  const double focal_px = Lens::FocalFromCirclePx(model, circle_px, max_angle_rad);
  return Lens(model, Vec2d::Constant(focal_px), Vec2d(600.0, 600.0), max_angle_rad);
}

TEST(Lens, HasTheFocalLengthsOfPfseq) {
  EXPECT_NEAR(PfseqLens(Equidistant{}, 1200.0).FocalPx().x(), 378.19, 0.005);
  EXPECT_NEAR(PfseqLens(Equisolid{}, 1124.0).FocalPx().x(), 394.31, 0.005);
  EXPECT_NEAR(PfseqLens(Equidistant{}, 1200.0).CirclePx(), 1200.0, 1e-9);
  EXPECT_NEAR(PfseqLens(Equisolid{}, 1124.0).CirclePx(), 1124.0, 1e-9);
}

TEST(Lens, MapsHandComputedPixels) {
  // At 90 degrees the equidistant radius is f pi / 2, the equisolid one f sqrt(2).
  const Lens equidistant(
      Equidistant{}, Vec2d::Constant(400.0), Vec2d(600.0, 600.0), RadFromDeg(100.0));
  EXPECT_LT((*equidistant.Project({1.0, 0.0, 0.0}) - Vec2d(1228.318530717959, 600.0)).norm(),
            1e-11);
  EXPECT_LT((*equidistant.Project({0.0, 1.0, 0.0}) - Vec2d(600.0, 1228.318530717959)).norm(),
            1e-11);
  const Lens equisolid(Equisolid{}, Vec2d::Constant(400.0), Vec2d(600.0, 600.0), RadFromDeg(100.0));
  EXPECT_LT((*equisolid.Project({-5.0, 0.0, 0.0}) - Vec2d(34.31457505076198, 600.0)).norm(), 1e-11);
  EXPECT_LT((*equisolid.Project({0.0, -1.0, 0.0}) - Vec2d(600.0, 34.31457505076198)).norm(), 1e-11);
}

TEST(Lens, LooksAlongTheThreeAxesOfTheCameraFrame) {
  const Lens lens = PfseqLens(Equidistant{}, 1200.0);
  // Right of the centre is +x, below is +y, the centre is +z.
  EXPECT_GT(lens.Unproject({601.0, 600.0})->x(), 0.0);
  EXPECT_GT(lens.Unproject({600.0, 601.0})->y(), 0.0);
  EXPECT_GT(lens.Unproject({600.0, 600.0})->z(), 0.0);
  // Within 0.9 degrees of the rim a lens of 181.8 degrees looks behind itself.
  EXPECT_LT(lens.Unproject({1199.0, 600.0})->z(), 0.0);
}

TEST(Lens, TakesDifferentFocalLengthsAlongXAndY) {
  const Lens lens(Equidistant{}, Vec2d(400.0, 200.0), Vec2d(0.0, 0.0), 1.6);
  EXPECT_LT((*lens.Project({1.0, 0.0, 1.0}) - Vec2d(100.0 * std::numbers::pi, 0.0)).norm(), 1e-11);
  EXPECT_LT((*lens.Project({0.0, 1.0, 1.0}) - Vec2d(0.0, 50.0 * std::numbers::pi)).norm(), 1e-11);
  const Vec2d pixel_px(211.0, -97.0);
  EXPECT_LT((*lens.Project(*lens.Unproject(pixel_px)) - pixel_px).norm(), 1e-11);
}

/// Usenko, Demmel, Cremers 2018, "The double sphere camera model", equations (40) to (43).
Vec2d DoubleSphereProject(const Vec3d& x, double focal_px, double xi, double alpha) {
  const double d1 = x.norm();
  const double d2 = std::sqrt(x.x() * x.x() + x.y() * x.y() + std::pow(xi * d1 + x.z(), 2));
  return focal_px / (alpha * d2 + (1.0 - alpha) * (xi * d1 + x.z())) * x.head<2>();
}

TEST(EquisolidLens, EqualsTheDoubleSphereModelWithXiAndAlphaOne) {
  const Lens lens(Equisolid{}, Vec2d::Constant(394.31), Vec2d::Zero(), RadFromDeg(170.0));
  for (double theta_deg = 0.5; theta_deg < 170.0; theta_deg += 1.0) {
    const Vec3d direction = DirectionAt(RadFromDeg(theta_deg), RadFromDeg(11.0 * theta_deg));
    const Vec2d expected_px = DoubleSphereProject(direction, 2.0 * 394.31, 1.0, 1.0);
    EXPECT_LT((*lens.Project(direction) - expected_px).norm(), 1e-9) << theta_deg;
  }
}

TEST(Lens, CoversTheModelsLimitOnlyWhereItHasAnImage) {
  const double pi = std::numbers::pi;
  EXPECT_TRUE(LensModelCovers(Equidistant{}, pi));
  EXPECT_TRUE(LensModelCovers(Equisolid{}, pi));
  EXPECT_FALSE(LensModelCovers(Stereographic{}, pi));
  EXPECT_TRUE(LensModelCovers(Stereographic{}, pi - 0.01));
  EXPECT_TRUE(LensModelCovers(Orthographic{}, 0.5 * pi));
  EXPECT_FALSE(LensModelCovers(Orthographic{}, 0.51 * pi));
  EXPECT_FALSE(LensModelCovers(Perspective{}, 0.5 * pi));
  EXPECT_TRUE(LensModelCovers(KannalaBrandt({}), pi));
  EXPECT_FALSE(LensModelCovers(Equidistant{}, 0.0));
  EXPECT_FALSE(LensModelCovers(Equidistant{}, -1.0));
  EXPECT_FALSE(LensModelCovers(Equidistant{}, std::nan("")));
}

TEST(Lens, RefusesWhatNoLensCanBe) {
  const Vec2d focal_px(400.0, 400.0);
  const Vec2d centre_px(0.0, 0.0);
  EXPECT_THROW(Lens(Perspective{}, focal_px, centre_px, 1.6), InputError);
  EXPECT_THROW(Lens(Equidistant{}, Vec2d(400.0, 0.0), centre_px, 1.5), InputError);
  EXPECT_THROW(Lens(Equidistant{}, Vec2d(std::nan(""), 400.0), centre_px, 1.5), InputError);
  EXPECT_THROW(Lens(Equidistant{}, focal_px, Vec2d(0.0, INFINITY), 1.5), InputError);
  try {
    Lens(Orthographic{}, focal_px, centre_px, RadFromDeg(95.0));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "field of view: expected > 0 and <= 180 degrees for orthographic, got 190");
  }
}

TEST(Lens, TellsItsModel) {
  const Lens lens = PfseqLens(Equisolid{}, 1124.0);
  EXPECT_EQ(lens.ModelName(), "equisolid");
  EXPECT_TRUE(std::holds_alternative<Equisolid>(lens.Model()));
  EXPECT_EQ(lens.PrincipalPointPx(), Vec2d(600.0, 600.0));
  EXPECT_DOUBLE_EQ(lens.MaxAngleRad(), 90.9 * std::numbers::pi / 180.0);
}

TEST(Lens, MeasuresIncidenceAnglesBehindItselfAndCloseToTheAxes) {
  EXPECT_DOUBLE_EQ(Lens::IncidenceAngleRad({1.0, 0.0, 0.0}), 0.5 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(Lens::IncidenceAngleRad({0.0, -3.0, -3.0}), 0.75 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(Lens::IncidenceAngleRad({3e-13, 4e-13, 1.0}), 5e-13);
}

}  // namespace
}  // namespace pfseq
