// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/light_record.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

const Vec3f kUp = Vec3f::UnitZ();

GatheredLight Light(float value) {
  GatheredLight gathered;
  gathered.light.x = Eigen::Array4f(value, 2.0F * value, 3.0F * value, 0.0F);
  gathered.light.y = -gathered.light.x;
  gathered.light.z = 4.0F * gathered.light.x;
  return gathered;
}

TEST(LightRecord, GivesBackWhatItHolds) {
  const LightRecord record(Light(0.5F), kUp, false);
  VectorIrradiance light;
  record.AddTo(2.0F, light);
  record.AddTo(1.0F, light);
  EXPECT_EQ(light.x.head<3>().matrix(), Eigen::Vector3f(1.5F, 3.0F, 4.5F));
  EXPECT_EQ(light.y.head<3>().matrix(), Eigen::Vector3f(-1.5F, -3.0F, -4.5F));
  EXPECT_EQ(light.z.head<3>().matrix(), Eigen::Vector3f(6.0F, 12.0F, 18.0F));
}

TEST(LightRecord, BrightestLightStaysFinite) {
  VectorIrradiance light;
  LightRecord(Light(1e9F), kUp, false).AddTo(1.0F, light);
  EXPECT_TRUE(light.z.head<3>().isFinite().all());
  EXPECT_GT(light.z[0], 6e4F);
}

TEST(LightRecord, IsWantedOnceAndReadyOnce) {
  LightRecord record;
  EXPECT_FALSE(record.IsReady());
  EXPECT_TRUE(record.MarkWanted());
  EXPECT_FALSE(record.MarkWanted());
  const LightRecord computed(Light(1.0F), kUp, true);
  EXPECT_TRUE(record.Publish(computed));
  EXPECT_FALSE(record.Publish(computed));
  EXPECT_TRUE(record.IsReady());
  EXPECT_FALSE(record.MarkWanted());
  EXPECT_TRUE(record.IsBesideBody());
}

TEST(LightRecord, TellsBuriedFromBesideABody) {
  GatheredLight buried = Light(1.0F);
  buried.is_buried = true;
  EXPECT_TRUE(LightRecord(buried, kUp, true).IsBuried());
  EXPECT_FALSE(LightRecord(Light(1.0F), kUp, true).IsBuried());
  EXPECT_FALSE(LightRecord(buried, kUp, false).IsBesideBody());
}

TEST(LightRecord, LevelsTellRatiosOfTheIrradiance) {
  const auto level = [](float value, const Vec3f& normal) {
    return LightRecord(Light(value), normal, false).Level();
  };
  for (const float value : {0.01F, 0.3F, 4.0F, 500.0F}) {
    EXPECT_EQ(level(2.0F * value, kUp) - level(value, kUp), LightRecord::kLevelsPerStop);
    EXPECT_NEAR(level(std::sqrt(2.0F) * value, kUp) - level(value, kUp), 512, 90);
  }
  // Of the vector (1, -1, 4): along the normal alone, and never negative.
  EXPECT_EQ(level(1.0F, kUp), level(4.0F, Vec3f::UnitX()));
  EXPECT_EQ(level(1.0F, Vec3f::UnitY()), 0);
}

}  // namespace
}  // namespace pfseq
