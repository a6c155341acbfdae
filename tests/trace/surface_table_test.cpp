// SPDX-License-Identifier: Apache-2.0
// Surfaces in float against SurfacePoint, which works them out in double for the path tracer.
#include "renderer/trace/surface_table.h"

#include "renderer/core/random.h"
#include "renderer/trace/material.h"
#include "tests/trace/gathered_scene.h"
#include "tests/trace/shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Waves along both directions, three periods, the same at both seams.
Texture WavyTexture(bool is_srgb) {
  Texture texture;
  texture.is_srgb = is_srgb;
  texture.texels = Image<uint8_t>(64, 64, 4, 255);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double u_rad = 6.0 * std::numbers::pi * x / 64.0;
      const double v_rad = 6.0 * std::numbers::pi * y / 64.0;
      texture.texels.At(x, y, 0) = static_cast<uint8_t>(128.0 + 60.0 * std::sin(u_rad));
      texture.texels.At(x, y, 1) = static_cast<uint8_t>(128.0 + 60.0 * std::cos(v_rad));
      texture.texels.At(x, y, 2) = static_cast<uint8_t>(200.0 + 40.0 * std::sin(u_rad + v_rad));
    }
  }
  return texture;
}

/// The first with texture maps of all kinds, the second plain.
Scene TexturedScene() {
  Scene scene;
  scene.textures = {WavyTexture(true), WavyTexture(false)};
  Material textured;
  textured.base_color = Rgb(0.9F, 0.7F, 0.5F);
  textured.base_color_texture_idx = 0;
  textured.metallic = 0.6F;
  textured.roughness = 0.8F;
  textured.metallic_roughness_texture_idx = 1;
  textured.emission = Rgb(2.0F, 3.0F, 4.0F);
  textured.emission_texture_idx = 0;
  Material plain;
  plain.base_color = Rgb(0.1F, 0.2F, 0.3F);
  plain.roughness = 0.4F;
  Material mapped = textured;
  mapped.normal_texture_idx = 1;
  mapped.normal_scale = 0.7F;
  scene.materials = {textured, plain, mapped};
  return scene;
}

/// A slanted parallelogram whose texture is sheared and runs from -0.7 to beyond 2.
Mesh SlantedMesh(int material_idx) {
  Mesh mesh = ParallelogramMesh(
      {-3.0F, -2.0F, 0.5F}, {5.0F, 0.5F, 1.0F}, {-0.5F, 4.5F, 0.8F}, material_idx);
  mesh.texcoords = {{-0.7F, 0.2F}, {1.3F, 0.4F}, {2.1F, 1.6F}, {0.1F, 1.4F}};
  return mesh;
}

/// A sphere around the origin with vertex normals; every other one of the meshes has them inward.
Mesh SmoothSphere(int material_idx, float sign) {
  Mesh mesh = SphereScene(Vec3f::Zero(), 2.0F, 12)->meshes[0];
  mesh.material_idx = material_idx;
  for (const Vec3f& position_m : mesh.positions_m) {
    mesh.normals.push_back(sign * position_m.normalized());
    mesh.texcoords.emplace_back(0.4F * position_m.x() + 0.1F * position_m.z(),
                                0.4F * position_m.y() - 0.1F * position_m.z());
  }
  return mesh;
}

struct Case {
  std::string name;
  Scene scene;
};

std::vector<Case> Cases() {
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const Mesh& mesh) {
    Scene scene = TexturedScene();
    // Numbers over all meshes differ from those within the mesh.
    scene.meshes = {FloorMesh(0.1F, 1), mesh};
    scene.meshes[0].positions_m[0].z() = 50.0F;
    cases.push_back({name, std::move(scene)});
  };
  add("plain", SlantedMesh(1));
  add("textured", SlantedMesh(0));
  add("normal_mapped", SlantedMesh(2));
  add("smooth", SmoothSphere(1, 1.0F));
  add("smooth_inward_normals", SmoothSphere(0, -1.0F));
  add("smooth_normal_mapped", SmoothSphere(2, 1.0F));
  return cases;
}

class SurfaceTableOf : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Meshes,
                         SurfaceTableOf,
                         testing::ValuesIn(Cases()),
                         [](const testing::TestParamInfo<Case>& param_info) {
                           return param_info.param.name;
                         });

