// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/ray_scene.h"

#include "renderer/core/random.h"
#include "tests/support/simple_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Vec3d RandomDirection(RandomStream& random) {
  const double z = random.Uniform(-1.0, 1.0);
  const double azimuth_rad = random.Uniform(-3.14159, 3.14159);
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), z};
}

TEST(RayScene, DistanceToAFarSlantedPlaneIsExactToDoublePrecision) {
  // The plane through three float vertices: the closed form uses the same vertices.
  const Vec3f a(-300.0F, -300.0F, 20.3F);
  const Vec3f b(400.0F, -310.0F, 33.7F);
  const Vec3f c(10.0F, 420.0F, 71.9F);
  const RayScene scene(SceneOfTriangles({{a, b, c}}));
  const Vec3d normal = (b - a).cast<double>().cross((c - a).cast<double>());
  RandomStream random{11};
  int num_hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d origin_m(random.Uniform(-5, 5), random.Uniform(-5, 5), random.Uniform(0, 3));
    const Vec3d direction = RandomDirection(random);
    const auto hit = scene.Intersect(origin_m, direction);
    if (!hit.has_value()) {
      continue;
    }
    ++num_hits;
    // In double from double edges: the float edges of the closed form above are rounded, so
    // subtract again.
    const Vec3d exact_normal =
        (b.cast<double>() - a.cast<double>()).cross(c.cast<double>() - a.cast<double>());
    const double expected_m =
        exact_normal.dot(a.cast<double>() - origin_m) / exact_normal.dot(direction);
    ASSERT_NEAR(hit->distance_m, expected_m, 1e-12 * expected_m);
    ASSERT_GT(std::abs(hit->geometric_normal.dot(normal.normalized())), 1.0 - 1e-6);
    const Vec3d point_m = (1.0 - hit->u - hit->v) * a.cast<double>() + hit->u * b.cast<double>() +
                          hit->v * c.cast<double>();
    ASSERT_LT((point_m - (origin_m + expected_m * direction)).norm(), 1e-9 * expected_m);
  }
  EXPECT_GT(num_hits, 5000);
}

TEST(RayScene, NormalFollowsTheVertexOrder) {
  const Vec3f a(0, 0, 0);
  const Vec3f b(1, 0, 0);
  const Vec3f c(0, 1, 0);
  const Vec3d above(0.2, 0.2, 1.0);
  const auto hit = RayScene(SceneOfTriangles({{a, b, c}})).Intersect(above, -Vec3d::UnitZ());
  ASSERT_TRUE(hit.has_value());
  EXPECT_GT(hit->geometric_normal.z(), 0.999);
  const auto flipped = RayScene(SceneOfTriangles({{a, c, b}})).Intersect(above, -Vec3d::UnitZ());
  EXPECT_LT(flipped->geometric_normal.z(), -0.999);
}

TEST(RayScene, NoRayLeavesAClosedBoxThroughItsEdges) {
  const RayScene scene(BoxScene(Vec3f(-7.1F, -3.3F, -1.7F), Vec3f(11.9F, 5.2F, 23.1F)));
  RandomStream random{5};
  for (int i = 0; i < 20000; ++i) {
    Vec3d direction = RandomDirection(random);
    if (i % 2 == 0) {
      // Straight at an edge.
      direction = (Vec3d(11.9F, 5.2F, random.Uniform(-1.7, 23.1)) - Vec3d(1, 1, 1)).normalized();
    }
    ASSERT_TRUE(scene.Intersect(Vec3d(1, 1, 1), direction).has_value()) << direction.transpose();
    ASSERT_TRUE(scene.Occluded(Vec3d(1, 1, 1), direction));
  }
}

TEST(RayScene, MaximumDistanceCutsHitsAndShadows) {
  const RayScene scene(BoxScene(Vec3f(-10, -10, -10), Vec3f(10, 10, 10)));
  const Vec3d origin_m(0, 0, 0);
  EXPECT_FALSE(scene.Intersect(origin_m, Vec3d::UnitX(), 9.99).has_value());
  EXPECT_TRUE(scene.Intersect(origin_m, Vec3d::UnitX(), 10.01).has_value());
  EXPECT_FALSE(scene.Occluded(origin_m, Vec3d::UnitX(), 9.99));
  EXPECT_TRUE(scene.Occluded(origin_m, Vec3d::UnitX(), 10.01));
}

TEST(RayScene, LooksThroughHolesOfAnAlphaMask) {
  // A wall at x = 1 whose texture is opaque in its left half (u < 0.5, here y < 0.5) alone; a
  // closed wall at x = 2.
  Scene scene;
  scene.materials.resize(2);
  scene.materials[0].alpha_cutoff = 0.5F;
  scene.materials[0].base_color_texture_idx = 0;
  Texture texture{"mask", Image<uint8_t>(8, 8, 4, 255), true};
  for (int y = 0; y < 8; ++y) {
    for (int x = 4; x < 8; ++x) {
      texture.texels.At(x, y, 3) = 0;
    }
  }
  scene.textures.push_back(texture);
  scene.meshes.push_back(Quad({1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}));
  scene.meshes[0].texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.meshes.push_back(Quad({2, -1, -1}, {2, 2, -1}, {2, 2, 2}, {2, -1, 2}));
  scene.meshes[1].material_idx = 1;
  const RayScene rays(std::make_shared<const Scene>(scene));
  EXPECT_NEAR(rays.Intersect(Vec3d(0, 0.25, 0.5), Vec3d::UnitX())->distance_m, 1.0, 1e-12);
  EXPECT_NEAR(rays.Intersect(Vec3d(0, 0.75, 0.5), Vec3d::UnitX())->distance_m, 2.0, 1e-12);
  EXPECT_TRUE(rays.Occluded(Vec3d(0, 0.25, 0.5), Vec3d::UnitX(), 1.5));
  EXPECT_FALSE(rays.Occluded(Vec3d(0, 0.75, 0.5), Vec3d::UnitX(), 1.5));
}

TEST(RayScene, TellsItsMemory) {
  const RayScene scene(BoxScene(Vec3f(-1, -1, -1), Vec3f(1, 1, 1)));
  EXPECT_GT(scene.MemoryBytes(), 500);
}

}  // namespace
}  // namespace pfseq
