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

/// Triangles all about, every other one with holes.
std::shared_ptr<const Scene> Clutter() {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].alpha_cutoff = 0.5F;
  scene.materials[1].base_color_texture_idx = 0;
  Texture mask{"mask", Image<uint8_t>(16, 16, 4, 255), true};
  RandomStream random{3};
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      mask.texels.At(x, y, 3) = random.Chance(0.5) ? 255 : 0;
    }
  }
  scene.textures.push_back(mask);
  const auto place = [&](double half_size_m) {
    return Vec3f(static_cast<float>(random.Uniform(-half_size_m, half_size_m)),
                 static_cast<float>(random.Uniform(-half_size_m, half_size_m)),
                 static_cast<float>(random.Uniform(-half_size_m, half_size_m)));
  };
  for (int material_idx = 0; material_idx < 2; ++material_idx) {
    Mesh mesh;
    mesh.material_idx = material_idx;
    for (uint32_t k = 0; k < 150; ++k) {
      const Vec3f corner_m = place(20.0);
      mesh.positions_m.insert(mesh.positions_m.end(),
                              {corner_m, corner_m + place(5.0), corner_m + place(5.0)});
      mesh.texcoords.insert(mesh.texcoords.end(), {{0, 0}, {1, 0}, {0, 1}});
      mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    scene.meshes.push_back(mesh);
  }
  return std::make_shared<const Scene>(std::move(scene));
}

TEST(RayScene, PacketsGiveWhatSingleRaysGive) {
  const RayScene scene(Clutter());
  RandomStream random{4};
  int num_hits = 0;
  int num_mask_hits = 0;
  for (const Coherence coherence : {Coherence::kCoherent, Coherence::kIncoherent}) {
    for (int k = 0; k < 1000; ++k) {
      RayPacket packet;
      const bool is_same_origin = k % 2 == 0;
      Vec3f origin_m = Vec3f::Zero();
      for (int i = 0; i < kPacketSize; ++i) {
        // What is set and not active must not be traced.
        if (!is_same_origin) {
          origin_m = Vec3f(static_cast<float>(random.Uniform(-20.0, 20.0)),
                           static_cast<float>(random.Uniform(-20.0, 20.0)),
                           static_cast<float>(random.Uniform(-20.0, 20.0)));
        }
        packet.Set(i, origin_m, RandomDirection(random).cast<float>());
      }
      packet.active = static_cast<uint32_t>(random.Integer(0, 255));
      HitPacket hits;
      scene.Intersect(packet, coherence, hits);
      const uint32_t occluded = scene.Occluded(packet, coherence);
      ASSERT_EQ(hits.hit & ~packet.active, 0U);
      ASSERT_EQ(occluded & ~packet.active, 0U);
      for (int i = 0; i < kPacketSize; ++i) {
        if (!packet.IsActive(i)) {
          continue;
        }
        const auto single = scene.Intersect(packet.Origin(i), packet.Direction(i));
        const Vec3d direction = packet.Direction(i).cast<double>();
        const auto exact = scene.Intersect(Vec3d(packet.Origin(i).cast<double>()), direction);
        ASSERT_EQ(hits.IsHit(i), single.has_value());
        ASSERT_EQ(hits.IsHit(i), exact.has_value());
        ASSERT_EQ((occluded >> i & 1U) != 0, hits.IsHit(i));
        ASSERT_EQ(scene.Occluded(packet.Origin(i), packet.Direction(i)), hits.IsHit(i));
        if (!hits.IsHit(i)) {
          continue;
        }
        const PacketHit hit = hits.Of(i);
        ++num_hits;
        num_mask_hits += hit.mesh_idx == 1 ? 1 : 0;
        ASSERT_EQ(hit.mesh_idx, single->mesh_idx);
        ASSERT_EQ(hit.triangle_idx, single->triangle_idx);
        ASSERT_NEAR(hit.distance_m, single->distance_m, 1e-5F * (1.0F + hit.distance_m));
        ASSERT_NEAR(hit.u, single->u, 1e-4F);
        ASSERT_NEAR(hit.v, single->v, 1e-4F);
        ASSERT_EQ(hit.mesh_idx, exact->mesh_idx);
        ASSERT_EQ(hit.triangle_idx, exact->triangle_idx);
        const RayHit same_place = scene.ExactHit(hit, packet.Origin(i).cast<double>(), direction);
        ASSERT_EQ(same_place.distance_m, exact->distance_m);
        ASSERT_EQ(same_place.u, exact->u);
        ASSERT_EQ(same_place.v, exact->v);
        ASSERT_EQ(same_place.geometric_normal, exact->geometric_normal);
      }
    }
  }
  EXPECT_GT(num_hits, 1500);
  EXPECT_GT(num_mask_hits, 300);
}

TEST(RayScene, PacketsLookThroughHolesOfAnAlphaMask) {
  // As above: opaque for y < 0.5 alone.
  Scene scene;
  scene.materials.resize(1);
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
  const RayScene rays(std::make_shared<const Scene>(scene));
  for (const Coherence coherence : {Coherence::kCoherent, Coherence::kIncoherent}) {
    RayPacket packet;
    for (int i = 0; i < kPacketSize; ++i) {
      packet.Set(i, {0.0F, (static_cast<float>(i) + 0.5F) / 8.0F, 0.5F}, Vec3f::UnitX());
    }
    HitPacket hits;
    rays.Intersect(packet, coherence, hits);
    EXPECT_EQ(hits.hit, 0x0FU);
    EXPECT_EQ(rays.Occluded(packet, coherence), 0x0FU);
  }
}

TEST(RayScene, TellsItsMemory) {
  const RayScene scene(BoxScene(Vec3f(-1, -1, -1), Vec3f(1, 1, 1)));
  EXPECT_GT(scene.MemoryBytes(), 500);
}

}  // namespace
}  // namespace pfseq