Vec3f RandomPlace(RandomStream& random, double half_size_m) {
  const double x = random.Uniform(-half_size_m, half_size_m);
  const double y = random.Uniform(-half_size_m, half_size_m);
  const double z = random.Uniform(-half_size_m, half_size_m);
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

TEST_P(SurfaceTableOf, WithoutAFootprintIsWhatThePathTracerSees) {
  const GatheredScene lit(GetParam().scene, ConstantSkyLight(Rgb::Ones()));
  const Scene& scene = lit.rays.PlainScene();
  RandomStream random({1});
  int num_front = 0;
  int num_back = 0;
  for (int i = 0; i < 3000; ++i) {
    // From afar and from within.
    const Vec3f origin_m = RandomPlace(random, i % 2 == 0 ? 6.0 : 1.2);
    const Vec3f direction = (RandomPlace(random, 1.8) - origin_m).normalized();
    const std::optional<PacketHit> hit = lit.rays.Intersect(origin_m, direction);
    if (!hit.has_value() || hit->mesh_idx != 1) {
      continue;
    }
    const Vec3d exact_direction = direction.cast<double>();
    const SurfacePoint expected(scene,
                                lit.textures,
                                lit.rays.ExactHit(*hit, origin_m.cast<double>(), exact_direction),
                                exact_direction);
    const ShadingPoint point = lit.surfaces.Shade(*hit, origin_m, direction, RayFootprint{});
    (point.is_front ? num_front : num_back) += 1;
    EXPECT_LT((point.position_m.cast<double>() - expected.PositionM()).norm(), 1e-4);
    EXPECT_LT((point.geometric_normal.cast<double>() - expected.GeometricNormal()).norm(), 1e-5);
    EXPECT_LT((point.normal.cast<double>() - expected.ShadingNormal()).norm(), 2e-3);
    EXPECT_LT((point.RayOriginM().cast<double>() - expected.RayOriginM()).norm(), 1e-4);
    const BsdfParameters& parameters = expected.Parameters();
    EXPECT_LT((point.parameters.base_color - parameters.base_color).abs().maxCoeff(), 1e-3F);
    EXPECT_LT((point.emission - expected.Emission()).abs().maxCoeff(), 5e-3F);
    EXPECT_NEAR(point.parameters.metallic, parameters.metallic, 1e-3F);
    EXPECT_EQ(point.parameters.ior, parameters.ior);
    if (scene.materials[static_cast<size_t>(scene.meshes[1].material_idx)].normal_texture_idx < 0) {
      EXPECT_NEAR(point.parameters.roughness, parameters.roughness, 1e-3F);
      EXPECT_EQ(point.normal_length, 1.0F);
    } else {
      // The map's normals are not of unit length: the lobe is widened, never narrowed.
      EXPECT_GE(point.parameters.roughness, parameters.roughness - 1e-3F);
      EXPECT_LE(point.normal_length, 1.0F);
    }
    // The place alone agrees.
    const ShadingPoint place = lit.surfaces.Locate(*hit, direction);
    EXPECT_EQ(place.triangle_idx, point.triangle_idx);
    EXPECT_EQ(place.is_front, point.is_front);
    EXPECT_EQ(place.geometric_normal, point.geometric_normal);
  }
  EXPECT_GT(num_front, 300);
  EXPECT_GT(num_back, 100);
}

/// Shading of the slanted mesh alone.
class SlantedTest : public testing::Test {
 protected:
  SlantedTest() : lit_(OneMesh(), ConstantSkyLight(Rgb::Ones())) {}

  static Scene OneMesh() {
    Scene scene = TexturedScene();
    scene.meshes = {SlantedMesh(0)};
    return scene;
  }

  /// Where the ray meets the mesh's plane, and the texture coordinates there.
  Vec2f TexcoordAlong(const Vec3f& origin_m, const Vec3f& direction) const {
    const PacketHit hit = lit_.rays.Intersect(origin_m, direction).value();
    const Mesh& mesh = lit_.rays.PlainScene().meshes[0];
    const std::array<uint32_t, 3>& corners = mesh.triangles[hit.triangle_idx];
    return (1.0F - hit.u - hit.v) * mesh.texcoords[corners[0]] +
           hit.u * mesh.texcoords[corners[1]] + hit.v * mesh.texcoords[corners[2]];
  }

  Rgb BaseColor(const Vec2f& texcoord, const Vec2f& axis_x, const Vec2f& axis_y) const {
    return Rgb(0.9F, 0.7F, 0.5F) *
           lit_.textures.LookupFiltered(0, texcoord, axis_x, axis_y).head<3>();
  }

  GatheredScene lit_;
};

/// Rays at the middle of the mesh from many sides, and a direction beside each.
struct TwoRays {
  Vec3f origin_m;
  Vec3f direction;
  Vec3f change;
};

std::vector<TwoRays> RaysAtTheMiddle() {
  std::vector<TwoRays> rays;
  RandomStream random({2});
  while (rays.size() < 300) {
    const Vec3f origin_m = RandomPlace(random, 6.0);
    const Vec3f target_m = Vec3f(-0.5F, 0.3F, 1.4F) + RandomPlace(random, 0.3);
    const Vec3f direction = (target_m - origin_m).normalized();
    const Vec3f change = (0.02F * RandomPlace(random, 1.0) + direction).normalized() - direction;
    const Vec3f normal = Vec3f(5.0F, 0.5F, 1.0F).cross(Vec3f(-0.5F, 4.5F, 0.8F)).normalized();
    if (std::abs(normal.dot(direction)) > 0.25F && (target_m - origin_m).norm() > 1.0F) {
      rays.push_back({origin_m, direction, change});
    }
  }
  return rays;
}

TEST_F(SlantedTest, ToMiddleMovesTheTextureAsAShiftedRayWould) {
  double error = 0.0;
  double distance = 0.0;
  for (const TwoRays& two : RaysAtTheMiddle()) {
    const PacketHit hit = lit_.rays.Intersect(two.origin_m, two.direction).value();
    RayFootprint footprint;
    footprint.to_middle = two.change;
    const Rgb moved =
        lit_.surfaces.Shade(hit, two.origin_m, two.direction, footprint).parameters.base_color;
    const Rgb expected = BaseColor(
        TexcoordAlong(two.origin_m, two.direction + two.change), Vec2f::Zero(), Vec2f::Zero());
    const Rgb unmoved =
        lit_.surfaces.Shade(hit, two.origin_m, two.direction, {}).parameters.base_color;
    error += (moved - expected).abs().sum();
    distance += (unmoved - expected).abs().sum();
  }
  // The change is followed to first order.
  EXPECT_GT(distance, 10.0);
  EXPECT_LT(error, 0.06 * distance);
}

TEST_F(SlantedTest, AxesFilterAsTheTextureCoordinatesOfTheBundlesEdges) {
  int num_compared = 0;
  for (const TwoRays& two : RaysAtTheMiddle()) {
    const PacketHit hit = lit_.rays.Intersect(two.origin_m, two.direction).value();
    RayFootprint footprint;
    footprint.axis_x = 2.0F * two.change;
    footprint.axis_y = 1.0F * two.direction.cross(two.change);
    const Rgb value =
        lit_.surfaces.Shade(hit, two.origin_m, two.direction, footprint).parameters.base_color;
    // Differences over a tenth, times ten.
    const Vec2f texcoord = TexcoordAlong(two.origin_m, two.direction);
    const auto axis = [&](const Vec3f& width) -> Vec2f {
      const Vec3f side = (two.direction + 0.1F * width).normalized();
      return 10.0F * (TexcoordAlong(two.origin_m, side) - texcoord);
    };
    const Vec2f axis_x = axis(footprint.axis_x);
    const Vec2f axis_y = axis(footprint.axis_y);
    if (std::max(axis_x.norm(), axis_y.norm()) > 0.12F) {
      continue;  // about what the triangle limits
    }
    ++num_compared;
    EXPECT_LT((value - BaseColor(texcoord, axis_x, axis_y)).abs().maxCoeff(), 0.02F);
  }
  EXPECT_GT(num_compared, 200);
}

TEST_F(SlantedTest, CircleOfADiameterFiltersAndRoughnessHasAFloor) {
  const Vec3f origin_m(-0.5F, 0.3F, 5.0F);
  const Vec3f direction = -Vec3f::UnitZ();
  const PacketHit hit = lit_.rays.Intersect(origin_m, direction).value();
  const ShadingPoint sharp = lit_.surfaces.Shade(hit, origin_m, direction, 0.0F, 0.0F);
  const ShadingPoint same = lit_.surfaces.Shade(hit, origin_m, direction, RayFootprint{});
  EXPECT_TRUE(sharp.parameters.base_color.isApprox(same.parameters.base_color, 1e-5F));
  EXPECT_EQ(sharp.parameters.roughness, same.parameters.roughness);
  EXPECT_EQ(lit_.surfaces.Shade(hit, origin_m, direction, 0.0F, 0.95F).parameters.roughness, 0.95F);
  // Wider than the mesh: an eighth of the root of the triangle's area in the texture.
  const float limit = 0.125F * std::sqrt(0.5F * (2.0F * 1.2F - 0.2F * 0.8F));
  const Rgb widest = BaseColor(TexcoordAlong(origin_m, direction), {limit, 0.0F}, {0.0F, limit});
  const ShadingPoint wide = lit_.surfaces.Shade(hit, origin_m, direction, 10.0F, 0.0F);
  EXPECT_TRUE(wide.parameters.base_color.isApprox(widest, 1e-3F));
  EXPECT_FALSE(sharp.parameters.base_color.isApprox(widest, 1e-2F));
}

TEST(SurfaceTable, WhatLiesBesideALeafInItsAtlasIsNotSeenOnTheLeafFromAfar) {
  Scene scene;
  Texture atlas;
  atlas.texels = Image<uint8_t>(64, 64, 4, 255);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool is_leaf = x >= 16 && x < 32 && y >= 16 && y < 32;
      atlas.texels.At(x, y, 0) = is_leaf ? 0 : 255;
      atlas.texels.At(x, y, 1) = is_leaf ? 255 : 0;
    }
  }
  scene.textures = {atlas};
  scene.materials.resize(1);
  scene.materials[0].base_color = Rgb::Ones();
  scene.materials[0].base_color_texture_idx = 0;
  Mesh leaf = ParallelogramMesh({0.0F, 0.0F, 0.0F}, {0.1F, 0.0F, 0.0F}, {0.0F, 0.1F, 0.0F}, 0);
  leaf.texcoords = {{0.25F, 0.25F}, {0.5F, 0.25F}, {0.5F, 0.5F}, {0.25F, 0.5F}};
  scene.meshes = {leaf};
  const GatheredScene lit(scene, ConstantSkyLight(Rgb::Ones()));
  // A pixel of ten leaves' width, and a stratum whose middle is beside the leaf.
  RayFootprint footprint;
  footprint.axis_x = {0.01F, 0.0F, 0.0F};
  footprint.axis_y = {0.0F, 0.01F, 0.0F};
  footprint.to_middle = {0.003F, 0.0F, 0.0F};
  for (const float x_m : {0.02F, 0.05F, 0.08F}) {
    for (const float y_m : {0.02F, 0.05F, 0.08F}) {
      const Vec3f origin_m(x_m, y_m, 100.0F);
      const Vec3f direction = -Vec3f::UnitZ();
      const PacketHit hit = lit.rays.Intersect(origin_m, direction).value();
      const Rgb color =
          lit.surfaces.Shade(hit, origin_m, direction, footprint).parameters.base_color;
      EXPECT_GT(color[1], 0.95F) << x_m << ' ' << y_m;
      EXPECT_LT(color[0], 0.05F) << x_m << ' ' << y_m;
      const Rgb reflected =
          lit.surfaces.Shade(hit, origin_m, direction, 1.0F, 0.0F).parameters.base_color;
      EXPECT_GT(reflected[1], 0.95F) << x_m << ' ' << y_m;
    }
  }
}

TEST(SurfaceTable, NumbersTrianglesOverAllMeshes) {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes = {FloorMesh(1.0F, 0), SphereMesh({0.0F, 0.0F, 5.0F}, 1.0F, 0), FloorMesh(3.0F, 0)};
  const GatheredScene lit(scene, ConstantSkyLight(Rgb::Ones()));
  EXPECT_EQ(lit.surfaces.NumTriangles(), lit.rays.PlainScene().NumTriangles());
  uint32_t triangle_idx = 0;
  for (uint32_t mesh_idx = 0; mesh_idx < 3; ++mesh_idx) {
    const Mesh& mesh = scene.meshes[mesh_idx];
    for (uint32_t k = 0; k < mesh.triangles.size(); ++k, ++triangle_idx) {
      ASSERT_EQ(lit.surfaces.TriangleIdx(mesh_idx, k), triangle_idx);
      ASSERT_EQ(lit.surfaces.MeshAndTriangle(triangle_idx), std::pair(mesh_idx, k));
      ASSERT_EQ(lit.surfaces.CornersM(triangle_idx)[1], mesh.positions_m[mesh.triangles[k][1]]);
    }
  }
}

}  // namespace
}  // namespace pfseq
