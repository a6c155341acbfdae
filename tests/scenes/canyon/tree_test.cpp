// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/tree.h"

#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

const Vec3d kFoot_m(3.0, -2.0, 0.1);

/// A tree and its parts.
struct Tree {
  explicit Tree(TreeDesign tree_design, uint64_t seed = 1) : design(tree_design) {
    design.leaf = bench.palette.leaf[0];
    RandomStream random({seed});
    BuildTree(bench.Context(), design, kFoot_m, random);
    scene = bench.TakeScene();
    leaves = PartOf(scene, design.leaf);
    wood = PartOf(scene, bench.palette.bark);
  }

  size_t NumLeaves() const { return leaves.NumTriangles() / 2; }

  PartBench bench;
  TreeDesign design;
  Scene scene;
  Scene leaves;
  Scene wood;
};

TEST(Tree, StandsInTheGroundAndIsAsHighAsAsked) {
  for (const double height_m : {6.0, 9.0, 14.0}) {
    TreeDesign design;
    design.height_m = height_m;
    const Tree tree(design);
    EXPECT_EQ(tree.bench.stats.num_trees, 1);
    EXPECT_EQ(tree.leaves.meshes.size(), 1U);
    EXPECT_EQ(tree.wood.meshes.size(), 1U);
    const Bounds bounds = BoundsOfScene(tree.scene);
    EXPECT_NEAR(bounds.low_m.z(), kFoot_m.z() - 0.05, 0.02);
    EXPECT_NEAR(bounds.high_m.z(), kFoot_m.z() + height_m, 0.08 * height_m);
    EXPECT_TRUE(FindDegenerate(tree.scene).texts.empty());
  }
}

TEST(Tree, LeavesStayInTheCrown) {
  for (const double radius_m : {0.6, 2.0, 3.5}) {
    TreeDesign design;
    design.crown_radius_m = radius_m;
    design.clear_m = 2.5;
    design.num_leaves = 5000;
    double widest_m = 0.0;
    for (uint64_t seed = 0; seed < 8; ++seed) {
      const Tree tree(design, seed);
      for (const Vec3f& corner_m : tree.leaves.meshes.at(0).positions_m) {
        const Vec3d from_foot_m = corner_m.cast<double>() - kFoot_m;
        widest_m = std::max(widest_m, from_foot_m.head<2>().norm());
      }
      // The lowest clumps hang a little below.
      const double low_m = BoundsOfScene(tree.leaves).low_m.z() - kFoot_m.z();
      EXPECT_GT(low_m, 2.5 - 0.3 * radius_m);
      EXPECT_LT(low_m, 2.5 + 0.5);
    }
    EXPECT_LE(widest_m, radius_m);
    EXPECT_GT(widest_m, 0.85 * radius_m);
  }
}

TEST(Tree, HasAboutAsManyLeavesAsAskedEachARhombus) {
  for (const int num_leaves : {200, 2000}) {
    TreeDesign design;
    design.num_leaves = num_leaves;
    const Tree tree(design);
    // Those that would reach beyond the crown are left out.
    EXPECT_LE(tree.NumLeaves(), static_cast<size_t>(num_leaves));
    EXPECT_GE(tree.NumLeaves(), static_cast<size_t>(0.8 * num_leaves));
    const Mesh& mesh = tree.leaves.meshes.at(0);
    ASSERT_EQ(mesh.positions_m.size(), 4 * tree.NumLeaves());
    for (size_t i = 0; i < mesh.positions_m.size(); i += 4) {
      const Vec3f* corner_m = &mesh.positions_m[i];
      // Within the grid of 0.01 mm that corners lie on.
      const float side_m = (corner_m[1] - corner_m[0]).norm();
      for (int k = 1; k < 4; ++k) {
        EXPECT_NEAR((corner_m[(k + 1) % 4] - corner_m[k]).norm(), side_m, 5e-5F);
      }
      const float length_m = (corner_m[2] - corner_m[0]).norm();
      EXPECT_GE(length_m, 0.0799F);
      EXPECT_LE(length_m, 0.1601F);
    }
  }
}

TEST(Tree, LimbsShowNoBackFaces) {
  const Tree tree({});
  // Limbs are open where they begin, within the trunk or the ground.
  const SurfaceFaults backs = FindBacksFrom(Vec3d::UnitZ(), tree.wood);
  EXPECT_GT(backs.num_checked, 10000);
  EXPECT_TRUE(backs.texts.empty()) << backs.texts.size() << " " << backs.texts.front();
}

TEST(Tree, MostLeavesLookTowardTheLight) {
  const Tree tree({});
  const Mesh& mesh = tree.leaves.meshes.at(0);
  double sum = 0.0;
  for (size_t i = 0; i < mesh.positions_m.size(); i += 4) {
    const Vec3f across_m = mesh.positions_m[i + 2] - mesh.positions_m[i];
    sum += across_m.cross(mesh.positions_m[i + 3] - mesh.positions_m[i + 1]).normalized().z();
  }
  EXPECT_GT(std::abs(sum) / static_cast<double>(tree.NumLeaves()), 0.3);
}

TEST(Tree, DependsOnItsRandomNumbersAlone) {
  const Tree tree({}, 4);
  EXPECT_EQ(tree.leaves.meshes.at(0).positions_m, Tree({}, 4).leaves.meshes.at(0).positions_m);
  EXPECT_NE(tree.leaves.meshes.at(0).positions_m, Tree({}, 5).leaves.meshes.at(0).positions_m);
}

}  // namespace
}  // namespace pfseq
