// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/mesh_builder.h"

#include <array>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

std::vector<Material> Materials(size_t count) {
  std::vector<Material> materials(count);
  for (size_t i = 0; i < count; ++i) {
    materials[i].name = "m" + std::to_string(i);
  }
  return materials;
}

TEST(MeshBuilder, GathersByGroupAndMaterialInAFixedOrder) {
  MeshBuilder builder({1.0, 1.0});
  const SurfaceFrame frame;
  builder.BeginGroup("b");
  builder.Rectangle(1, frame, {0, 0}, {1, 1}, 0.0);
  builder.BeginGroup("a");
  builder.Rectangle(0, frame, {0, 0}, {1, 1}, 0.0);
  builder.BeginGroup("b");
  builder.Rectangle(1, frame, {2, 0}, {3, 1}, 0.0);
  const std::vector<Mesh> meshes = builder.TakeMeshes(Materials(2));
  ASSERT_EQ(meshes.size(), 2U);
  EXPECT_EQ(meshes[0].name, "a/m0");
  EXPECT_EQ(meshes[1].name, "b/m1");
  EXPECT_EQ(meshes[1].material_idx, 1);
  EXPECT_EQ(meshes[1].triangles.size(), 4U);
}

TEST(MeshBuilder, RectangleFacesOut) {
  MeshBuilder builder({1.0});
  builder.BeginGroup("g");
  builder.Rectangle(0, SurfaceFrame(), {0, 0}, {2, 1}, 0.5);
  const Mesh mesh = builder.TakeMeshes(Materials(1)).front();
  const auto& [a, b, c] = mesh.triangles.front();
  const Vec3f normal = (mesh.positions_m[b] - mesh.positions_m[a])
                           .cross(mesh.positions_m[c] - mesh.positions_m[a])
                           .normalized();
  EXPECT_TRUE(normal.isApprox(SurfaceFrame().out.cast<float>()));
  EXPECT_FLOAT_EQ(mesh.positions_m[a].y(), -0.5F);
}

TEST(MeshBuilder, TexturesLieUprightInTheirSize) {
  MeshBuilder builder({2.0});
  builder.BeginGroup("g");
  builder.SetTextureOffset({0.5, 0.25});
  builder.Rectangle(0, SurfaceFrame(), {0, 0}, {4, 1}, 0.0);
  const Mesh mesh = builder.TakeMeshes(Materials(1)).front();
  // Lower left, lower right, upper right: u grows to the right, v downwards, one repetition in 2 m.
  EXPECT_TRUE(mesh.texcoords[0].isApprox(Vec2f(0.25F, 0.125F)));
  EXPECT_TRUE(mesh.texcoords[1].isApprox(Vec2f(2.25F, 0.125F)));
  EXPECT_TRUE(mesh.texcoords[2].isApprox(Vec2f(2.25F, -0.375F)));
}

TEST(MeshBuilder, PictureQuadShowsItsWindowUpright) {
  MeshBuilder builder({1.0});
  builder.BeginGroup("g");
  builder.PictureQuad(0, {0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0.25, 0.5, 0.5, 0.75});
  const Mesh mesh = builder.TakeMeshes(Materials(1)).front();
  EXPECT_EQ(mesh.texcoords[0], Vec2f(0.25F, 0.75F));
  EXPECT_EQ(mesh.texcoords[2], Vec2f(0.5F, 0.5F));
}

TEST(MeshBuilder, LeavesOutDegenerateTriangles) {
  MeshBuilder builder({1.0});
  builder.BeginGroup("g");
  const Vec3d a(0, 0, 0);
  const Vec3d b(1, 0, 0);
  const Vec3d c(1, 0, 1);
  builder.Quad(0, a, a, b, c);
  builder.Quad(0, a, b, b, a);
  const std::vector<Mesh> meshes = builder.TakeMeshes(Materials(1));
  ASSERT_EQ(meshes.size(), 1U);
  EXPECT_EQ(meshes[0].triangles.size(), 1U);
}

TEST(TextureWindow, PartIsCountedFromTheUpperLeft) {
  const TextureWindow part = TextureWindow{0.5, 0.0, 1.0, 0.5}.Part(0.0, 0.5, 0.5, 1.0);
  EXPECT_DOUBLE_EQ(part.u0, 0.5);
  EXPECT_DOUBLE_EQ(part.u1, 0.75);
  EXPECT_DOUBLE_EQ(part.v0, 0.25);
  EXPECT_DOUBLE_EQ(part.v1, 0.5);
}

}  // namespace
}  // namespace pfseq
