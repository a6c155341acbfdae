// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/canyon.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

bool HaveSameBits(const Scene& a, const Scene& b) {
  if (a.meshes.size() != b.meshes.size() || a.textures.size() != b.textures.size()) {
    return false;
  }
  for (size_t i = 0; i < a.meshes.size(); ++i) {
    const Mesh& mesh_a = a.meshes[i];
    const Mesh& mesh_b = b.meshes[i];
    if (mesh_a.name != mesh_b.name || mesh_a.positions_m != mesh_b.positions_m ||
        mesh_a.texcoords != mesh_b.texcoords || mesh_a.triangles != mesh_b.triangles ||
        mesh_a.material_idx != mesh_b.material_idx) {
      return false;
    }
  }
  for (size_t i = 0; i < a.textures.size(); ++i) {
    if (a.textures[i].texels != b.textures[i].texels) {
      return false;
    }
  }
  return true;
}

TEST(Canyon, IsTheSameForTheSameArgumentsAndAnotherForAnotherSeed) {
  const Scene first = BuildCanyon({}, {});
  EXPECT_TRUE(HaveSameBits(first, BuildCanyon({}, {})));
  CanyonSpec other;
  other.seed = 2;
  EXPECT_FALSE(HaveSameBits(first, BuildCanyon(other, {})));
}

TEST(Canyon, KeepsToItsBudget) {
  const Canyon canyon = BuildCanyonWithStats({}, {});
  canyon.scene.Validate("canyon");
  EXPECT_GE(canyon.scene.NumTriangles(), 300000U);
  EXPECT_LE(canyon.scene.NumTriangles(), 1550000U);
  size_t num_texels = 0;
  for (const Texture& texture : canyon.scene.textures) {
    num_texels += texture.texels.NumPixels();
  }
  EXPECT_LE(num_texels, 80'000'000U);
  EXPECT_LE(canyon.scene.meshes.size(), 1500U);
  EXPECT_FALSE(canyon.scene.sun.has_value());
  EXPECT_EQ(canyon.stats.buildings_by_style.size(), 6U);
  EXPECT_EQ(canyon.stats.buildings_by_roof.size(), 3U);
  EXPECT_GE(canyon.stats.least_height_m, 10.0);
  EXPECT_LE(canyon.stats.greatest_height_m, 35.0);
  EXPECT_GT(canyon.stats.num_windows, 5000);
  EXPECT_GT(canyon.stats.num_balconies, 50);
  EXPECT_GT(canyon.stats.num_painted_walls, 100);
}

}  // namespace
}  // namespace pfseq
