// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/canyon_stats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(CanyonStats, DescribesCountsExtentsAndTriangles) {
  CanyonStats stats;
  stats.num_buildings = 12;
  stats.buildings_by_style["brick"] = 7;
  stats.greatest_height_m = 31.25;
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].name = "stone";
  Mesh mesh;
  mesh.material_idx = 1;
  mesh.positions_m = {{-1, 0, 0}, {2.5, 0, 0}, {0, 3, 0}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh};
  const std::string text = DescribeCanyon(stats, scene);
  EXPECT_THAT(text, testing::HasSubstr("buildings 12"));
  EXPECT_THAT(text, testing::HasSubstr("brick 7"));
  EXPECT_THAT(text, testing::HasSubstr("x -1.0 to 2.5 m"));
  EXPECT_THAT(text, testing::HasSubstr("triangles 1\n"));
  EXPECT_THAT(text, testing::ContainsRegex("stone +1\n"));
}

}  // namespace
}  // namespace pfseq
