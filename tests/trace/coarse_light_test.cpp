// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/coarse_light.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Triangles of the plane z = 0, their fronts upward.
Scene PlaneOf(const std::vector<std::array<Vec2f, 3>>& triangles) {
  Mesh mesh;
  for (const std::array<Vec2f, 3>& corners : triangles) {
    const auto first = static_cast<uint32_t>(mesh.positions_m.size());
    for (const Vec2f& corner : corners) {
      mesh.positions_m.emplace_back(corner.x(), corner.y(), 0.0F);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  Scene scene;
  scene.meshes = {mesh};
  scene.materials = {Material{}};
  return scene;
}

/// The irradiance is the place; front sides have blue 1, back sides 0. What lies beyond `body_x_m`
/// is within a body.
struct PlaceLight {
  explicit PlaceLight(Scene plain_scene, float cell_m, float body_x_m = 1e9F)
      : scene(std::move(plain_scene)),
        textures(scene),
        surfaces(scene, textures),
        light(surfaces,
              cell_m,
              [this, body_x_m](const Vec3f& position_m, const Vec3f& normal, RandomStream&) {
                places.push_back(position_m);
                return CoarseLight::PointEstimate{
                    Rgb(position_m.x(), position_m.y(), normal.z() > 0.0F ? 1.0F : 0.0F),
                    position_m.x() > body_x_m};
              }) {}

  Scene scene;
  TextureSet textures;
  SurfaceTable surfaces;
  std::vector<Vec3f> places;
  CoarseLight light;
};

TEST(CoarseLight, SmallTrianglesOfACellShareTheMeanOverTheirAreas) {
  // Areas 3 : 1, centroids at x = 0.5 and 0.9 (thirds of the corners' sums).
  PlaceLight place(PlaneOf({{Vec2f(0.2F, 0.1F), Vec2f(0.8F, 0.1F), Vec2f(0.5F, 0.7F)},
                            {Vec2f(0.8F, 0.1F), Vec2f(0.95F, 0.1F), Vec2f(0.95F, 0.9F)}}),
                   1.0F);
  const Rgb first = place.light.Irradiance(0, 0.3F, 0.3F, true);
  const size_t num_places = place.places.size();
  EXPECT_TRUE((place.light.Irradiance(1, 0.1F, 0.1F, true) == first).all());
  EXPECT_EQ(place.places.size(), num_places) << "the same patch was estimated again";
  EXPECT_NEAR(first[0], 0.75F * 0.5F + 0.25F * 0.9F, 0.03F);
  EXPECT_EQ(first[2], 1.0F);
}

TEST(CoarseLight, TheLesserPartWithinABodyDoesNotCount) {
  // Of the unit square's x, uniform, the mean below 0.7; with most of it within a body, all.
  const Scene square = PlaneOf({{Vec2f(0.0F, 0.0F), Vec2f(1.0F, 0.0F), Vec2f(1.0F, 1.0F)},
                                {Vec2f(0.0F, 0.0F), Vec2f(1.0F, 1.0F), Vec2f(0.0F, 1.0F)}});
  EXPECT_NEAR(
      PlaceLight(square, 2.0F, 0.7F).light.Irradiance(0, 0.3F, 0.3F, true)[0], 0.35F, 0.07F);
  EXPECT_NEAR(PlaceLight(square, 2.0F, 0.2F).light.Irradiance(0, 0.3F, 0.3F, true)[0], 0.5F, 0.1F);
}

TEST(CoarseLight, EachSideHasItsOwn) {
  PlaceLight place(PlaneOf({{Vec2f(0.0F, 0.0F), Vec2f(1.0F, 0.0F), Vec2f(0.0F, 1.0F)}}), 1.0F);
  EXPECT_EQ(place.light.Irradiance(0, 0.3F, 0.3F, true)[2], 1.0F);
  EXPECT_EQ(place.light.Irradiance(0, 0.3F, 0.3F, false)[2], 0.0F);
}

TEST(CoarseLight, LargeTrianglesAreCutIntoCells) {
  constexpr float kSide_m = 8.0F;
  PlaceLight place(PlaneOf({{Vec2f(0.0F, 0.0F), Vec2f(kSide_m, 0.0F), Vec2f(0.0F, kSide_m)}}),
                   1.0F);
  // ceil(8 sqrt(2)) = 12 cells along each edge.
  constexpr float kCell_m = kSide_m / 12.0F;
  const Rgb inner = place.light.Irradiance(0, 3.2F / 12.0F, 5.7F / 12.0F, true);
  EXPECT_NEAR(inner[0], 3.5F * kCell_m, 0.15F * kCell_m);
  EXPECT_NEAR(inner[1], 5.5F * kCell_m, 0.15F * kCell_m);
  // A cell across the long edge: the centroid of its inner half.
  const Rgb outer = place.light.Irradiance(0, 5.2F / 12.0F, 6.3F / 12.0F, true);
  EXPECT_NEAR(outer[0], (5.0F + 1.0F / 3.0F) * kCell_m, 0.15F * kCell_m);
  EXPECT_NEAR(outer[1], (6.0F + 1.0F / 3.0F) * kCell_m, 0.15F * kCell_m);
  EXPECT_TRUE(std::all_of(place.places.begin(), place.places.end(), [&](const Vec3f& at) {
    return at.x() >= 0.0F && at.y() >= 0.0F && at.x() + at.y() <= kSide_m * 1.0001F;
  }));
}

TEST(CoarseLight, LoadedIsNotEstimatedAgain) {
  const Scene square = PlaneOf({{Vec2f(0.0F, 0.0F), Vec2f(1.0F, 0.0F), Vec2f(1.0F, 1.0F)},
                                {Vec2f(0.0F, 0.0F), Vec2f(9.0F, 9.0F), Vec2f(0.0F, 9.0F)}});
  PlaceLight first(square, 1.0F);
  const Rgb small = first.light.Irradiance(0, 0.3F, 0.3F, true);
  const Rgb cell = first.light.Irradiance(1, 0.1F, 0.7F, false);
  const std::string bytes = first.light.Serialize() + "rest";

  PlaceLight second(square, 1.0F);
  std::string_view rest = bytes;
  ASSERT_TRUE(second.light.Load(rest));
  EXPECT_EQ(rest, "rest");
  EXPECT_TRUE((second.light.Irradiance(0, 0.3F, 0.3F, true) == small).all());
  EXPECT_TRUE((second.light.Irradiance(1, 0.1F, 0.7F, false) == cell).all());
  EXPECT_TRUE(second.places.empty());
  second.light.Irradiance(0, 0.3F, 0.3F, false);
  EXPECT_FALSE(second.places.empty()) << "a side that was not there was taken for one that was";
}

TEST(CoarseLight, RefusesBytesThatAreNotItsOwnAndLoadsNothing) {
  const std::array<Vec2f, 3> corners = {Vec2f(0.0F, 0.0F), Vec2f(1.0F, 0.0F), Vec2f(1.0F, 1.0F)};
  PlaceLight first(PlaneOf({corners}), 2.0F);
  first.light.Irradiance(0, 0.3F, 0.3F, true);
  const std::string bytes = first.light.Serialize();
  std::string beyond = bytes;
  beyond[2 * sizeof(uint64_t)] = 2;
  for (const std::string& wrong : {beyond, bytes.substr(0, bytes.size() - 1), std::string()}) {
    PlaceLight second(PlaneOf({corners}), 2.0F);
    std::string_view rest = wrong;
    EXPECT_FALSE(second.light.Load(rest));
    EXPECT_EQ(rest, wrong);
    second.light.Irradiance(0, 0.3F, 0.3F, true);
    EXPECT_FALSE(second.places.empty());
  }
  PlaceLight other(PlaneOf({corners, {Vec2f(3.0F, 0.0F), Vec2f(4.0F, 0.0F), Vec2f(4.0F, 1.0F)}}),
                   2.0F);
  std::string_view rest = bytes;
  EXPECT_FALSE(other.light.Load(rest));
}

}  // namespace
}  // namespace pfseq
