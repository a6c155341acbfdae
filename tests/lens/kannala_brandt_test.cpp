// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/kannala_brandt.h"

#include "renderer/core/units.h"
#include "renderer/lens/lens.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(KannalaBrandt, WithoutCoefficientsIsEquidistant) {
  const KannalaBrandt model({0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(model.LimitAngleRad(), kPi);
  for (double theta_rad = 0.0; theta_rad <= kPi; theta_rad += 0.01) {
    EXPECT_EQ(model.ImageHeight(theta_rad), theta_rad);
    EXPECT_NEAR(model.IncidenceAngleRad(theta_rad), theta_rad, 1e-15);
  }
}

TEST(KannalaBrandt, WithTheSeriesOfTheSineIsEquisolid) {
  // 2 sin(t / 2) = t - t^3 / 24 + t^5 / 1920 - t^7 / 322560 + t^9 / 92897280 - ...
  const KannalaBrandt model({-1.0 / 24.0, 1.0 / 1920.0, -1.0 / 322560.0, 1.0 / 92897280.0});
  const Lens lens(model, Vec2d::Constant(394.31), Vec2d::Zero(), RadFromDeg(95.0));
  const Lens equisolid(Equisolid{}, Vec2d::Constant(394.31), Vec2d::Zero(), RadFromDeg(95.0));
  for (double theta_deg = 0.0; theta_deg < 95.0; theta_deg += 0.5) {
    const double theta_rad = RadFromDeg(theta_deg);
    const Vec3d direction(
        0.6 * std::sin(theta_rad), -0.8 * std::sin(theta_rad), std::cos(theta_rad));
    EXPECT_LT((*lens.Project(direction) - *equisolid.Project(direction)).norm(), 1e-5) << theta_deg;
  }
}

TEST(KannalaBrandt, InvertsToRoundingUpToItsLimit) {
  for (const std::array<double, 4>& coefficients : {std::array{-0.1, 0.0, 0.0, 0.0},
                                                    std::array{0.3, -0.2, 0.1, -0.02},
                                                    std::array{0.05, 0.02, 0.01, 0.005},
                                                    std::array{-0.04, 0.006, -0.002, 0.0001},
                                                    std::array{-0.6, 0.5, -0.2, 0.03}}) {
    const KannalaBrandt model(coefficients);
    const double limit_rad = model.LimitAngleRad();
    for (int i = 0; i <= 1000; ++i) {
      const double theta_rad = limit_rad * i / 1000.0;
      const double height = model.ImageHeight(theta_rad);
      const double found_rad = model.IncidenceAngleRad(height);
      EXPECT_NEAR(model.ImageHeight(found_rad), height, 2e-15 * std::max(1.0, height))
          << coefficients[0] << " " << i;
    }
  }
}

TEST(KannalaBrandt, EndsWhereThePolynomialStopsGrowing) {
  // The slope 1 - 0.3 t^2 is 0 at sqrt(10 / 3).
  const KannalaBrandt model({-0.1, 0.0, 0.0, 0.0});
  EXPECT_NEAR(model.LimitAngleRad(), std::sqrt(10.0 / 3.0), 1e-14);
  const double greatest = model.ImageHeight(model.LimitAngleRad());
  EXPECT_NEAR(model.IncidenceAngleRad(greatest), model.LimitAngleRad(), 1e-7);
  EXPECT_TRUE(std::isinf(model.IncidenceAngleRad(greatest * (1.0 + 1e-12))));
  EXPECT_TRUE(std::isinf(model.IncidenceAngleRad(1e300)));
}

TEST(KannalaBrandt, EndsAtTheFirstOfSeveralTurningPoints) {
  // Slope (1 - u) (1 - u / 2) (1 - u / 4) with u = t^2: turning points at 1, sqrt(2) and 2.
  const KannalaBrandt model({-1.75 / 3.0, 0.875 / 5.0, -0.125 / 7.0, 0.0});
  EXPECT_NEAR(model.LimitAngleRad(), 1.0, 1e-14);
  // Slope (1 - u / 8.7) (1 - u / 9.5): the first is just below pi squared.
  const double p = 1.0 / 8.7;
  const double q = 1.0 / 9.5;
  EXPECT_NEAR(KannalaBrandt({-(p + q) / 3.0, p * q / 5.0, 0.0, 0.0}).LimitAngleRad(),
              std::sqrt(8.7),
              1e-12);
}

TEST(KannalaBrandt, WithoutTurningPointReachesTheWholeSphere) {
  EXPECT_EQ(KannalaBrandt({0.05, 0.02, 0.01, 0.005}).LimitAngleRad(), kPi);
}

}  // namespace
}  // namespace pfseq
