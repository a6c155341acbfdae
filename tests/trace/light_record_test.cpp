// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/light_record.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

GatheredLight Light(float value) {
  GatheredLight gathered;
  gathered.light.x = Eigen::Array4f(value, 2.0F * value, 3.0F * value, 0.0F);
  gathered.light.y = -gathered.light.x;
  gathered.light.z = 4.0F * gathered.light.x;
  return gathered;
}

TEST(LightRecord, GivesBackWhatItHolds) {
  const LightRecord record(Light(0.5F), false);
  VectorIrradiance light;
  record.AddTo(2.0F, light);
  record.AddTo(1.0F, light);
  EXPECT_EQ(light.x.head<3>().matrix(), Eigen::Vector3f(1.5F, 3.0F, 4.5F));
  EXPECT_EQ(light.y.head<3>().matrix(), Eigen::Vector3f(-1.5F, -3.0F, -4.5F));
  EXPECT_EQ(light.z.head<3>().matrix(), Eigen::Vector3f(6.0F, 12.0F, 18.0F));
}

TEST(LightRecord, BrightestLightStaysFinite) {
  VectorIrradiance light;
  LightRecord(Light(1e9F), false).AddTo(1.0F, light);
  EXPECT_TRUE(light.z.head<3>().isFinite().all());
  EXPECT_GT(light.z[0], 6e4F);
}

TEST(LightRecord, IsWantedOnceAndReadyOnce) {
  LightRecord record;
  EXPECT_FALSE(record.IsReady());
  EXPECT_TRUE(record.MarkWanted());
  EXPECT_FALSE(record.MarkWanted());
  const LightRecord computed(Light(1.0F), true);
  EXPECT_TRUE(record.Publish(computed));
  EXPECT_FALSE(record.Publish(computed));
  EXPECT_TRUE(record.IsReady());
  EXPECT_FALSE(record.MarkWanted());
  EXPECT_TRUE(record.IsBesideBody());
}

TEST(LightRecord, TellsBuriedFromBesideABody) {
  GatheredLight buried = Light(1.0F);
  buried.is_buried = true;
  EXPECT_TRUE(LightRecord(buried, true).IsBuried());
  EXPECT_FALSE(LightRecord(Light(1.0F), true).IsBuried());
  EXPECT_FALSE(LightRecord(buried, false).IsBesideBody());
}

}  // namespace
}  // namespace pfseq
