// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_axes.h"

#include "renderer/core/vector.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(GltfAxes, UpOfGltfIsUpOfTheWorld) {
  EXPECT_EQ(WorldFromGltf<double>(Vec3d::UnitY()), Vec3d::UnitZ());
  EXPECT_EQ(WorldFromGltf<double>(Vec3d::UnitX()), Vec3d::UnitX());
  EXPECT_EQ(WorldFromGltf<double>(Vec3d::UnitZ()), Vec3d(-Vec3d::UnitY()));
}

TEST(GltfAxes, KeepHandedness) {
  const Vec3d x = WorldFromGltf<double>(Vec3d::UnitX());
  const Vec3d y = WorldFromGltf<double>(Vec3d::UnitY());
  EXPECT_EQ(x.cross(y), WorldFromGltf<double>(Vec3d::UnitZ()));
}

TEST(GltfAxes, AreEachOthersInverse) {
  const Vec3f point(0.1F, -2.3F, 4.5F);
  EXPECT_EQ(WorldFromGltf(GltfFromWorld(point)), point);
  EXPECT_EQ(GltfFromWorld(WorldFromGltf(point)), point);
}

}  // namespace
}  // namespace pfseq
